#pragma once
// Meshes one chunk from its field programs: bounds the field, samples it, polygonizes, evaluates attributes and
// computes hashes. The data of one chunk are small enough to stay in the cache.

#include <array>

#include "backend/backend.h"
#include "backend/cpu/extract/mesh_kernels.h"
#include "backend/cpu/instruction_sets.h"
#include "field/evaluate.h"
#include "field/prune.h"

namespace sgm {

/// The kernels for a chunk. Their instruction sets may differ, since all give the same bits.
struct ChunkKernels {
  const FieldKernels& field;
  const MeshKernels& mesh;
};

/// Returns the kernels of the widest instruction set that this processor supports.
inline ChunkKernels bestChunkKernels() { return {bestKernels(), bestMeshKernels()}; }

/// Working memory of one thread; allocated once, then reused for further chunks.
struct ChunkScratch {
  explicit ChunkScratch(std::pmr::memory_resource* memory)
      : samples(memory), evaluation(memory), pruning(memory), whole(memory), octant(memory), mesh(memory) {
    for (int i = 0; i < kBrickCount; ++i) bricks.emplace_back(memory);
  }

  ChunkSamples samples;
  EvalScratch evaluation;
  PruneScratch pruning;
  PrunedProgram whole, octant;
  std::vector<PrunedProgram> bricks;  ///< pruned programs for the samples and vertices of each brick; x fastest
  MeshScratch mesh;
};

/// Meshes one chunk. Pure except for scratch. Throws only std::bad_alloc.
void meshChunk(const ChunkKernels& kernels, const ChunkJob& job, ChunkScratch& scratch, ChunkMesh& mesh);

/// Computes only the samples of a chunk. Returns false if the chunk is proven uniform; then only the signs are filled.
/// faces: if not 0, only the samples in these faces, bit (1 << Face), are guaranteed to be computed.
bool sampleChunk(const ChunkKernels& kernels, const ProgramView& field, const ChunkGrid& grid, ChunkScratch& scratch,
                 uint8_t faces = 0);

}  // namespace sgm
