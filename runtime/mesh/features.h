#pragma once
// Where loops of marching cubes have sharp features, and which of these a valid surface can have (after Kobbelt et al.
// 2001, "Feature Sensitive Surface Extraction from Volume Data").
//
// A SIDE of a loop lies in a face of its cell and joins two vertices on edges of that face. If the normals at its ends
// differ, the two tangent planes meet in a crease, and the side has a FACE VERTEX on it. A loop with face vertices
// becomes a fan about a CELL VERTEX, the point nearest to the planes of the loop's own vertices.
//
// The order of face vertices along a crease follows from the places nearest to the sides' middles; but where the crease
// passes near a corner of the grid these may come in another order than the sides, or fall together. Each face vertex
// is therefore placed at the mean of its own such place and those of the next sides of the two loops that it joins:
// three sides on span more than one cell, so that the means come in order.
//
// Validity comes before crispness. A loop whose fan meets another triangle wrongly (mesh/triangle_faults.h) is
// ROUNDED: it keeps its own triangles, as without features, and its sides lose their face vertices. So loops beside it
// change, too, which may have them rounded in turn. Chunks that are meshed apart must agree on what becomes of the
// loops at their border, and so such a loop is rounded if its fan is invalid in any state of the loops around it; that
// follows from the field near it alone. All other loops of a chunk are rounded until the surface is valid.

#include <optional>

#include "mesh/surface_patch.h"

namespace sgm {

/// A side whose ends have different normals.
struct SharpSide {
  uint32_t from, to;  ///< vertices of the patch; the lower key first, so that both cells see the same side
  Int3 corner;        ///< of its face: the lowest, in units
  int axis;           ///< that the face stands on
  std::array<uint32_t, 2>
      loops;  ///< numbers in Features::loops(), the one in the lower cell first; kNone if not in the patch
  std::optional<Int3> place;  ///< of its face vertex, in 1/256 of a cell from `corner`; nullopt if it has none
};

/// A loop with sharp sides.
struct SharpLoop {
  uint32_t loop;                                 ///< of the patch
  std::array<uint32_t, kLongestCubeLoop> sides;  ///< numbers of the sides behind its vertices; kNone if not sharp
  std::optional<Int3> centre;                    ///< of its cell vertex, in 1/256 of a cell from the cell's corner
  std::array<std::optional<Int3>, 2> spares{};   ///< places for it that are not as good, best first
  bool rounded = false;                          ///< it has no fan, which would be invalid
};

/// Throws std::bad_alloc.
class Features {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// Borrows all.
  Features(SurfacePatch& patch, const FieldSampler& field, std::pmr::memory_resource* memory);

  /// Finds the tangents of all vertices that the patch has by now, and slides them (mesh/creases.h).
  void settle();
  /// Whether one of a loop's sides is sharp. Precondition: its vertices are settled.
  bool isSharp(const SurfaceLoop& loop) const;
  /// Finds the features of all loops, and judges those of the lists, which hold numbers of the patch in ascending
  /// order: loops within a chunk, and loops of cells at the border of any. Once. The patch has all cells within kReach
  /// of the listed loops'.
  void find(std::span<const uint32_t> inner, std::span<const uint32_t> border);

  const std::pmr::vector<SharpSide>& sides() const { return sides_; }
  const std::pmr::vector<SharpLoop>& loops() const { return loops_; }
  const Creases& creases() const { return creases_; }
  /// The sharp side between two vertices; nullptr if there is none.
  const SharpSide* sideBetween(uint32_t a, uint32_t b) const;
  /// Whether the side has a face vertex, and its loops are fans.
  bool hasFaceVertex(const SharpSide& side) const;

 private:
  void findSides();
  void placeFaceVertices();
  void placeCellVertices();
  Vector3 meetingPoint(const SharpLoop& loop, const Int3& corner, std::span<const Vector3> ideals) const;
  Vector3 meanOnCrease(const SharpSide& side, std::span<const Vector3> ideals) const;
  bool looksOut(const SharpLoop& loop, const Int3& centre) const;
  const SurfaceLoop& of(const SharpLoop& loop) const { return patch_.loops()[loop.loop]; }

  SurfacePatch& patch_;
  const FieldSampler& field_;
  std::pmr::memory_resource* memory_;
  Creases creases_;
  uint32_t settled_ = 0;  ///< vertices
  std::pmr::vector<SharpSide> sides_;
  std::pmr::vector<SharpLoop> loops_;  ///< in the order of the patch
};

/// The key of a side's face vertex. from: of the vertex side.from.
VertexKey faceVertexKey(const SharpSide& side, const VertexKey& from);

}  // namespace sgm
