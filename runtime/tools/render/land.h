#pragma once
// The land that is drawn between the end of the meshed world and the horizon.

#include <cstdint>
#include <optional>

#include "tools/render/scene.h"

namespace sgm {

/// A horizontal plane that continues the world's ground up to the horizon.
struct Land {
  /// Value of `material` for meadows, used if the world consists of clouds only.
  static constexpr uint32_t kMeadow = UINT32_MAX;

  float height = 0;       ///< metres above the scene's origin
  uint32_t material = 0;  ///< index of the most frequent material of the ground at the world's border
  bool bare = false;      ///< true if the material is rock, sand, gravel or snow: then no meadows and woods are drawn
};

/// The land that continues the ground at the meshed world's border, ahead of the camera. Its height is the
/// area-weighted median height of that ground. Returns nullopt if too little of the border is ground below the camera,
/// or if the ground ends before the border. Contract: the scene is checked. May throw std::bad_alloc.
std::optional<Land> landAround(const RenderScene& scene);

/// The land under a world that consists of clouds only: meadows at world height 0. Returns nullopt if the mesh has
/// other surfaces or no triangle, or if the camera is below the land.
std::optional<Land> landUnderClouds(const RenderScene& scene);

/// Horizontal distance in metres from the camera to the farthest vertex of a cloud; 0 if there are no clouds.
float reachOfClouds(const RenderScene& scene);

}  // namespace sgm
