#pragma once
// The land that goes on where the world that is drawn ends.

#include <cstdint>
#include <optional>

#include "tools/render/scene.h"

namespace sgm {

/// A plane around the world, seen from above.
struct Land {
  static constexpr uint32_t kMeadow = UINT32_MAX;  ///< a material: meadows, for the world has no ground of its own

  float height = 0;       ///< metres from the scene's origin
  uint32_t material = 0;  ///< of most of the ground at the world's border
  bool bare = false;      ///< rock, sand, gravel or snow: no meadows and woods behind it
};

/// The ground at the border of what is drawn, on the side that the camera looks to: at its median height, by area.
/// nullopt: too little of the border is ground below the camera, or none of it is cut off there. scene must have been
/// checked. May throw std::bad_alloc.
std::optional<Land> landAround(const RenderScene& scene);

/// The land under a world that is nothing but clouds: meadows at the world's height 0, if the camera is above it.
/// nullopt: there is something else, or nothing.
std::optional<Land> landUnderClouds(const RenderScene& scene);

/// How far the clouds of a world reach, level, from the camera: metres, 0 if it has none.
float reachOfClouds(const RenderScene& scene);

}  // namespace sgm
