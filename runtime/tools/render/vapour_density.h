#pragma once
// The density of clouds within the mesh that bounds them.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/jobs.h"
#include "tools/render/ray_caster.h"

namespace sgm {

/// A regular lattice of points with equal spacing on all axes.
struct VapourLattice {
  glm::vec3 corner{0};  ///< position of the first point, metres from the scene's origin
  float spacing = 1;    ///< distance in metres between neighbouring points along each axis
  glm::ivec3 size{0};   ///< number of points along each axis, at least 2

  size_t count() const { return size_t(size.x) * size_t(size.y) * size_t(size.z); }
  size_t at(int x, int y, int z) const { return (size_t(z) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x); }
};

/// The density of clouds on a lattice: the share of each cell that is inside the clouds' mesh, smoothed. Cells are
/// grouped into bricks, so that ray marching can skip empty bricks.
class VapourDensity {
 public:
  static constexpr int kBrick = 8;  ///< number of cells along the edge of a brick

  /// outline: ray caster over the triangles of all clouds, at least one triangle. May throw std::bad_alloc.
  VapourDensity(const RayCaster& outline, JobSystem& jobs);

  const VapourLattice& lattice() const { return lattice_; }
  /// Mean free path of light at full density, in metres.
  float meanFreePath() const { return mean_free_path_; }
  /// The smoothed share of the surroundings of `place` that is inside the mesh, 0..1; about 0.5 at the mesh's surface.
  /// place: in lattice spacings from the first lattice point.
  float outlineAt(glm::vec3 place) const;
  /// The density at a place without the detail of puffs, 0..1.
  float plainAt(glm::vec3 place) const;
  /// Index of the material at a place, the same throughout a brick.
  uint32_t materialAt(glm::vec3 place) const;
  bool isEmptyBrick(glm::ivec3 brick) const { return bricks_[brickIndex(brick)] == kEmpty; }
  glm::ivec3 bricks() const { return brick_count_; }
  /// The distance in cells from t to just behind the end of the empty brick at t, in which the ray meets no density; 0
  /// if the brick at t has density. Contract: no component of direction is 0.
  float emptyAhead(glm::vec3 from, glm::vec3 direction, float t) const;
  /// The distances in cells at which the ray enters (x) and leaves (y) the lattice; y <= x if the ray misses it.
  /// Contract: no component of direction is 0.
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

  VapourLattice lattice_;
  std::vector<uint8_t> outline_;  ///< for each lattice point: smoothed share that is inside the mesh, in 255ths
  std::vector<uint16_t> bricks_;  ///< for each brick: index of its material, or kEmpty if it has no density
  glm::ivec3 brick_count_{0};
  float mean_free_path_ = 1;
};

}  // namespace sgm
