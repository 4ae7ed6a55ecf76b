#pragma once
// Light that arrives at surfaces from the sun, lamps and the sky, directly or after reflections.

#include "tools/render/sampling.h"
#include "tools/render/traced_scene.h"
#include "tools/render/vapour.h"

namespace sgm {

float luminance(vec3 colour);

/// Computes light in a traced scene, which is lit either by the sun and the sky, or by lamps. Keeps references to its
/// arguments.
class LightPaths {
 public:
  /// vapour: the scene's clouds, or null if there are none.
  LightPaths(const TracedScene& scene, const Vapour* vapour)
      : scene_(scene), vapour_(vapour), to_sun_(scene.frame().sun), sky_(scene.scene().background == Background::sky) {}

  /// True if the sun and the sky light the scene; false if lamps do.
  bool isUnderSky() const { return sky_; }
  /// Number of direct lights: 1 (the sun), or the number of lamps.
  uint32_t lights() const { return sky_ ? 1 : scene_.frame().counts.x; }

  /// Returns the light that a place would receive from light source number `light` if nothing blocked it.
  vec3 lightOf(uint32_t light, const MetSurface& place) const {
    return sky_ ? sunOn(place.normal) : lampOn(place.position, place.normal, light);
  }
  /// Returns the share, 0 to 1, of the light from light source number `light` that reaches a place.
  float openShare(uint32_t light, const MetSurface& place, UnitPoints& points) const {
    return sky_ ? sunShare(place, points) : lampShare(place, light, points);
  }

  /// Returns the light that arrives at `from` from the direction `direction`, traced over at most `bounces` surfaces.
  /// distance: receives the distance of the first hit, if there is a hit. mirrored: whether the ray is a visible
  /// reflection in a pane.
  vec3 radiance(vec3 from, vec3 direction, UnitPoints& turns, int bounces, float* distance = nullptr,
                bool mirrored = false) const;

 private:
  vec3 sunOn(vec3 n) const;
  vec3 lampOn(vec3 p, vec3 n, uint32_t lamp) const;
  float sunShare(const MetSurface& place, UnitPoints& points) const;
  float lampShare(const MetSurface& place, uint32_t lamp, UnitPoints& points) const;
  /// Direct light of the sun, or of all lamps, on a place that is seen in a mirror. In contrast to lit(), which chooses
  /// one lamp at random, this function adds up all lamps: noise would be visible in a mirror.
  vec3 litByAll(const MetSurface& place, UnitPoints& turns) const;
  /// Direct light of the sun, or an estimate of the lamps' light from one random lamp. The probability of choosing a
  /// lamp is proportional to its light without shadows.
  vec3 lit(const MetSurface& place, glm::vec2 turn) const;
  /// The sky's radiance with fair-weather clouds. A visible reflection (mirrored) shows single clouds; other rays get
  /// the mean share of the sky that the clouds cover.
  vec3 skyIn(vec3 from, vec3 direction, bool mirrored) const;

  const TracedScene& scene_;
  const Vapour* vapour_;
  vec3 to_sun_;
  bool sky_;
};

}  // namespace sgm
