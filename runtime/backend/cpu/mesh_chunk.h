#pragma once
// Meshes one chunk in cache, from its field programs to packed meshes: bound, sample, polygonize, attribute, hash.

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

/// Of the widest set that this processor supports.
inline ChunkKernels bestChunkKernels() { return {bestKernels(), bestMeshKernels()}; }

/// Working memory of one thread; grows once, then is reused from chunk to chunk.
struct ChunkScratch {
  explicit ChunkScratch(std::pmr::memory_resource* memory)
      : samples(memory), evaluation(memory), pruning(memory), whole(memory), octant(memory), mesh(memory) {
    for (int i = 0; i < kBrickCount; ++i) bricks.emplace_back(memory);
  }

  ChunkSamples samples;
  EvalScratch evaluation;
  PruneScratch pruning;
  PrunedProgram whole, octant;
  std::vector<PrunedProgram> bricks;  ///< x fastest; programs for the bricks' samples and vertices
  MeshScratch mesh;
};

/// Pure except for scratch. Throws only std::bad_alloc.
void meshChunk(const ChunkKernels& kernels, const ChunkJob& job, ChunkScratch& scratch, ChunkMesh& mesh);

/// Computes only the samples of a chunk. Returns false if the chunk is proven uniform (then only the signs are filled).
/// If `faces`, bit (1 << Face), is not 0, only the samples in these faces are guaranteed.
bool sampleChunk(const ChunkKernels& kernels, const ProgramView& field, const ChunkGrid& grid, ChunkScratch& scratch,
                 uint8_t faces = 0);

}  // namespace sgm
