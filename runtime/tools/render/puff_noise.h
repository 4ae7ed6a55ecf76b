#pragma once
// Noise of round puffs upon round puffs, as clouds have them.

#include <glm/vec3.hpp>

namespace sgm {

/// 0 in the middle of puffs to 1 in the creases between them, at a position in metres; about `period` metres from puff
/// to puff, with smaller ones upon them, as fine as `finest` metres. It repeats every 1024 m.
float puffHollows(glm::vec3 position, float period, float finest);

}  // namespace sgm
