#pragma once
// The density of clouds inside the mesh that bounds them.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/jobs.h"
#include "tools/render/ray_caster.h"

namespace sgm {

/// A regular lattice of points over a box.
struct Lattice {
  glm::vec3 corner{0};  ///< position of the first point, metres from the scene's origin
  float spacing = 1;    ///< distance in metres between neighbouring points on every axis
  glm::ivec3 size{0};   ///< number of points on each axis, at least 2

  size_t count() const { return size_t(size.x) * size_t(size.y) * size_t(size.z); }
  size_t at(int x, int y, int z) const { return (size_t(z) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x); }
};

/// The density of clouds: the share of each lattice cell that is inside the clouds' mesh, smoothed over neighbouring
/// cells. Ray marching can skip empty bricks of cells.
class VapourDensity {
 public:
  static constexpr int kBrick = 8;  ///< number of cells along the edge of a brick

  /// `outline` has the triangles of all clouds, at least one. May throw std::bad_alloc.
  VapourDensity(const RayCaster& outline, JobSystem& jobs);

  const Lattice& lattice() const { return lattice_; }
  /// Distance in metres at which full density reduces light to 1/e.
  float meanFreePath() const { return mean_free_path_; }
  /// The smoothed share of the mesh's inside at a place, 0..1, which is 0.5 at the mesh. place: in lattice spacings
  /// from the first point.
  float outlineAt(glm::vec3 place) const;
  /// The density at a place without small-scale detail, 0..1.
  float plainAt(glm::vec3 place) const;
  /// Index of the material at a place.
  uint32_t materialAt(glm::vec3 place) const;
  bool isEmptyBrick(glm::ivec3 brick) const { return bricks_[brickIndex(brick)] == kEmpty; }
  glm::ivec3 bricks() const { return brick_count_; }
  /// A distance beyond t, in cells, for which a ray certainly meets no density; 0 in a brick with density. No component
  /// of direction may be 0.
  float emptyAhead(glm::vec3 from, glm::vec3 direction, float t) const;
  /// The distances, in cells, at which a ray enters (x) and leaves (y) the lattice; y <= x if the ray misses it. No
  /// component of direction may be 0.
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
  std::vector<uint8_t> outline_;  ///< for each lattice point: the smoothed share of the inside, in 255ths
  std::vector<uint16_t> bricks_;  ///< for each brick: the index of its material, or kEmpty
  glm::ivec3 brick_count_{0};
  float mean_free_path_ = 1;
};

}  // namespace sgm
