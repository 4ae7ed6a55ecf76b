#pragma once
// Noise of round puffs with smaller puffs on them, as clouds have.

#include <glm/vec3.hpp>

namespace sgm {

/// From 0 in the middle of puffs to 1 in the creases between them, at a position in metres. Puffs are about `period`
/// metres apart, with smaller ones down to `finest` metres. The noise repeats every 1024 m.
float puffHollows(glm::vec3 position, float period, float finest);

}  // namespace sgm
