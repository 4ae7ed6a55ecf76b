#pragma once
// What one submission meshes, as the words that its shaders read, and where they leave what.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/vulkan/batch_layout.h"
#include "backend/vulkan/tape.h"
#include "field/prune.h"

namespace sgm {

/// How much of its result a batch has room for, by chunk.
struct BatchRoom {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint32_t cells = 6144;
};

/// Reused from batch to batch: grows, and then takes no more memory.
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
    uint32_t body = batch::kNoRoom;  ///< number of its part; kNoRoom: none is asked for
    std::array<uint32_t, 6> seams{};
    uint32_t signs = 0;  ///< where in scratch
    uint32_t item = 0;   ///< where in scratch its first brick's item lies
  };

  std::pmr::vector<uint32_t> words;    ///< binding 0
  std::pmr::vector<uint32_t> parts;    ///< what binding 2 begins as
  std::pmr::vector<Chunk> chunks;      ///< those that the device meshes
  std::pmr::vector<uint32_t> uniform;  ///< numbers of jobs whose programs have no group: nothing is to be done
  std::pmr::vector<uint32_t> refused;  ///< numbers of jobs that it cannot take
  batch::Sizes sizes{};
  uint32_t seam_count = 0;
  uint32_t plane_jobs = 0;     ///< of pruning, behind one for each chunk's bricks,
  uint32_t plane_jobs_at = 0;  ///< from here on in words
  uint32_t scratch_words = 0;
  uint64_t kinds = 0;                 ///< of all tapes, as Tape::kinds
  bool meshes = false, sums = false;  ///< whether a job wants its mesh; whether one wants sums alone
  TapeScratch tape_scratch;
  PruneScratch prune_scratch;
  PrunedProgram pruned;
};

/// Plans jobs for one submission; how many of them were taken up, from the first on: at most 64, and fewer where their
/// scratch would be more than most_scratch words. At least one is. Throws std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const BatchRoom& room, uint32_t most_scratch, BatchPlan& plan);

}  // namespace sgm
