#pragma once
// One chunk, from its field programs to packed meshes, in cache: bound, sample, polygonize, attribute, hash.

#include <array>

#include "backend/backend.h"
#include "backend/cpu/extract/mesh_kernels.h"
#include "backend/cpu/instruction_sets.h"
#include "field/evaluate.h"
#include "field/prune.h"

namespace sgm {

/// What a chunk is made with: both of one instruction set, or not, since all give the same bits.
struct ChunkKernels {
  const FieldKernels& field;
  const MeshKernels& mesh;
};

/// Of the widest set that runs here.
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
  std::vector<PrunedProgram> bricks;  ///< x fastest; what their samples and vertices are evaluated with
  MeshScratch mesh;
};

/// Pure but for scratch. Throws std::bad_alloc only.
void meshChunk(const ChunkKernels& kernels, const ChunkJob& job, ChunkScratch& scratch, ChunkMesh& mesh);

/// The samples of a chunk alone; false where the chunk is proven uniform (only the signs are filled). Where `faces`
/// names some, bit (1 << Face), only the samples in those faces are sure to be there.
bool sampleChunk(const ChunkKernels& kernels, const ProgramView& field, const ChunkGrid& grid, ChunkScratch& scratch,
                 uint8_t faces = 0);

}  // namespace sgm
