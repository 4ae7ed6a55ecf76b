#pragma once
// A finished chunk: what is drawn of it, and what an engine asks of it. Immutable, shared between the world, its frames
// and the engine.

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

/// Anchors of one kind and name, behind each other: what an engine draws as copies of one thing.
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
  uint8_t seams = 0;                          ///< those that were made, with or without triangles, bit (1 << Face)
  IntBox bounds{{0, 0, 0}, {0, 0, 0}};        ///< of every vertex, units; all 0 where there is none
  std::pmr::vector<uint16_t> tags;            ///< that vertices carry, rising, 0 left out
  std::vector<Anchor> anchors;                ///< where asked for; by kind, name and key
  std::vector<InstanceTransform> transforms;  ///< of the anchors
  std::vector<InstanceBatch> batches;         ///< likewise
  std::pmr::vector<MorphOffset> morphs;       ///< one a vertex, where asked for; else none
  Unwrapped texture;                          ///< of the whole mesh, where asked for; else empty
  DeviceParts on_device;                      ///< where asked for: parts with triangles that the device has, too
  ContentHash hash;                           ///< of body and seams, and where they lie
  /// Of body and seams, where asked for.
  std::optional<measure::ChunkMeasures> measures;

  explicit ChunkSurface(std::pmr::memory_resource* memory)
      : mesh(memory), tags(memory), morphs(memory), texture(memory) {}

  /// Nothing to draw, and nothing to place.
  bool empty() const { return mesh.indices.empty() && anchors.empty(); }
  size_t bytes() const {
    return sizeof *this + mesh.bytes() + tags.capacity() * sizeof(uint16_t) + anchors.capacity() * sizeof(Anchor) +
           transforms.capacity() * sizeof(InstanceTransform) + batches.capacity() * sizeof(InstanceBatch) +
           morphs.capacity() * sizeof(MorphOffset) + texture.bytes();
  }
};

/// Whether an engine that has one of them has all of the other: seams aside, which come on top.
inline bool sameContent(const ChunkSurface& a, const ChunkSurface& b) {
  return a.hash == b.hash && a.anchors == b.anchors && a.morphs == b.morphs && a.texture == b.texture;
}

/// The body, and the seams that there are.
MeshParts partsOf(const ChunkMesh& mesh);

/// What came of a request. Parts that it did not ask for are those of `before`, an earlier surface of the same chunk
/// (or null). Throws std::bad_alloc.
ChunkSurface surfaceOf(const ChunkRequest& request, PlacedChunk&& chunk, const ChunkSurface* before,
                       std::pmr::memory_resource* memory);

}  // namespace sgm
