#pragma once
// Finds the first hit of a ray with a mesh.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "base/result.h"
#include "tools/render/scene.h"

struct RTCSceneTy;

namespace sgm {

/// Whether a ray may slip through between two triangles that share an edge. tiny: rarely, but casting is faster.
/// closed: never.
enum class Gaps { tiny, closed };

/// Whether a material transmits light: in_spots for leaves, always for window panes and glowing lamps.
enum class LetsLight : uint8_t { never, in_spots, always };

struct RayHit {
  float distance = 0;     ///< distance of the hit in multiples of the length of the ray's direction vector
  bool front = false;     ///< true if the ray hits the triangle's front, which faces the void
  uint32_t triangle = 0;  ///< index of the triangle: its first vertex index is at 3 * triangle
  float u = 0, v = 0;     ///< barycentric weights of the triangle's second and third corners
  glm::vec3 facing{0};    ///< normal of the triangle, pointing into the void; not unit length
};

/// An Embree acceleration structure over triangles. Keeps references to its vertices and indices. All const functions
/// are thread-safe.
class RayCaster {
 public:
  /// Contract: every index is below vertices.size(). Error: out_of_memory.
  static Result<RayCaster> over(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                                Gaps gaps = Gaps::tiny);

  std::optional<RayHit> cast(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// Like cast(), but ignores hits on the back of a triangle: a viewer in the void does not see them.
  std::optional<RayHit> castFronts(glm::vec3 from, glm::vec3 direction, float max_distance) const;
  /// Makes isFree() let light pass through materials that transmit it. lets: an element for each material; the caller
  /// must keep the array alive. offset: RenderFrame::pattern_offset, metres, for the gaps between leaves.
  void loosen(std::span<const LetsLight> lets, glm::vec3 offset);
  /// Whether light from the end of the ray reaches its start. Only triangles whose front faces the light block it, and
  /// only if their material does not transmit light (see loosen()).
  bool isFree(glm::vec3 from, glm::vec3 direction, float max_distance) const;

  size_t triangleCount() const { return indices_.size() / 3; }
  const RenderVertex& vertex(uint32_t triangle, int corner) const {
    return vertices_[indices_[size_t{3} * triangle + static_cast<size_t>(corner)]];
  }
  glm::vec3 corner(uint32_t triangle, int i) const { return vertex(triangle, i).position; }
  /// Normal of a triangle, pointing into the void; not unit length.
  glm::vec3 facing(uint32_t triangle) const;
  /// Lower and upper corner of the mesh's bounding box; lo > hi if the mesh is empty.
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
  std::span<const LetsLight> lets_;  ///< indexed by material; if empty, no material transmits light
  glm::vec3 offset_{0};
  glm::vec3 lo_{1e30f}, hi_{-1e30f};
};

}  // namespace sgm
