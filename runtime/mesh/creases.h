#pragma once
// Where the surface of one level has creases: a point of each, on the sides of the loops that it crosses.
//
// A SIDE of a marching-cubes loop lies in a face of its cell and joins two vertices on edges of that face. Where the
// normals at its ends differ the two tangent planes meet in a crease, whose point nearest to the side is a FACE VERTEX.
// It follows from the side and the field around it alone, so that the cells on both sides of the face, chunks meshed
// apart, and seams, find the same. Where a grid edge passes through a crease the straight line between its ends' values
// misses the surface: its vertex slides along it to where the field changes sign, which depends on that edge alone.

#include <functional>
#include <memory_resource>
#include <optional>
#include <span>

#include "mesh/chunk.h"
#include "mesh/least_squares.h"

namespace sgm {

/// The field at a point: value in units, gradient, and the gradient as a packed normal.
struct FieldSample {
  float value = 0;
  std::array<float, 3> gradient{};
  int16_t normal_x = 0, normal_y = 0;
};

enum class Sampled { value, all };

/// Samples the field of one level at points in units, with many points at each call; only values where no more is
/// asked for.
using FieldSampler = std::function<void(std::span<const Int3> points, std::span<FieldSample> samples, Sampled what)>;

/// The plane that touches the surface near a vertex: normal . (x - point) = distance.
struct Tangent {
  Int3 point;
  Vector3 normal{};  ///< of length one; 0 where the field has no gradient
  double distance = 0;
};

/// From one point to another, exact.
inline Vector3 between(const Int3& from, const Int3& to) {
  return {static_cast<double>(int64_t{to.x} - from.x), static_cast<double>(int64_t{to.y} - from.y),
          static_cast<double>(int64_t{to.z} - from.z)};
}

/// The creases through one part, at one of its levels. What throws is memory.
class Creases {
 public:
  static constexpr uint32_t kNoVertex = UINT32_MAX;

  /// Borrows all. field: of that level, the chunk's own or the one above.
  Creases(const ChunkGrid& grid, int level, const FieldSampler& field, MeshPart& part,
          std::pmr::memory_resource* memory);

  int32_t cell() const { return cell_; }

  /// Finds the tangents of these vertices, which lie on edges of the level, and slides them. Once.
  void settle(std::span<const uint32_t> vertices);
  const Tangent& tangent(uint32_t vertex) const { return tangents_[vertex]; }

  /// Whether the normals of two settled vertices differ so far that a feature may lie between them.
  bool isSharp(uint32_t a, uint32_t b) const;

  /// Asks for the face vertex of a sharp side, in the face with this lowest corner that stands on `axis`.
  void add(uint32_t a, uint32_t b, const Int3& corner, int axis);
  /// Finds those that were asked for, and appends them to the part. Once.
  void place();
  /// The face vertex of a side that was asked for; kNoVertex where none lies on the surface.
  uint32_t faceVertex(uint32_t a, uint32_t b) const;

  /// A place from a corner of the level's grid, in 1/256 of its cell; none where it lies farther than a cell beyond the
  /// corner's cell, or its face across `across`, or outside of the world.
  std::optional<Int3> onGrid(const Int3& corner, const Vector3& units, int across = -1) const;
  /// Where the field is sampled for such a place.
  Int3 sampledAt(const Int3& corner, const Int3& place) const;
  /// Units. A unit is for sampling at whole ones.
  double mostOffSurface() const;
  bool isOnSurface(const FieldSample& sample) const;
  /// From a corner to a vertex of the part, in units.
  Vector3 unitsFrom(const Int3& corner, uint32_t vertex) const;
  /// Appends a feature vertex with the attributes of another.
  uint32_t append(const VertexKey& key, const Int3& place, uint32_t like);

 private:
  /// From the lower key to the higher: the direction in which all cells at the face see it.
  struct Side {
    uint32_t from, to;
    Int3 corner;
    int axis;
    uint32_t vertex = kNoVertex;
    bool sameEnds(const Side& other) const { return from == other.from && to == other.to; }
    friend bool operator<(const Side& a, const Side& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; }
  };

  void touch(std::span<const uint32_t> vertices);
  void slide(std::span<const uint32_t> vertices);
  Int3 pointOnEdge(uint32_t vertex, int32_t step) const;
  std::pmr::vector<FieldSample> sampleEdges(std::span<const uint32_t> vertices, std::span<const int32_t> steps,
                                            Sampled what = Sampled::all) const;
  std::optional<Int3> nearestOnCrease(const Side& side) const;
  Side withOrderedEnds(uint32_t a, uint32_t b) const;

  const ChunkGrid grid_;
  const int32_t cell_;  ///< of the level
  const FieldSampler& field_;
  MeshPart& part_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Tangent> tangents_;  ///< by vertex
  std::pmr::vector<Vector3> normals_;   ///< as packed from samples, by vertex
  std::pmr::vector<Side> sides_;
};

}  // namespace sgm
