#pragma once
// Loops of marching cubes with sharp features (after Kobbelt et al. 2001, "Feature Sensitive Surface Extraction from
// Volume Data").
//
// A SIDE of a loop joins two consecutive vertices of the loop, which lie on edges of one face of its cell. If the
// normals at its ends differ, the two tangent planes meet in a crease, and the side is SHARP: it may have a FACE VERTEX
// on the crease. A loop with sharp sides becomes a fan around a CELL VERTEX, the point nearest to the tangent planes of
// the loop's vertices. The creases from the cell vertex to the face vertices divide the fan into PATCHES, each
// approximately planar. A patch that is not entirely visible from the cell vertex gets other diagonals
// (mesh/fan_triangles.h). If two creases pass through a cell and do not meet, the loop has no cell vertex: it is a
// STRIP. If a crease passes through a loop's vertices, its sides are not sharp, but it becomes a fan, too.
//
// Validity takes precedence over sharpness. A loop whose fan intersects another triangle (mesh/triangle_faults.h) is
// ROUNDED: it keeps its marching-cubes triangles, and its sides lose their face vertices.
//
// The sides in a face of the CHUNK are an exception: rounding does not remove their face vertices. These face vertices
// (two if a third plane cuts off the crease of the ends' planes) lie in the chunk's face, and depend only on the field
// near it (mesh/border_vertices.h). So chunks that are meshed separately agree without communication. A rounded loop
// with such face vertices is a fan around a point strictly within its own cell (roundedCentre). All other features of a
// chunk lie strictly inside the chunk. So the bodies on both sides of a face, and the seam that lies in the face
// between two levels, meet only where they should, whichever of their loops are rounded.
//
// Rounded loops never intersect each other, so that rounding terminates. The fan of a rounded loop is a cone over a
// simple polygon on the boundary of its cell. The cell is convex, so the cone stays in the cell, and has no other point
// in common with the boundary. If the cell has another loop, the cone is tested against it (mesh/rounded_cells.h).
//
// If a face vertex lies outside the side's square, a part of the cone lies beyond the cell. The centre is then 1/256 of
// a cell away from the chunk's face, and that part is no farther away. If no contour crosses the square of the face
// beneath that part, triangles there whose corners are not in the face are at least 1/256 away; otherwise the cone is
// tested against the loops there. If several sides have a face vertex in one such square, each vertex stays in its
// side's part of the square, or the cones are tested against each other (mesh/surroundings.h).

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

/// The positions of the face vertices that lie on one side of a surface loop, relative to SharpSide::corner, in 1/256
/// of a cell. They are ordered from the vertex SharpSide::from to the vertex SharpSide::to. There is one, or there are
/// two if a third plane cuts off the crease in which the tangent planes of the side's two ends meet.
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

/// A side of a loop whose two ends have different normals.
struct SharpSide {
  static constexpr uint32_t kNone = UINT32_MAX;

  uint32_t from = 0, to = 0;  ///< the vertices at the side's ends; `from` has the lower key, so the order is the same
                              ///< in both cells that share the side
  Int3 corner;                ///< lowest corner of the grid square (face of a cell) in which the side lies, in units
  int axis = 0;               ///< normal axis of the face in which the side lies
  bool at_border = false;     ///< true if the side lies in a face of the chunk
  /// index of the sharp loop that contains this side, in the cell on the low side of the face, and in the cell on its
  /// high side; kNone if there is no such loop
  std::array<uint32_t, 2> loops{kNone, kNone};
  std::optional<Tangent> third;  ///< third plane: the tangent plane at the point where the tangent planes of the side's
                                 ///< ends meet, if that point is off the surface
  FacePlaces places;             ///< empty if no face vertex is possible; two only in faces of the chunk

  friend bool operator<(const SharpSide& a, const SharpSide& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  }
};

