#pragma once
// The land that is drawn beyond the end of the meshed world, up to the horizon.

#include <cstdint>
#include <optional>

#include "tools/render/scene.h"

namespace sgm {

/// A horizontal plane around the world.
struct Land {
  /// A value of `material`: meadows, used if the world has no ground of its own.
  static constexpr uint32_t kMeadow = UINT32_MAX;

  float height = 0;       ///< metres from the scene's origin
  uint32_t material = 0;  ///< index of the material of most ground at the world's border
  bool bare = false;  ///< the material is rock, sand, gravel or snow: no meadows and woods are drawn in the distance
};

/// The ground at the border of the meshed world, on the side that the camera faces. Its height is the median over that
/// ground, weighted by area. Returns nullopt if too little of the border is ground below the camera, or the ground does
/// not end at the border. scene must be checked. May throw std::bad_alloc.
std::optional<Land> landAround(const RenderScene& scene);

/// The land under a world that consists of clouds only: meadows at the world's height 0 if the camera is above it.
/// Returns nullopt if the world has other parts, or no clouds.
std::optional<Land> landUnderClouds(const RenderScene& scene);

/// Horizontal distance from the camera to the farthest cloud, metres; 0 if there are no clouds.
float reachOfClouds(const RenderScene& scene);

}  // namespace sgm
