#pragma once
// The tangent planes of the surface of one level, and the creases in which two of them meet.
//
// If the normals of two vertices differ, their tangent planes meet in a CREASE. If a grid edge passes through a crease,
// linear interpolation between the values at its ends misses the surface: the vertex slides along its edge to the place
// where the field changes sign, which depends on that edge alone.

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
  int32_t q = 0;    ///< the value as quantised by meshing
  std::array<float, 3> gradient{};
  int16_t normal_x = 0, normal_y = 0;  ///< the gradient as a packed normal
};

enum class Sampled { value, all };

/// Samples the field of one level at points in units, many points per call; `value` computes no gradients.
using FieldSampler = std::function<void(std::span<const Int3> points, std::span<FieldSample> samples, Sampled what)>;

/// The plane tangent to the surface near a vertex: normal . (x - point) = distance.
struct Tangent {
  Int3 point;
  Vector3 normal{};  ///< of length one; 0 if the field has no gradient
  double distance = 0;
};

/// The normal is 0 if the field has no gradient.
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

/// A point in a face: along u = (axis + 1) % 3 and v = (axis + 2) % 3 from the face's corner, in units.
using FacePoint = std::array<double, 2>;

/// The tangents of a part's vertices, which all lie on edges of the grid. Throws std::bad_alloc.
class Creases {
 public:
  /// Borrows all arguments.
  Creases(const ChunkGrid& grid, const FieldSampler& field, MeshPart& part, std::pmr::memory_resource* memory);

  /// Finds the tangents of all vertices, and slides them. Call once.
  void settle();
  const Tangent& tangent(uint32_t vertex) const { return tangents_[vertex]; }

  /// True if the normals of two settled vertices differ enough for a feature between them, and neither vertex lies on
  /// the crease itself.
  bool isSharp(uint32_t a, uint32_t b) const;

  /// True if the normals of two settled vertices differ that much, wherever the crease lies.
  bool differ(uint32_t a, uint32_t b) const;

  /// The point on the crease of two planes that is nearest to `start`; both in units from `corner`.
  static Vector3 nearestOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& start);

  /// True if a point in units from `corner` lies on the crease of two planes, within the tolerance of surface points.
  bool isOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& place) const;

  /// The point where the crease of two planes meets the face across `axis` through `corner`; nullopt if it is
  /// ill-conditioned.
  static std::optional<FacePoint> meetingInFace(const Tangent& a, const Tangent& b, const Int3& corner, int axis);

  /// Rounds a point in units from a corner of the grid to 1/256 of a cell; nullopt if it lies more than kMostOutside
  /// beyond the corner's cell, or beyond its face across `across`. A point beyond the chunk is moved to 1/256 within
  /// it.
  std::optional<Int3> onGrid(const Int3& corner, const Vector3& units, int across = -1) const;
  /// Same as onGrid, for the point on the two planes' crease that is nearest to `units` and not too far beyond.
  std::optional<Int3> onGridAlong(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& units,
                                  int across) const;
  /// The point at which the field is sampled for such a place.
  Int3 sampledAt(const Int3& corner, const Int3& place) const;
  /// In units: the tolerance for a point on the surface, one unit of which allows for sampling at whole units.
  double mostOffSurface() const;
  bool isOnSurface(const FieldSample& sample) const;
  /// The vector from a corner to a vertex of the part, in units.
  Vector3 unitsFrom(const Int3& corner, uint32_t vertex) const;

 private:
  /// The allowed coordinates along an axis.
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
  std::pmr::vector<Tangent> tangents_;  ///< by vertex
  std::pmr::vector<Vector3> normals_;   ///< of the samples, rounded as packed; by vertex
};

}  // namespace sgm
