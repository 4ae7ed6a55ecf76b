#pragma once
// Chooses the region of an endless world that is meshed if the options give none.

#include <array>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// Whether the anchor's name, kind or tag equals `wanted`; always true if `wanted` is empty.
bool isWanted(const Program& program, const Anchor& anchor, std::string_view wanted);

/// Bounding boxes of the shapes in the region that differ from the domain: solids in air, cavities in rock.
Result<std::vector<IntBox>> shapesIn(const WorldField& world, const IntBox& region);

/// The box that extends 48 m from a place in both directions of each axis. place: metres.
IntBox surroundingsOf(const std::array<double, 3>& place);

/// The default region of an endless world: a box around an anchor. Of the anchors that isWanted() accepts and that lie
/// within 512 m of the world's origin on each axis, it is the nearest to the origin. If there is none, the region is a
/// box around the origin. If wanted_anchor is empty and there is no shape around the origin either, the region contains
/// the nearest shape, at most 8 km away on each axis, and the shapes that touch it, up to a size of 1 km. Errors: those
/// of derivation.
Result<IntBox> surroundings(const WorldField& world, std::string_view wanted_anchor);

}  // namespace sgm::cli
