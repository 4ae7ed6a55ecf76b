#pragma once
// Noise in the shape of round puffs with smaller puffs on them, as on cumulus clouds.

#include <glm/vec3.hpp>

namespace sgm {

/// The noise at a position in metres: 0 in the middle of puffs, 1 in the creases between them. period: distance between
/// large puffs, metres. finest: minimum distance between the small puffs on them, metres. The noise repeats every 1024
/// m.
float puffHollows(glm::vec3 position, float period, float finest);

}  // namespace sgm
