#include "chunk/slab.h"

#include <cmath>

namespace sgm {

namespace {

/// Sets the second axis to the direction `along`, and the others to arbitrary perpendicular directions.
void axesAlong(Slab& slab, Vector3 along, double length) {
  const size_t least = static_cast<size_t>(
      std::min_element(along.begin(), along.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
      along.begin());
  Vector3 other{};
  other[least] = 1;
  const auto unit = [](const Vector3& v) {
    const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return size > 0 ? times(v, 1 / size) : Vector3{1, 0, 0};
  };
  slab.axes[1] = length > 0 ? unit(along) : Vector3{0, 1, 0};
  slab.axes[0] = unit(cross(slab.axes[1], other));
  slab.axes[2] = cross(slab.axes[0], slab.axes[1]);
}

}  // namespace

Int3 placeIn(const Slab& slab, const Vector3& offset) {
  Int3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = slab.middle[static_cast<size_t>(axis)] + offset[static_cast<size_t>(axis)];
    p[axis] = saturate(int64_t{slab.origin[axis]} + static_cast<int64_t>(std::floor(std::clamp(at, -2e9, 2e9) + 0.5)));
  }
  return p;
}

std::optional<Slab> slabOfShape(const GrammarChunk& chunk, const Shape& s) {
  Slab slab;
  slab.origin = s.frame.origin;
  for (size_t row = 0; row < 3; ++row)
    for (size_t i = 0; i < 3; ++i) slab.axes[row][i] = static_cast<double>(s.frame.rows[3 * row + i]);
  const auto size = [&](size_t i) { return static_cast<double>(s.size[i]); };
  switch (s.kind) {
    case ShapeKind::sphere:
      slab.half = {size(0), size(0), size(0)};
      return slab;
    case ShapeKind::box:
    case ShapeKind::ellipsoid:
    case ShapeKind::superquadric:
      slab.half = {size(0), size(1), size(2)};
      return slab;
    case ShapeKind::cylinder:
      slab.half = {size(0), size(1), size(0)};
      return slab;
    case ShapeKind::truncone: {
      const double widest = std::max(size(0), size(1));
      slab.half = {widest, size(2), widest};
      return slab;
    }
    case ShapeKind::capsule: {
      const Vector3 along{size(1), size(2), size(3)};
      const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
      axesAlong(slab, along, length);
      slab.middle = times(along, 0.5);
      slab.half = {size(0), size(0) + length / 2, size(0)};
      return slab;
    }
    case ShapeKind::torus:
      // A torus is represented by one stretch of its tube, tangential to the ring.
      slab.middle = times(slab.axes[0], size(0));
      slab.half = {size(1), size(1), std::max(size(0), size(1))};
      return slab;
    case ShapeKind::prism: {
      std::array<double, 2> low{1e30, 1e30}, high{-1e30, -1e30};
      for (uint32_t i = 0; i < s.point_count; ++i) {
        const Int3 corner = chunk.points[s.first_point + i];
        for (size_t k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], static_cast<double>(corner[k == 0 ? 0 : 2]));
          high[k] = std::max(high[k], static_cast<double>(corner[k == 0 ? 0 : 2]));
        }
      }
      if (s.point_count == 0) return std::nullopt;
      slab.middle = plus(times(slab.axes[0], (low[0] + high[0]) / 2), times(slab.axes[2], (low[1] + high[1]) / 2));
      slab.half = {(high[0] - low[0]) / 2, size(0), (high[1] - low[1]) / 2};
      return slab;
    }
    case ShapeKind::morph_power:
      for (size_t i = 0; i < 3; ++i) slab.half[i] = std::max(size(i), size(i + 3));
      return slab;
    case ShapeKind::halfspace:
    case ShapeKind::unite:
    case ShapeKind::meet:
    case ShapeKind::subtract:
    case ShapeKind::unite_smooth:
    case ShapeKind::meet_smooth:
    case ShapeKind::subtract_smooth:
    case ShapeKind::sum:
    case ShapeKind::morph:
    case ShapeKind::displace:
    case ShapeKind::warp:
    case ShapeKind::voxels:
      break;
  }
  return std::nullopt;
}

Slab slabOfSweep(const GrammarChunk& chunk, const Shape& sweep, int32_t cell_edge) {
  Slab slab;
  const uint32_t middle = sweep.first_point + (std::max(sweep.point_count, 2u) - 2) / 2;
  const Int3 from = chunk.points[middle],
             to = chunk.points[std::min(middle + 1, sweep.first_point + sweep.point_count - 1)];
  slab.origin = from;
  const Vector3 along{static_cast<double>(int64_t{to.x} - from.x), static_cast<double>(int64_t{to.y} - from.y),
                      static_cast<double>(int64_t{to.z} - from.z)};
  const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
  axesAlong(slab, along, length);
  slab.middle = times(along, 0.5);
  const double r = static_cast<double>(sweep.size[0]);
  // The box may be longer than the piece, since the sweep continues at both ends of the piece.
  slab.half = {r, std::max(r + length / 2, 0.5 * cell_edge), r};
  return slab;
}

}  // namespace sgm
