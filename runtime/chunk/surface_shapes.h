#pragma once
// Finds the shapes that form a world's surface: they define the texture coordinates of the surface.

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

/// Finds the shapes at points of the surface, and numbers them in the order of discovery. The field and the edits must
/// outlive this object. Not thread-safe.
class SurfaceShapes {
 public:
  /// base: the point, in units, where texture coordinates along the world's axes are 0. tile: edge of a tile, in units.
  SurfaceShapes(const WorldField& field, const EditSnapshot* edits, Int3 base, int32_t tile);

  /// Sets the label of each point to the number of the shape that forms the level's surface there. Use separate calls
  /// for distant points, because the field is compiled for the bounding box of a call's points. Errors: those of
  /// WorldField::compileShapes.
  Result<void> label(int level, std::span<const Int3> points, std::span<uint32_t> labels);
  /// Returns the texture space of a label from label(). Label 0 is the world's own space, for points where the surface
  /// belongs to no shape.
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

/// Computes a mesh with texture coordinates and blended materials. The result is a pure function of the field, the
/// edits and the mesh, with the same bytes on every machine. At their common border, chunks of a level have texture
/// coordinates that are equal up to whole tiles, and blends that are bitwise equal. Vertices of a seam on edges of the
/// coarser level use the shapes of that level, as its chunks do; where the two levels have different shapes or charts,
/// their coordinates differ. tile: 1 to kLargestTile. Errors: those of WorldField::compileShapes and compile. Throws
/// std::bad_alloc.
Result<Unwrapped> unwrapChunk(const WorldField& field, const PackedMesh& mesh, const ChunkGrid& grid,
                              const EditSnapshot* edits, int32_t tile, std::pmr::memory_resource* memory);

}  // namespace sgm
