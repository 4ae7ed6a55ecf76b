#pragma once
// Chooses the region of an endless world if the options do not give one.

#include <array>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// Whether an anchor's name, kind or tag equals `wanted`; an empty `wanted` accepts every anchor.
bool isWanted(const Program& program, const Anchor& anchor, std::string_view wanted);

/// Boxes of the elements in the region that differ from the domain: shapes in air, cavities in rock.
Result<std::vector<IntBox>> shapesIn(const WorldField& world, const IntBox& region);

/// The box that extends 48 m to each side of a place in metres.
IntBox surroundingsOf(const std::array<double, 3>& place);

/// The default region. It surrounds the anchor nearest to the world's origin, within 512 m, that isWanted() accepts. If
/// there is no such anchor and wanted_anchor is empty, it surrounds the origin. If that region is empty, it contains
/// the shape nearest to the origin, at most 8 km away, and the shapes whose boxes touch that shape's box, up to a size
/// of 1 km. Errors: those of derivation.
Result<IntBox> surroundings(const WorldField& world, std::string_view wanted_anchor);

}  // namespace sgm::cli
