#pragma once
// What is uneven about panes, and the clouds that show in them.

#include <cmath>

#include "render/illuminated.h"
#include "render/puff_noise.h"

namespace sgm {

/// The normal of a pane at a place in the patterns' own metres: panes are set by hand and drawn unevenly, and each
/// mirrors another part of the sky, a little bent.
inline vec3 paneNormal(vec3 normal, vec3 p) {
  const vec3 wave(std::sin(1.9f * p.y + 0.7f * p.x), std::sin(2.3f * (p.x + p.z) + 0.6f * p.y),
                  std::sin(1.7f * p.z + 1.1f * p.y));
  return glm::normalize(normal + 0.022f * wave);
}

/// How much of a fair sky clouds hide in a direction upwards, roughly as shaders/render/clouds.glsl draws them.
inline float mirroredClouds(vec3 direction) {
  const vec3 level = 300.0f * direction / (direction.y + 0.12f);
  return 0.8f * smoothstep(0.45f, 0.85f, 1 - puffHollows(vec3(level.x, 0, level.z), 128, 8));
}

}  // namespace sgm
