#pragma once
// Loops of marching cubes with sharp features (after Kobbelt et al. 2001, "Feature Sensitive Surface Extraction from
// Volume Data").
//
// A SIDE of a loop lies in a face of its cell and joins two vertices on edges of that face. If the normals at its ends
// differ, the two tangent planes meet in a crease, and the side is SHARP: it may have a FACE VERTEX on the crease. A
// loop with sharp sides becomes a fan around a CELL VERTEX, the point nearest to the planes of the loop's own vertices.
// The creases from there to the face vertices divide the fan into PATCHES, each approximately planar. A patch that is
// not entirely visible from the cell vertex gets other diagonals (mesh/fan_triangles.h). If two creases pass through a
// cell and do not meet, the loop has no cell vertex: it is a STRIP. If a crease passes through a loop's vertices, its
// sides are not sharp, but it becomes a fan, too.
//
// Validity takes precedence over sharpness. A loop whose fan intersects another triangle (mesh/triangle_faults.h) is
// ROUNDED: it keeps its own triangles, as without features, and its sides lose their face vertices.
//
// The sides in a face of the CHUNK are an exception. Their face vertices, two if a third plane cuts off the crease of
// the other two, lie in that face and depend only on the field near it (mesh/border_vertices.h); all other features of
// a chunk lie strictly inside it. So the bodies on both sides of a face, of one level or two, and the seam between
// them, which lies in the face, meet only where they should, whatever happens to the loops of each: chunks that are
// meshed separately agree without communication. A rounded loop keeps these face vertices, and is a fan around a point
// strictly within its own cell (roundedCentre).
//
// Rounded loops never intersect each other, so that rounding terminates. Such a fan is a cone over a simple polygon on
// the boundary of its cell, which is convex: it stays in the cell, and has no other point in common with the boundary.
// If the cell has another loop, the cone is tested against it (mesh/rounded_cells.h). If a face vertex lies outside the
// side's square, the centre is 1/256 of a cell away from the chunk's face, and so is the part of the cone beyond the
// cell. If no contour crosses the square of the face beneath it, triangles there whose corners are not in the face are
// at least 1/256 away; otherwise the cone is tested against the loops there. If several sides have a face vertex in one
// such square, each stays in its own part of it, or its cone is tested against those of the others
// (mesh/surroundings.h).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "mesh/body_loops.h"
#include "mesh/creases.h"
#include "mesh/loop_triangles.h"

namespace sgm {

/// The positions of the face vertices of one side, ordered from its lower end: one, or two if a third plane cuts off
/// the crease of the ends' planes. In 1/256 of a cell from the side's corner.
class FacePlaces {
 public:
  static constexpr size_t kMost = 2;

  FacePlaces() = default;
  explicit FacePlaces(const Int3& only) : places_{only}, count_(1) {}
  FacePlaces(const Int3& first, const Int3& second) : places_{first, second}, count_(2) {}

  bool empty() const { return count_ == 0; }
  size_t count() const { return count_; }
  std::span<const Int3> all() const { return {places_.data(), count_}; }

 private:
  std::array<Int3, kMost> places_;
  uint32_t count_ = 0;
};

/// A side whose ends have different normals.
struct SharpSide {
  static constexpr uint32_t kNone = UINT32_MAX;

  uint32_t from = 0, to = 0;                    ///< vertices; the lower key first, so both cells have the same side
  Int3 corner;                                  ///< the lowest of its face, in units
  int axis = 0;                                 ///< the normal axis of its face
  bool at_border = false;                       ///< its face is part of a face of the chunk
  std::array<uint32_t, 2> loops{kNone, kNone};  ///< indices of its sharp loops, the one in the lower cell first
  std::optional<Tangent> third;                 ///< tangent at the point where its ends' planes meet, off the surface
  FacePlaces places;                            ///< empty if it cannot have a face vertex; two only at the border

