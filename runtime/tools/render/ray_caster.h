#pragma once
// Where a ray first meets a mesh.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "base/result.h"
#include "tools/render/scene.h"

struct RTCSceneTy;

namespace sgm {

/// Whether a ray may slip through between two triangles that share an edge, for speed, or never does.
enum class Gaps { tiny, closed };

/// Whether light passes a material: it passes leaves in spots, and panes of lamps and of stained glass everywhere.
enum class LetsLight : uint8_t { never, in_spots, always };

struct RayHit {
  float distance = 0;     ///< in lengths of the ray's direction
  bool front = false;     ///< the surface was met from its void side
  uint32_t triangle = 0;  ///< index of the triangle
  float u = 0, v = 0;     ///< weights of the triangle's second and third corner
  glm::vec3 facing{0};    ///< not normalised; points to the void side
};

/// A tree over triangles, which Embree builds. It keeps references to the spans given; many threads may cast at once.
class RayCaster {
 public:
  /// Every index is below vertices.size(). Error: out_of_memory.
  static Result<RayCaster> over(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                                Gaps gaps = Gaps::tiny);

  std::optional<RayHit> cast(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// The same, but triangles that are met from inside the solid let the ray through, as they let the eye through.
  std::optional<RayHit> castFronts(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// Lets light pass bodies from now on, as `lets` says of their materials; offset: from the scene's origin to the
  /// patterns' own, metres. It keeps a reference to the span.
  void loosen(std::span<const LetsLight> lets, glm::vec3 offset);
  /// Whether light comes along the ray from its end: triangles that face the ray's start let it through, as they let an
  /// eye through at its end, and so do bodies that were loosened.
  bool isFree(glm::vec3 from, glm::vec3 direction, float max_distance) const;

  size_t triangleCount() const { return indices_.size() / 3; }
  const RenderVertex& vertex(uint32_t triangle, int corner) const {
    return vertices_[indices_[size_t{3} * triangle + static_cast<size_t>(corner)]];
  }
  glm::vec3 corner(uint32_t triangle, int i) const { return vertex(triangle, i).position; }
  /// Not normalised; points to the void side.
  glm::vec3 facing(uint32_t triangle) const;
  /// Bounds of the mesh; lo > hi where there is none.
  glm::vec3 lo() const { return lo_; }
  glm::vec3 hi() const { return hi_; }

 private:
  struct Release {
    void operator()(RTCSceneTy* scene) const;
  };

  RayCaster(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices)
      : vertices_(vertices), indices_(indices) {}

  std::span<const RenderVertex> vertices_;
  std::span<const uint32_t> indices_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
  std::span<const LetsLight> lets_;  ///< by material; empty: none does
  glm::vec3 offset_{0};
  glm::vec3 lo_{1e30f}, hi_{-1e30f};
};

}  // namespace sgm
