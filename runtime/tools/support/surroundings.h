#pragma once
// Which part of an endless world is drawn where nobody says.

#include <array>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// Whether an anchor's name, kind or tag is the one asked for; none asked for is any.
bool isWanted(const Program& program, const Anchor& anchor, std::string_view wanted);

/// The boxes, in the region, of what differs from the domain's own state: of shapes in air, of what is cut in rock.
Result<std::vector<IntBox>> shapesIn(const WorldField& world, const IntBox& region);

/// 48 m to each side of a place in metres.
IntBox surroundingsOf(const std::array<double, 3>& place);

/// What lies around the wanted anchor that is nearest to the world's origin. Where there is none within 512 m and none
/// was asked for, what lies around the origin; and where nothing does, the shapes nearest to it: those, up to 8 km off,
/// whose boxes touch that of the nearest, as far as all are within 1 km. Errors: those of derivation.
Result<IntBox> surroundings(const WorldField& world, std::string_view wanted_anchor);

}  // namespace sgm::cli
