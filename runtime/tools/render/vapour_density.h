#pragma once
// The density of clouds inside their mesh.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/jobs.h"
#include "tools/render/ray_caster.h"

namespace sgm {

/// A lattice of points over a box.
struct Lattice {
  glm::vec3 corner{0};  ///< the first point, metres from the scene's origin
  float spacing = 1;    ///< metres
  glm::ivec3 size{0};   ///< points, at least 2 on each axis

  size_t count() const { return size_t(size.x) * size_t(size.y) * size_t(size.z); }
  size_t at(int x, int y, int z) const { return (size_t(z) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x); }
};

/// The density of clouds: the share of each lattice cell inside their mesh, softened over neighbouring cells. Ray
/// marching can skip empty bricks of cells.
class VapourDensity {
 public:
  static constexpr int kBrick = 8;  ///< cells on an edge of a brick

  /// `outline` has the triangles of clouds, at least one. May throw std::bad_alloc.
  VapourDensity(const RayCaster& outline, JobSystem& jobs);

  const Lattice& lattice() const { return lattice_; }
  /// The distance in metres at which full density reduces light to 1/e.
  float meanFreePath() const { return mean_free_path_; }
  /// The softened outline of the mesh, 0..1 and 0.5 at the mesh, at a place in cells from the lattice's first point.
  float outlineAt(glm::vec3 place) const;
  /// The density without detail, 0..1.
  float plainAt(glm::vec3 place) const;
  /// The material there.
  uint32_t materialAt(glm::vec3 place) const;
  bool isEmptyBrick(glm::ivec3 brick) const { return bricks_[brickIndex(brick)] == kEmpty; }
  glm::ivec3 bricks() const { return brick_count_; }
  /// A distance beyond t on a ray, in cells, that is certainly empty: 0 in a brick with density. No component of
  /// direction may be 0.
  float emptyAhead(glm::vec3 from, glm::vec3 direction, float t) const;
  /// The distances at which a ray in cells enters and leaves the lattice; it misses if y <= x. No component of
  /// direction may be 0.
  glm::vec2 crossing(glm::vec3 from, glm::vec3 direction) const;
  glm::vec3 placeOf(glm::vec3 position) const { return (position - lattice_.corner) / lattice_.spacing; }

 private:
  static constexpr uint16_t kEmpty = 0xFFFF;

  size_t brickIndex(glm::ivec3 b) const {
    return (size_t(b.z) * size_t(brick_count_.y) + size_t(b.y)) * size_t(brick_count_.x) + size_t(b.x);
  }
  void fillColumns(const RayCaster& outline, JobSystem& jobs);
  void soften(int reach, JobSystem& jobs);
  void markBricks(JobSystem& jobs);
  bool hasOutline(glm::ivec3 brick) const;

  Lattice lattice_;
  std::vector<uint8_t> outline_;  ///< by point, 255ths
  std::vector<uint16_t> bricks_;  ///< the material in each brick, or kEmpty
  glm::ivec3 brick_count_{0};
  float mean_free_path_ = 1;
};

}  // namespace sgm
