#pragma once
// The plan of one submission: the words that its shaders read, and the places of their results.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/vulkan/batch_layout.h"
#include "backend/vulkan/tape.h"
#include "field/prune.h"

namespace sgm {

/// The space for a batch's results, per chunk.
struct BatchRoom {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint32_t cells = 6144;
};

/// Reused from batch to batch: grows, then allocates no more memory.
struct BatchPlan {
  explicit BatchPlan(std::pmr::memory_resource* memory)
      : words(memory),
        parts(memory),
        chunks(memory),
        uniform(memory),
        refused(memory),
        tape_scratch(memory),
        prune_scratch(memory),
        pruned(memory) {}

  struct Chunk {
    uint32_t job = 0;
    uint32_t body = batch::kNoRoom;  ///< index of its part; kNoRoom: not requested
    std::array<uint32_t, 6> seams{};
    uint32_t signs = 0;  ///< offset in scratch
    uint32_t item = 0;   ///< offset in scratch of its first brick's item
  };

  std::pmr::vector<uint32_t> words;    ///< binding 0
  std::pmr::vector<uint32_t> parts;    ///< the initial content of binding 2
  std::pmr::vector<Chunk> chunks;      ///< the chunks that the device meshes
  std::pmr::vector<uint32_t> uniform;  ///< indices of jobs whose programs have no group: nothing to do
  std::pmr::vector<uint32_t> refused;  ///< indices of jobs that the device cannot take
  batch::Sizes sizes{};
  uint32_t seam_count = 0;
  uint32_t plane_jobs = 0;     ///< pruning jobs for planes; they follow one for each chunk's bricks
  uint32_t plane_jobs_at = 0;  ///< offset of these in words
  uint32_t scratch_words = 0;
  uint64_t kinds = 0;                 ///< of all tapes, as Tape::kinds
  bool meshes = false, sums = false;  ///< whether a job wants its mesh; whether a job wants only sums
  TapeScratch tape_scratch;
  PruneScratch prune_scratch;
  PrunedProgram pruned;
};

/// Plans jobs for one submission. Returns the number of planned jobs, counted from the first: at most 64, fewer if
/// their scratch exceeds most_scratch words, but at least one. Throws std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const BatchRoom& room, uint32_t most_scratch, BatchPlan& plan);

}  // namespace sgm
