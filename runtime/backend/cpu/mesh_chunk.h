#pragma once
// One chunk, from its field programs to packed meshes, in cache: bound, sample, polygonize, attribute, hash.

#include <array>

#include "backend/backend.h"
#include "field/evaluate.h"
#include "field/prune.h"

namespace sgm {

inline constexpr int kBrickSamples = 8;                      ///< on each axis; the last brick has one more
inline constexpr int kBricks = kChunkCells / kBrickSamples;  ///< on each axis
inline constexpr int kBrickCount = kBricks * kBricks * kBricks;

/// Working memory of one thread; grows once, then is reused from chunk to chunk.
struct ChunkScratch {
  explicit ChunkScratch(std::pmr::memory_resource* memory)
      : samples(memory),
        evaluation(memory),
        pruning(memory),
        whole(memory),
        octant(memory),
        x(memory),
        y(memory),
        z(memory),
        q(memory),
        normal_x(memory),
        normal_y(memory),
        label(memory),
        order(memory) {
    for (int i = 0; i < kBrickCount; ++i) bricks.emplace_back(memory);
  }

  ChunkSamples samples;
  EvalScratch evaluation;
  PruneScratch pruning;
  PrunedProgram whole, octant;
  std::vector<PrunedProgram> bricks;  ///< x fastest; what their samples and vertices are evaluated with
  std::pmr::vector<int32_t> x, y, z, q;
  std::pmr::vector<int16_t> normal_x, normal_y;
  std::pmr::vector<uint32_t> label, order;
};

/// Pure but for scratch. Throws std::bad_alloc only.
void meshChunk(const FieldKernels& kernels, const ChunkJob& job, ChunkScratch& scratch, ChunkMesh& mesh);

/// The samples of a chunk alone; false where the chunk is proven uniform (only the signs are filled). Where `faces`
/// names some, bit (1 << Face), only the samples in those faces are sure to be there.
bool sampleChunk(const FieldKernels& kernels, const ProgramView& field, const ChunkGrid& grid, ChunkScratch& scratch,
                 uint8_t faces = 0);

}  // namespace sgm