  friend bool operator<(const SharpSide& a, const SharpSide& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  }
};

/// Returns the side between two vertices, given by indices into keys. Fills from, to, corner and axis; the other
/// members keep their defaults.
SharpSide sideBetween(uint32_t a, uint32_t b, const RawVector<VertexKey>& keys);

/// True if a side is in a face of the chunk.
bool isAtBorder(const ChunkGrid& grid, const SharpSide& side);

/// Converts a position relative to the side's corner to one relative to the chunk's origin; both in 1/256 of a cell.
Int3 fromChunk(const ChunkGrid& grid, const SharpSide& side, const Int3& place);

/// Returns the key of a side's face vertex. from: the key of the vertex side.from. which: 0, or 1 for the second face
/// vertex of the side.
VertexKey faceVertexKey(const SharpSide& side, const VertexKey& from, size_t which);

/// A face vertex in a face of the chunk.
struct BorderVertex {
  Int3 at;
  int axis = 0;  ///< the normal axis of the face
};

/// Returns the centre of a rounded loop with face vertices in a face of the chunk, strictly within its cell. It is the
/// mean of the loop's vertices; but if a face vertex lies beyond the cell's square, it is 1/256 of a cell from the
/// face, so that nothing else lies between the fan and the face. All positions are in 1/256 of a cell from one origin.
Int3 roundedCentre(const Int3& cell, std::span<const Int3> vertices, std::span<const BorderVertex> at_border);

/// The centre of a fan: a cell vertex, or one of the loop's own face vertices in the chunk's face. The strip kinds have
/// no centre: creases pass through the loop without meeting (stripTriangles).
struct FanCentre {
  enum class Kind : uint8_t { cell_vertex, face_vertex, strip, strip_from_second };

  Int3 at;  ///< position in 1/256 of a cell from the chunk's origin; for a strip, any point within the cell
  Kind kind = Kind::cell_vertex;
  uint32_t face_vertex = SharpSide::kNone;  ///< index of the face vertex (faceVertexOf), for the kind face_vertex

  bool isStrip() const { return kind == Kind::strip || kind == Kind::strip_from_second; }
  friend bool operator==(const FanCentre&, const FanCentre&) = default;
};

/// A loop with sharp sides, or with a crease through its vertices.
struct SharpLoop {
  enum class Shape : uint8_t {
    plain,    ///< its own triangles, or a fan that keeps the face vertices at the chunk's border
    fan,      ///< around its centre, with all of its face vertices
    rounded,  ///< triangles as plain, although the centre of a fan lies on the surface: no fan would be valid
  };

  uint32_t loop = 0;  ///< index of the loop in the body
  /// index of the side after each vertex of the loop; kNone if that side is not sharp
  std::array<uint32_t, kLongestBodyLoop> sides{};
  Shape shape = Shape::plain;
  FanCentre centre;         ///< the centre, if the shape is fan
  bool by_patches = false;  ///< true if a fan may have diagonals that do not end at its centre
  uint8_t tried = 0;        ///< number of centres tried so far

  bool isFan() const { return shape == Shape::fan; }
};

/// All sharp loops of a body, in the order of the body's loops, and their sorted sides.
struct SharpLoops {
  static constexpr uint32_t kNone = SharpSide::kNone;

  const BodyLoops& body;
  std::pmr::vector<SharpSide> sides;
  std::pmr::vector<SharpLoop> loops;

  SharpLoops(const BodyLoops& of_body, std::pmr::memory_resource* memory)
      : body(of_body), sides(memory), loops(memory) {}

  const SurfaceLoop& of(const SharpLoop& loop) const { return body.all()[loop.loop]; }
  /// Converts between a side with the number of its face vertex (`which`, 0 or 1) and the index of that face vertex.
  static uint32_t faceVertexOf(uint32_t side, size_t which) {
    return side * static_cast<uint32_t>(FacePlaces::kMost) + static_cast<uint32_t>(which);
  }
  static uint32_t sideOf(uint32_t face_vertex) { return face_vertex / static_cast<uint32_t>(FacePlaces::kMost); }
  /// True if the loops of the side, in their current shapes, use its face vertices.
  bool hasFaceVertices(const SharpSide& side) const;
  Int3 fromChunk(const SharpSide& side, const Int3& place) const { return sgm::fromChunk(body.grid(), side, place); }
  /// Returns the centre of a loop if its current shape is a fan; nullopt if it has its own triangles.
  std::optional<FanCentre> centreOf(const SharpLoop& loop) const;
  /// Returns the triangles of a loop in its current shape.
  LoopTriangles trianglesOf(const SharpLoop& loop) const;
  /// Returns the triangles that a loop would have as a fan with all face vertices that its sides can have.
  LoopTriangles fullFan(const SharpLoop& loop, const FanCentre& centre, bool by_patches) const;
};

}  // namespace sgm
