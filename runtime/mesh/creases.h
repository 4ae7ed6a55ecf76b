#pragma once
// Where the surface of one level touches its tangent planes, and where two of these meet in a crease.
//
// Where the normals of two vertices differ, their tangent planes meet in a CREASE. Where a grid edge passes through a
// crease, the straight line between the values at its ends misses the surface: the vertex slides along its edge to the
// place at which the field changes sign, which depends on that edge alone.

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
  int32_t q = 0;    ///< the value as meshing quantises it
  std::array<float, 3> gradient{};
  int16_t normal_x = 0, normal_y = 0;  ///< the gradient as a packed normal
};

enum class Sampled { value, all };

/// Samples the field of one level at points in units, with many points at each call; `value` asks for no gradients.
using FieldSampler = std::function<void(std::span<const Int3> points, std::span<FieldSample> samples, Sampled what)>;

/// The plane that touches the surface near a vertex: normal . (x - point) = distance.
struct Tangent {
  Int3 point;
  Vector3 normal{};  ///< of length one; 0 where the field has no gradient
  double distance = 0;
};

/// 0 as its normal where the field has no gradient.
Tangent tangentAt(const Int3& point, const FieldSample& sample);

/// From one point to another, exact.
inline Vector3 between(const Int3& from, const Int3& to) {
  return {static_cast<double>(int64_t{to.x} - from.x), static_cast<double>(int64_t{to.y} - from.y),
          static_cast<double>(int64_t{to.z} - from.z)};
}

/// A place in 1/256 of a cell, in units.
inline Vector3 unitsOf(const Int3& place, int32_t cell) {
  const double step = static_cast<double>(cell) / kSubcell;
  return {place.x * step, place.y * step, place.z * step};
}

/// A point in a face: along u = (axis + 1) % 3 and v = (axis + 2) % 3 from the face's corner, in units.
using FacePoint = std::array<double, 2>;

/// The tangents of a part's vertices, which all lie on edges of the grid. Throws std::bad_alloc.
class Creases {
 public:
  /// Borrows all.
  Creases(const ChunkGrid& grid, const FieldSampler& field, MeshPart& part, std::pmr::memory_resource* memory);

  /// Finds the tangents of all vertices, and slides them. Once.
  void settle();
  const Tangent& tangent(uint32_t vertex) const { return tangents_[vertex]; }

  /// Whether the normals of two settled vertices differ so far that a feature may lie between them, and neither lies on
  /// the crease itself.
  bool isSharp(uint32_t a, uint32_t b) const;

  /// Whether the normals of two settled vertices differ so far, wherever the crease lies.
  bool differ(uint32_t a, uint32_t b) const;

  /// The place on the crease of two planes that is nearest to `start`; both in units from `corner`.
  static Vector3 nearestOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& start);

  /// Whether a place in units from `corner` lies on the crease of two planes, as closely as places on the surface do.
  bool isOnCrease(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& place) const;

  /// Where the crease of two planes meets the face across `axis` through `corner`; nullopt where that is not known
  /// well.
  static std::optional<FacePoint> meetingInFace(const Tangent& a, const Tangent& b, const Int3& corner, int axis);

  /// A place in units from a corner of the grid, in 1/256 of a cell; nullopt if it lies farther than kMostOutside
  /// beyond the corner's cell, or beyond its face across `across`. A place beyond the chunk is moved to 1/256 within
  /// it.
  std::optional<Int3> onGrid(const Int3& corner, const Vector3& units, int across = -1) const;
  /// As onGrid, of the point of two planes' crease nearest to `units`, which lies on it, that is not too far beyond.
  std::optional<Int3> onGridAlong(const Tangent& a, const Tangent& b, const Int3& corner, const Vector3& units,
                                  int across) const;
  /// Where the field is sampled for such a place.
  Int3 sampledAt(const Int3& corner, const Int3& place) const;
  /// In units: how far a point on the surface may seem to be off it, a unit of which is for sampling at whole units.
  double mostOffSurface() const;
  bool isOnSurface(const FieldSample& sample) const;
  /// From a corner to a vertex of the part, in units.
  Vector3 unitsFrom(const Int3& corner, uint32_t vertex) const;

 private:
  /// Where places may lie on an axis.
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
  std::pmr::vector<Vector3> normals_;   ///< as packed from samples, by vertex
};

}  // namespace sgm
