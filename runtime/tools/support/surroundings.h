#pragma once
// Chooses the default region in an endless world.

#include <array>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// Whether an anchor's name, kind or tag equals `wanted`; an empty one accepts all.
bool isWanted(const Program& program, const Anchor& anchor, std::string_view wanted);

/// Boxes that meet the region, of elements that differ from the domain: shapes in air, cavities in rock.
Result<std::vector<IntBox>> shapesIn(const WorldField& world, const IntBox& region);

/// 48 m to each side of a place in metres.
IntBox surroundingsOf(const std::array<double, 3>& place);

/// The surroundings of the wanted anchor nearest to the world's origin. Without an anchor within 512 m and without a
/// wanted one: the surroundings of the origin, or if these are empty, the shape nearest to it, up to 8 km off, with the
/// shapes whose boxes touch its box, to a size of 1 km. Errors: those of derivation.
Result<IntBox> surroundings(const WorldField& world, std::string_view wanted_anchor);

}  // namespace sgm::cli
