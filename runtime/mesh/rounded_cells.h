#pragma once
// Tests whether rounded loops (mesh/sharp_loops.h) with a face vertex in a face of the chunk intersect other loops:
// those of their own cell, and those of adjacent cells if the face vertex lies there.

#include <array>
#include <functional>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "mesh/body_loops.h"
#include "mesh/creases.h"
#include "mesh/loop_triangles.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Tests sharp loop sides in faces of the chunk. A CLAIM says that the rounded loop of a side, in one of the two cells
/// beside the side, intersects no other loop. Sides of the other loops, if they lie in faces of the chunk and are
/// sharp, may end up with or without their face vertices, so a claim is tested in all of these cases.
class RoundedCells {
 public:
  /// Computes the positions of the face vertices of the given loop sides, which lie in faces of the chunk. Does not
  /// test claims. creases: the tangent planes of the vertices at the ends of these sides.
  using PlaceAlone = std::function<void(const Creases& creases, std::span<SharpSide>)>;

  /// Borrows all arguments.
  RoundedCells(const ChunkGrid& grid, const FieldSampler& field, const PlaceAlone& place_alone,
               std::pmr::memory_resource* memory);

  /// Adds a claim for a side's loop in one cell: the cell above or below the face in which `side` lies. Keeps a
  /// reference to `side`. from, to: the keys of the vertices at the ends of `side`. q: the field at the corners of that
  /// cell.
  void add(SharpSide& side, const VertexKey& from, const VertexKey& to, bool above, const std::array<int32_t, 8>& q);
  /// Adds an adjacent cell to the last claim, `steps` cells away from the claim's cell. q: the field at the corners of
  /// that cell.
  void addBeside(const Int3& steps, const std::array<int32_t, 8>& q);

  /// Removes the positions (SharpSide::places) of the loop sides whose claims fail. Call once.
  void judge();

 private:
  struct Claim {
    SharpSide* side;
    VertexKey from, to;
    Int3 cell;
    /// ranges in loops_: the loops first..end - 1 are in the claim's cell, the loops end..end_beside - 1 in adjacent
    /// cells
    size_t first, end, end_beside;
    size_t first_other = 0, end_other = 0;
  };
  /// A sharp loop side in a face of the chunk: the side of a claim, or another side near the claim. loop: index in
  /// loops_ of the loop that contains the side. behind: index, among the loop's vertices, of the vertex at which the
  /// side begins.
  struct Border {
    size_t loop = 0;
    uint32_t behind = 0;
    SharpSide side;
  };

  void findOthers();
  bool keepsClear(const Claim& claim) const;
  bool isOwn(const Claim& claim, uint32_t a, uint32_t b) const;
  std::optional<Border> ownOf(const Claim& claim) const;
  LoopTriangles trianglesOf(size_t loop, const Border& own, std::span<const Border> others, uint32_t present) const;

  const ChunkGrid grid_;
  const PlaceAlone& place_alone_;
  MeshPart part_;
  std::pmr::vector<SurfaceLoop> loops_;
  std::pmr::vector<Claim> claims_;
  std::pmr::vector<Border> others_;  ///< sharp loop sides near the claims (without the sides of the claims themselves),
                                     ///< grouped by claim
  Creases creases_;
  std::pmr::memory_resource* memory_;
};

}  // namespace sgm
