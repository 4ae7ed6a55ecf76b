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

/// Whether a ray may pass between two triangles that share an edge (tiny gaps, faster) or never does (closed).
enum class Gaps { tiny, closed };

/// Whether a material transmits light: leaves do in spots; panes of lamps and stained glass do everywhere.
enum class LetsLight : uint8_t { never, in_spots, always };

struct RayHit {
  float distance = 0;     ///< in multiples of the length of the ray's direction
  bool front = false;     ///< the surface was hit from its void side
  uint32_t triangle = 0;  ///< number of the triangle: its first index divided by three
  float u = 0, v = 0;     ///< barycentric weights of the triangle's second and third corner
  glm::vec3 facing{0};    ///< the triangle's normal, not normalised; points to the void side
};

/// An Embree tree over triangles. Keeps references to the passed spans. Any number of threads may cast rays
/// concurrently.
class RayCaster {
 public:
  /// Every index must be below vertices.size(). Error: out_of_memory.
  static Result<RayCaster> over(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                                Gaps gaps = Gaps::tiny);

  std::optional<RayHit> cast(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// As cast(), but ignores triangles that are hit from inside the solid, which an eye does not see.
  std::optional<RayHit> castFronts(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// From now on, isFree() lets light pass through bodies according to `lets`, indexed by material. offset: vector from
  /// the scene's origin to the origin of the patterns, metres. Keeps a reference to the span.
  void loosen(std::span<const LetsLight> lets, glm::vec3 offset);
  /// Whether light travels along the ray from its end to its start. Triangles that face the start do not block the
  /// light, since they show it their back; nor do bodies whose materials transmit light (loosen()).
  bool isFree(glm::vec3 from, glm::vec3 direction, float max_distance) const;

  size_t triangleCount() const { return indices_.size() / 3; }
  const RenderVertex& vertex(uint32_t triangle, int corner) const {
    return vertices_[indices_[size_t{3} * triangle + static_cast<size_t>(corner)]];
  }
  glm::vec3 corner(uint32_t triangle, int i) const { return vertex(triangle, i).position; }
  /// Not normalised; points to the void side.
  glm::vec3 facing(uint32_t triangle) const;
  /// Bounds of the mesh; lo > hi if the mesh is empty.
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
  std::span<const LetsLight> lets_;  ///< indexed by material; empty: no material transmits light
  glm::vec3 offset_{0};
  glm::vec3 lo_{1e30f}, hi_{-1e30f};
};

}  // namespace sgm
