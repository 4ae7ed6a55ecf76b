#pragma once
// Finds where a ray first hits a mesh.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "base/result.h"
#include "tools/render/scene.h"

struct RTCSceneTy;

namespace sgm {

/// Whether a ray may slip between two triangles that share an edge, which is faster, or never does.
enum class Gaps { tiny, closed };

/// Whether a material transmits light: leaves do in spots, panes of lamps and stained glass everywhere.
enum class LetsLight : uint8_t { never, in_spots, always };

struct RayHit {
  float distance = 0;     ///< in lengths of the ray's direction
  bool front = false;     ///< the surface was hit from its void side
  uint32_t triangle = 0;  ///< index of the triangle
  float u = 0, v = 0;     ///< weights of the triangle's second and third corner
  glm::vec3 facing{0};    ///< not normalised; points to the void side
};

/// An Embree tree over triangles. It keeps references to the spans; any number of threads may cast.
class RayCaster {
 public:
  /// Every index must be below vertices.size(). Error: out_of_memory.
  static Result<RayCaster> over(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                                Gaps gaps = Gaps::tiny);

  std::optional<RayHit> cast(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// The same, but ignores triangles that are hit from inside the solid, as for an eye.
  std::optional<RayHit> castFronts(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// From now on, light passes through bodies according to `lets` of their materials. offset: from the scene's origin
  /// to the patterns' own, metres. Keeps a reference to the span.
  void loosen(std::span<const LetsLight> lets, glm::vec3 offset);
  /// Whether light travels the ray from its end to its start: triangles that face the start do not block it, since they
  /// show their back to the light; nor do bodies passed to loosen().
  bool isFree(glm::vec3 from, glm::vec3 direction, float max_distance) const;

  size_t triangleCount() const { return indices_.size() / 3; }
  const RenderVertex& vertex(uint32_t triangle, int corner) const {
    return vertices_[indices_[size_t{3} * triangle + static_cast<size_t>(corner)]];
  }
  glm::vec3 corner(uint32_t triangle, int i) const { return vertex(triangle, i).position; }
  /// Not normalised; points to the void side.
  glm::vec3 facing(uint32_t triangle) const;
  /// Bounds of the mesh; lo > hi if it is empty.
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
  std::span<const LetsLight> lets_;  ///< by material; empty: none transmits
  glm::vec3 offset_{0};
  glm::vec3 lo_{1e30f}, hi_{-1e30f};
};

}  // namespace sgm
