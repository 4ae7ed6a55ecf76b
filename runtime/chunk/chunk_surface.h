#pragma once
// A finished chunk: its meshes, and the other content that an engine requests. Immutable, shared between the world, its
// frames and the engine.

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

/// A run of anchors with the same kind and name: an engine draws them as instances of one object.
struct InstanceBatch {
  uint16_t kind = 0, name = 0;
  uint32_t first = 0, count = 0;
  friend bool operator==(const InstanceBatch&, const InstanceBatch&) = default;
};

/// Row-major, 3 rows of 4: from an anchor's own axes to the chunk's, in metres from the chunk's origin.
using InstanceTransform = std::array<float, 12>;

struct ChunkSurface {
  ChunkKey key;
  ChunkGrid grid;
  PackedMesh mesh;
  uint8_t seams = 0;                          ///< made seams, with or without triangles, bit (1 << Face)
  IntBox bounds{{0, 0, 0}, {0, 0, 0}};        ///< of all vertices, units; all 0 if there are none
  std::pmr::vector<uint16_t> tags;            ///< the tags of vertices, ascending, without 0
  std::vector<Anchor> anchors;                ///< if requested; by kind, name and key
  std::vector<InstanceTransform> transforms;  ///< of the anchors
  std::vector<InstanceBatch> batches;         ///< of the anchors
  std::pmr::vector<MorphOffset> morphs;       ///< one for each vertex, if requested; else empty
  Unwrapped texture;                          ///< of the whole mesh, if requested; else empty
  DeviceParts on_device;                      ///< if requested: non-empty parts that are also on the device
  ContentHash hash;                           ///< of body and seams, and their placement
  /// Of body and seams, if requested.
  std::optional<measure::ChunkMeasures> measures;

  explicit ChunkSurface(std::pmr::memory_resource* memory)
      : mesh(memory), tags(memory), morphs(memory), texture(memory) {}

  /// Whether there is nothing to draw and nothing to place.
  bool empty() const { return mesh.indices.empty() && anchors.empty(); }
  size_t bytes() const {
    return sizeof *this + mesh.bytes() + tags.capacity() * sizeof(uint16_t) + anchors.capacity() * sizeof(Anchor) +
           transforms.capacity() * sizeof(InstanceTransform) + batches.capacity() * sizeof(InstanceBatch) +
           morphs.capacity() * sizeof(MorphOffset) + texture.bytes();
  }
};

/// Whether both have the same meshes, anchors, offsets and texture. `seams` may differ: a made seam can be empty.
inline bool sameContent(const ChunkSurface& a, const ChunkSurface& b) {
  return a.hash == b.hash && a.anchors == b.anchors && a.morphs == b.morphs && a.texture == b.texture;
}

/// The body and the existing seams.
MeshParts partsOf(const ChunkMesh& mesh);

/// The surface for a request. Parts that were not requested are taken from `before`, an earlier surface of the same
/// chunk (or null). Throws std::bad_alloc.
ChunkSurface surfaceOf(const ChunkRequest& request, PlacedChunk&& chunk, const ChunkSurface* before,
                       std::pmr::memory_resource* memory);

}  // namespace sgm
