#pragma once
// Tests whether rounded loops with a face vertex in a face of the chunk keep clear of other loops: of their own cell,
// and of adjacent cells if the face vertex lies there.

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

/// Tests sides at the border against the cells beside them, one claim per side and cell. Loops there that have other
/// sharp sides in faces of the chunk may keep or lose their face vertices: a side must keep clear of them in both
/// cases.
class RoundedCells {
 public:
  /// Gives sides at the border, between vertices with these creases, the places that they have if no rounded loop
  /// interferes.
  using PlaceAlone = std::function<void(const Creases& creases, std::span<SharpSide>)>;

  /// Borrows all arguments.
  RoundedCells(const ChunkGrid& grid, const FieldSampler& field, const PlaceAlone& place_alone,
               std::pmr::memory_resource* memory);

  /// Claims that the rounded loop of a side keeps clear in the cell above or below the side's face. Borrows the side.
  /// from, to: the keys of its ends. q: the field at the cell's corners.
  void add(SharpSide& side, const VertexKey& from, const VertexKey& to, bool above, const std::array<int32_t, 8>& q);
  /// Adds an adjacent cell to the last claim, at an offset of `steps` cells.
  void addBeside(const Int3& steps, const std::array<int32_t, 8>& q);

  /// Removes the places of the sides whose claims fail. Call once.
  void judge();

 private:
  struct Claim {
    SharpSide* side;
    VertexKey from, to;
    Int3 cell;
    size_t first, end, end_beside;  ///< the loops of the cell, followed by those of adjacent cells
    size_t first_other = 0, end_other = 0;
  };
  /// A sharp side in a face of the chunk: after a vertex of a claim's loop, or the claim's own.
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
  std::pmr::vector<Border> others_;  ///< of all claims, in their order
  Creases creases_;
  std::pmr::memory_resource* memory_;
};

}  // namespace sgm
