#pragma once
// A finished chunk: its meshes, and the other content that the engine requested. Immutable; the world, its frames and
// the engine share it.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "chunk/geomorph.h"
#include "chunk/mesh_chunks.h"
#include "measure/chunk_measures.h"
#include "mesh/packed_mesh.h"
#include "texture/unwrapped.h"

namespace sgm {

/// A range of anchors with the same kind and name. An engine draws them as instances of one object.
struct InstanceBatch {
  uint16_t kind = 0, name = 0;
  uint32_t first = 0, count = 0;
  friend bool operator==(const InstanceBatch&, const InstanceBatch&) = default;
};

/// An affine transform from an anchor's own axes to the chunk's, in metres from the chunk's origin: 3 rows of 4
/// numbers, row by row.
using InstanceTransform = std::array<float, 12>;

struct ChunkSurface {
  ChunkKey key;
  ChunkGrid grid;
  PackedMesh mesh;
  uint8_t seams = 0;                    ///< seams that were made, including seams without triangles: bit (1 << Face)
  IntBox bounds{{0, 0, 0}, {0, 0, 0}};  ///< bounding box of all vertices, in units; all 0 if there are none
  std::pmr::vector<uint16_t> tags;      ///< all tags of vertices, ascending, without tag 0
  std::vector<Anchor> anchors;          ///< the chunk's anchors, if requested; sorted by kind, name and key
  std::vector<InstanceTransform> transforms;  ///< transforms of the anchors, in the same order
  std::vector<InstanceBatch> batches;         ///< ranges of anchors with equal kind and name
  std::pmr::vector<MorphOffset> morphs;       ///< morph offsets of the vertices, if requested; otherwise empty
  Unwrapped texture;      ///< texture coordinates and materials of the whole mesh, if requested; otherwise empty
  DeviceParts on_device;  ///< the non-empty parts that are also stored on the device, if requested
  ContentHash hash;       ///< hash of the body and the seams, including their positions
  /// Measures of the body and the seams, if requested.
  std::optional<measure::ChunkMeasures> measures;

  explicit ChunkSurface(std::pmr::memory_resource* memory)
      : mesh(memory), tags(memory), morphs(memory), texture(memory) {}

  /// True if there is nothing to draw and no instance to place.
  bool empty() const { return mesh.indices.empty() && anchors.empty(); }
  size_t bytes() const {
    return sizeof *this + mesh.bytes() + tags.capacity() * sizeof(uint16_t) + anchors.capacity() * sizeof(Anchor) +
           transforms.capacity() * sizeof(InstanceTransform) + batches.capacity() * sizeof(InstanceBatch) +
           morphs.capacity() * sizeof(MorphOffset) + texture.bytes();
  }
};

/// True if both surfaces have the same meshes, anchors, morph offsets and texture. `seams` may differ, since a seam
/// that was made can be empty.
inline bool sameContent(const ChunkSurface& a, const ChunkSurface& b) {
  return a.hash == b.hash && a.anchors == b.anchors && a.morphs == b.morphs && a.texture == b.texture;
}

/// Returns the body and the non-empty seams.
MeshParts partsOf(const ChunkMesh& mesh);

/// Makes the surface for a request. Parts that were not requested are copied from `before`, an earlier surface of the
/// same chunk (or null). Throws std::bad_alloc.
ChunkSurface surfaceOf(const ChunkRequest& request, PlacedChunk&& chunk, const ChunkSurface* before,
                       std::pmr::memory_resource* memory);

}  // namespace sgm
