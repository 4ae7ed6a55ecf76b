#pragma once
// The tangent planes of the surface of one level, and the creases in which two of them meet.
//
// If the normals of two vertices differ, their tangent planes meet in a CREASE. If a grid edge passes through a crease,
// linear interpolation between the values at the edge's ends gives a point off the surface. Such a vertex slides along
// its edge to the point where the field changes sign. That point depends on the edge alone, so that all cells and
// chunks around the edge agree.

#include <array>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "mesh/chunk.h"
#include "mesh/feature_reach.h"
#include "mesh/least_squares.h"

namespace sgm {

/// The field at a point.
struct FieldSample {
  float value = 0;  ///< units
  int32_t q = 0;    ///< value, quantised as for ChunkSamples::q
  std::array<float, 3> gradient{};
  int16_t normal_x = 0, normal_y = 0;  ///< the gradient, packed as a vertex normal
};

/// Selects what a FieldSampler computes: values alone, or gradients as well.
enum class Sampled { value, all };

/// Samples the field of one level at points in units; `samples` receives one entry per point. Callers pass many points
/// per call.
using FieldSampler = std::function<void(std::span<const Int3> points, std::span<FieldSample> samples, Sampled what)>;

/// The plane tangent to the surface near a vertex: normal . (x - point) = distance.
struct Tangent {
  Int3 point;
  Vector3 normal{};  ///< unit normal; 0 if the field has no gradient there
  double distance = 0;
};

/// Returns the tangent plane at a point, from the field's sample there. The normal is 0 if the field has no gradient.
Tangent tangentAt(const Int3& point, const FieldSample& sample);

/// The vector from one point to another, exact.
inline Vector3 between(const Int3& from, const Int3& to) {
  return {static_cast<double>(int64_t{to.x} - from.x), static_cast<double>(int64_t{to.y} - from.y),
          static_cast<double>(int64_t{to.z} - from.z)};
}

/// Converts a position in 1/256 of a cell to units.
inline Vector3 unitsOf(const Int3& place, int32_t cell) {
  const double step = static_cast<double>(cell) / kSubcell;
  return {place.x * step, place.y * step, place.z * step};
}

/// A point in a face, relative to the face's lowest corner: its distances along u = (axis + 1) % 3 and v = (axis + 2) %
/// 3, in units.
using FacePoint = std::array<double, 2>;

/// The tangent planes of a part's vertices, all of which must lie on edges of the grid. Throws std::bad_alloc.
class Creases {
 public:
  /// Borrows all arguments.
  Creases(const ChunkGrid& grid, const FieldSampler& field, MeshPart& part, std::pmr::memory_resource* memory);

  /// Computes the tangents of all vertices, and slides vertices near a crease along their edges. Call once.
  void settle();
  const Tangent& tangent(uint32_t vertex) const { return tangents_[vertex]; }

  /// True if a feature vertex is needed between two vertices: their normals (after settle()) differ enough, and neither
  /// vertex lies on the crease itself.
  bool isSharp(uint32_t a, uint32_t b) const;

  /// True if the normals of two vertices differ enough; unlike isSharp(), also if one of the vertices lies on the
  /// crease itself.
  bool differ(uint32_t a, uint32_t b) const;

  /// Returns the point on the crease of two planes that is nearest to `start`. Both points are in units from `corner`.
  static Vector3 nearestOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& start);

  /// True if a point lies on the crease of two planes, within maxOffSurface(). place: the point, in units from
  /// `corner`.
  bool isOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& place) const;

  /// Returns the point where the crease of two planes meets the face through `corner` with a normal along `axis`;
  /// nullopt if the intersection is ill-conditioned.
  static std::optional<FacePoint> meetingInFace(const Tangent& a, const Tangent& b, const Int3& corner, int axis);

  /// Rounds a point to 1/256 of a cell. units: the point, in units from `corner`, which is the lowest corner of a grid
  /// cell. nullopt if the point lies more than kMaxOutside beyond that cell. `across` (-1: none) is an axis with a
  /// stricter limit: along it, the point must lie within kMaxOutside of the cell's low face. A point beyond the chunk
  /// is moved to 1/256 of a cell inside the chunk.
  std::optional<Int3> onGrid(const Int3& corner, const Vector3& units, int across = -1) const;
  /// Same as onGrid, but first moves the point `units`, which must lie on the crease of the two planes, along this
  /// crease to the nearest point in the allowed range. nullopt if no point of the crease is in that range.
  std::optional<Int3> onGridAlong(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& units,
                                  int across) const;
  /// Returns the point, in whole units, at which the field is sampled for `place`, a result of onGrid().
  Int3 sampledAt(const Int3& corner, const Int3& place) const;
  /// Returns the tolerance, in units, for points on the surface. It includes one unit because the field is sampled at
  /// whole units.
  double maxOffSurface() const;
  bool isOnSurface(const FieldSample& sample) const;
  /// The vector from a corner to a vertex of the part, in units.
  Vector3 unitsFrom(const Int3& corner, uint32_t vertex) const;

 private:
  /// The range of allowed coordinates along an axis, in 1/256 of a cell.
  struct Range {
    int32_t least, most;
  };
  Range rangeOn(int axis, const Int3& corner, int across) const;
  void touch();
  void slide();
  Int3 pointOnEdge(uint32_t vertex, int32_t step) const;
  std::pmr::vector<FieldSample> sampleEdges(std::span<const uint32_t> vertices, std::span<const int32_t> steps,
                                            Sampled what = Sampled::all) const;

  const ChunkGrid grid_;
  const FieldSampler& field_;
  MeshPart& part_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Tangent> tangents_;  ///< tangent plane at each vertex
  std::pmr::vector<Vector3> normals_;   ///< normal at each vertex, rounded to the packed format
};

}  // namespace sgm
