#pragma once
// The surfaces of a scene that rays hit.

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tools/render/frame.h"
#include "tools/render/illuminated.h"
#include "tools/render/ray_caster.h"

namespace sgm {

inline constexpr float kLongestRay = 1e5f;  ///< metres

/// The point at which a ray hits a surface.
struct MetSurface {
  vec3 position{0};
  vec3 normal{0};  ///< unit normal, interpolated between the corners
  vec3 start{0};   ///< start of secondary rays, lifted off the triangle to the curved surface
  uint32_t triangle = 0;
  uint32_t material = 0;
  uint32_t second = 0;  ///< index of the second material, which is blended with `material`
  float distance = -1;  ///< metres from the ray's start; negative if the ray hits no surface

  bool isThere() const { return distance >= 0; }
};

/// Whether a material transmits light.
LetsLight letsLight(const RenderMaterial& material);

/// Start of the ray that continues behind a window pane. It lies just inside the pane: the ray then hits the back of
/// the pane's far side, and hits on backs are ignored.
inline vec3 behind(const MetSurface& pane, vec3 direction) { return pane.position + 2e-3f * direction; }

/// The mesh, the materials and the camera of a picture, for ray tracing. Keeps references to its arguments.
class TracedScene {
 public:
  TracedScene(const RenderScene& scene, const RenderFrame& frame, const RayCaster& mesh)
      : scene_(scene), frame_(frame), mesh_(mesh) {}

  const RenderScene& scene() const { return scene_; }
  const RenderFrame& frame() const { return frame_; }
  const RayCaster& mesh() const { return mesh_; }

  /// Direction from the eye through the first sample of pixel (x, y), shifted by `off` pixels.
  vec3 directionAt(uint32_t x, uint32_t y, glm::vec2 off = glm::vec2(0)) const;
  /// The visible surface at the first sample of pixel (x, y); looks through the gaps in tree crowns.
  MetSurface seenAt(uint32_t x, uint32_t y) const;
  /// The first hit of a ray on the front of a triangle.
  MetSurface meet(vec3 from, vec3 direction) const;

  const RenderMaterial& material(uint32_t index) const {
    return scene_.materials[std::min<size_t>(index, scene_.materials.size() - 1)];
  }
  vec3 colourOf(uint32_t index) const { return material(index).colour; }
  /// Whether a material reflects like a mirror: true for water, glass panes and very smooth paint.
  bool isMirror(uint32_t index) const;
  /// Whether a material is a clear window pane, which shows the scene behind it; see kClearPane.
  bool isClear(uint32_t index) const;
  bool isLeaded(uint32_t index) const { return material(index).pattern == SurfacePattern::leaded; }
  /// Whether a material is a window pane that rays pass through.
  bool isPane(uint32_t index) const { return isLeaded(index) || isClear(index); }
  bool isWater(uint32_t index) const { return material(index).pattern == SurfacePattern::water; }
  bool hasWater() const;

 private:
  bool isGap(const MetSurface& place, vec3 direction) const;

  const RenderScene& scene_;
  const RenderFrame& frame_;
  const RayCaster& mesh_;
};

}  // namespace sgm
