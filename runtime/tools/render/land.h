#pragma once
// The land that continues beyond the drawn world.

#include <cstdint>
#include <optional>

#include "tools/render/scene.h"

namespace sgm {

/// A plane around the world, seen from above.
struct Land {
  static constexpr uint32_t kMeadow = UINT32_MAX;  ///< a material: meadows, since the world has no ground of its own

  float height = 0;       ///< metres from the scene's origin
  uint32_t material = 0;  ///< of most of the ground at the world's border
  bool bare = false;      ///< rock, sand, gravel or snow: no meadows and woods in the distance
};

/// The ground at the border of the drawn world, on the side that the camera looks at: at its median height, weighted by
/// area. nullopt if too little of the border is ground below the camera, or the ground is not cut off there. scene must
/// be checked. May throw std::bad_alloc.
std::optional<Land> landAround(const RenderScene& scene);

/// The land under a world of clouds alone: meadows at the world's height 0, if the camera is above it. nullopt if the
/// world has other parts, or none.
std::optional<Land> landUnderClouds(const RenderScene& scene);

/// Horizontal distance from the camera to the farthest cloud, metres; 0 without clouds.
float reachOfClouds(const RenderScene& scene);

}  // namespace sgm
