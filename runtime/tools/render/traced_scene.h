#pragma once
// The surfaces that light rays meet.

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tools/render/frame.h"
#include "tools/render/illuminated.h"
#include "tools/render/ray_caster.h"

namespace sgm {

inline constexpr float kLongestRay = 1e5f;  ///< metres

/// A surface that a ray hits.
struct MetSurface {
  vec3 position{0};
  vec3 normal{0};  ///< interpolated as for shading, unit length
  vec3 start{0};   ///< start of secondary rays: off the triangle, to follow the curved surface
  uint32_t triangle = 0;
  uint32_t material = 0;
  uint32_t second = 0;  ///< material to blend with
  float distance = -1;  ///< below 0: no surface

  bool isThere() const { return distance >= 0; }
};

/// Returns whether light passes through a material.
LetsLight letsLight(const RenderMaterial& material);

/// Start of the ray behind a window's surface: inside the pane, whose other side is then hit from inside.
inline vec3 behind(const MetSurface& pane, vec3 direction) { return pane.position + 2e-3f * direction; }

/// The mesh, the materials and the camera of one picture. Keeps references to them.
class TracedScene {
 public:
  TracedScene(const RenderScene& scene, const Frame& frame, const RayCaster& mesh)
      : scene_(scene), frame_(frame), mesh_(mesh) {}

  const RenderScene& scene() const { return scene_; }
  const Frame& frame() const { return frame_; }
  const RayCaster& mesh() const { return mesh_; }

  /// Through a pixel's first sample, or `off` pixels beside it.
  vec3 directionAt(uint32_t x, uint32_t y, glm::vec2 off = glm::vec2(0)) const;
  /// The visible surface: skips gaps in crowns.
  MetSurface seenAt(uint32_t x, uint32_t y) const;
  /// The first surface on a ray, hit from its void side.
  MetSurface meet(vec3 from, vec3 direction) const;

  const RenderMaterial& material(uint32_t index) const {
    return scene_.materials[std::min<size_t>(index, scene_.materials.size() - 1)];
  }
  vec3 colourOf(uint32_t index) const { return material(index).colour; }
  /// Water, panes, and equally smooth paint.
  bool isMirror(uint32_t index) const;
  /// Panes through which the scene behind them is visible: see MaterialLook.
  bool isClear(uint32_t index) const;
  bool isLeaded(uint32_t index) const { return material(index).pattern == SurfacePattern::leaded; }
  /// Panes that transmit rays.
  bool isPane(uint32_t index) const { return isLeaded(index) || isClear(index); }
  bool isWater(uint32_t index) const { return material(index).pattern == SurfacePattern::water; }
  bool hasWater() const;

 private:
  bool isGap(const MetSurface& place, vec3 direction) const;

  const RenderScene& scene_;
  const Frame& frame_;
  const RayCaster& mesh_;
};

}  // namespace sgm
