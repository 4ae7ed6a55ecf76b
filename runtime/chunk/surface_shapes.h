#pragma once
// Which shapes of a world make its surface, and their texture coordinates.

#include <map>
#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/packed_mesh.h"
#include "texture/unwrap.h"
#include "world/world_field.h"

namespace sgm {

/// Edges of tiles that texture coordinates count, units.
inline constexpr int32_t kTile = kUnitsPerMetre, kLargestTile = 1 << 20;

/// Shapes, numbered as they are met. Borrows the field and the edits. Not thread-safe.
class SurfaceShapes {
 public:
  /// base: where the world's own axes count from, units.
  SurfaceShapes(const WorldField& field, const EditSnapshot* edits, Int3 base, int32_t tile);

  /// A label for each point: of the shape that makes the surface of the level there. Points far from each other are
  /// better asked about apart: all that lies between is compiled. Errors: those of WorldField::compileShapes.
  Result<void> label(int level, std::span<const Int3> points, std::span<uint32_t> labels);
  /// Of a label that label() gave; 0 stands for what is of no shape.
  const TextureSpace& space(uint32_t label) const { return spaces_[label]; }

 private:
  struct ShapeKey {
    int level = 0;
    uint32_t layer = 0;
    Int3 cell;
    uint32_t shape = 0;
    friend auto operator<=>(const ShapeKey&, const ShapeKey&) = default;
  };

  const WorldField& field_;
  const EditSnapshot* edits_;
  int32_t tile_;
  std::pmr::vector<TextureSpace> spaces_;
  std::pmr::map<ShapeKey, uint32_t> known_;
};

/// A chunk's mesh with texture coordinates and blends of materials, a pure function of the field, the edits and the
/// mesh: the same bytes on every machine. Chunks of a level that meet agree on their border: on coordinates up to whole
/// tiles, on what two materials share to the bit. A seam's vertices on edges of the coarser level are asked about at
/// that level, as its chunks do; where the two levels have other shapes, or other charts, they differ. tile: 1 to
/// kLargestTile. Errors: those of WorldField::compileShapes and compile. Throws std::bad_alloc.
Result<Unwrapped> unwrapChunk(const WorldField& field, const PackedMesh& mesh, const ChunkGrid& grid,
                              const EditSnapshot* edits, int32_t tile, std::pmr::memory_resource* memory);

}  // namespace sgm
