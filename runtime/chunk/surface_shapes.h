#pragma once
// Finds the shapes that make a world's surface, which define the texture coordinates there.

#include <map>
#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/packed_mesh.h"
#include "texture/unwrap.h"
#include "world/world_field.h"

namespace sgm {

/// The default and the largest edge of a texture's tile, in units. Texture coordinates increase by 1 per tile.
inline constexpr int32_t kTile = kUnitsPerMetre, kLargestTile = 1 << 20;

/// Finds shapes at points of the surface, and numbers them in the order of discovery. Borrows the field and the edits.
/// Not thread-safe.
class SurfaceShapes {
 public:
  /// base: the point with texture coordinates 0 along the world's axes, in units. tile: edge of a tile, in units.
  SurfaceShapes(const WorldField& field, const EditSnapshot* edits, Int3 base, int32_t tile);

  /// Sets the label of each point to the number of the shape that makes the level's surface there. Use separate calls
  /// for distant points, because the field is compiled for all space between the points of a call. Errors: those of
  /// WorldField::compileShapes.
  Result<void> label(int level, std::span<const Int3> points, std::span<uint32_t> labels);
  /// Returns the texture space of a label from label(); label 0 is the world's own space, for points where no shape
  /// decides.
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

/// Computes a mesh with texture coordinates and blended materials, a pure function of the field, the edits and the
/// mesh: the same bytes on every machine. Chunks of a level agree on their common border: on coordinates up to whole
/// tiles, on blends bit by bit. A seam's vertices on edges of the coarser level use that level's shapes, as its chunks
/// do; where the two levels have other shapes or charts, they differ. tile: 1 to kLargestTile. Errors: those of
/// WorldField::compileShapes and compile. Throws std::bad_alloc.
Result<Unwrapped> unwrapChunk(const WorldField& field, const PackedMesh& mesh, const ChunkGrid& grid,
                              const EditSnapshot* edits, int32_t tile, std::pmr::memory_resource* memory);

}  // namespace sgm