/// Returns the loop side between two vertices, given by indices into keys. Fills from, to, corner and axis; the other
/// members keep their defaults.
SharpSide sideBetween(uint32_t a, uint32_t b, const RawVector<VertexKey>& keys);

/// True if a loop side lies in a face of the chunk.
bool isAtBorder(const ChunkGrid& grid, const SharpSide& side);

/// Converts a position relative to a loop side's corner to one relative to the chunk's origin; both in 1/256 of a cell.
Int3 fromChunk(const ChunkGrid& grid, const SharpSide& side, const Int3& place);

/// Returns the key of a loop side's face vertex. from: the key of the vertex side.from. which: 0, or 1 for the second
/// face vertex of the side.
VertexKey faceVertexKey(const SharpSide& side, const VertexKey& from, size_t which);

/// A face vertex (a vertex that sharpening adds in a cell's face) that lies in a face of the chunk.
struct BorderVertex {
  Int3 at;
  int axis = 0;  ///< the normal axis of that face
};

/// Returns the centre of the fan for a rounded loop whose sides have face vertices in a face of the chunk. The centre
/// lies strictly within the loop's cell. Usually, it is the mean of the loop's vertices and these face vertices. If a
/// face vertex lies beyond the cell, the centre is only 1/256 of a cell away from the chunk's face, so that no other
/// triangle fits between the fan and the face. All positions are in 1/256 of a cell from one origin.
Int3 roundedCentre(const Int3& cell, std::span<const Int3> vertices, std::span<const BorderVertex> at_border);

/// The centre of a fan: a cell vertex, or one of the loop's own face vertices that lies in the chunk's face. The two
/// kinds for strips stand for no centre: in a strip, creases pass through the loop without meeting (stripTriangles).
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
    plain,    ///< marching-cubes triangles; with face vertices in chunk faces, a fan around roundedCentre()
    fan,      ///< a fan around `centre`, or a strip, with the face vertices of its sharp sides
    rounded,  ///< the triangles are those of `plain`, because all fans and strips are faulty or swallow another part
  };

  uint32_t loop = 0;  ///< index of this sharp loop among all loops of the mesh body
  /// for each vertex of the loop: index in SharpLoops::sides of the side that begins at this vertex; kNone if that side
  /// is not sharp
  std::array<uint32_t, kLongestBodyLoop> sides{};
  Shape shape = Shape::plain;
  FanCentre centre;  ///< centre of the fan, if the shape is `fan`
  /// true: a patch of the fan that is not entirely visible from its centre may have diagonals between other vertices
  bool by_patches = false;
  uint8_t tried = 0;  ///< number of centres tried so far

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
  /// Returns the index of a face vertex. which: its number (0 or 1) among the face vertices of its side. sideOf() is
  /// the inverse function: it returns the side of a face vertex.
  static uint32_t faceVertexOf(uint32_t side, size_t which) {
    return side * static_cast<uint32_t>(FacePlaces::kMost) + static_cast<uint32_t>(which);
  }
  static uint32_t sideOf(uint32_t face_vertex) { return face_vertex / static_cast<uint32_t>(FacePlaces::kMost); }
  /// True if the loops that share the side contain its face vertices, in the shapes chosen for these loops so far.
  bool hasFaceVertices(const SharpSide& side) const;
  Int3 fromChunk(const SharpSide& side, const Int3& place) const { return sgm::fromChunk(body.grid(), side, place); }
  /// Returns the centre of a loop if its current triangles are a fan or strip; nullopt if they are those of marching
  /// cubes.
  std::optional<FanCentre> centreOf(const SharpLoop& loop) const;
  /// Returns the triangles of a loop in its current shape.
  LoopTriangles trianglesOf(const SharpLoop& loop) const;
  /// Returns the triangles of a loop as a fan around `centre` that contains all face vertices that the loop's sides can
  /// have.
  LoopTriangles fullFan(const SharpLoop& loop, const FanCentre& centre, bool by_patches) const;
};

}  // namespace sgm
