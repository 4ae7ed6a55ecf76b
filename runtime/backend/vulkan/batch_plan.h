#pragma once
// The plan of one submission: the words that its shaders read, and the places where the shaders write their results.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/vulkan/batch_layout.h"
#include "backend/vulkan/tape.h"
#include "field/prune.h"

namespace sgm {

/// Numbers of vertices, indices and active cells per chunk. A batch of n chunks has room for max(n, 8) times these
/// numbers, which its chunks share.
struct BatchRoom {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint32_t cells = 6144;
};

/// The plan of a batch. The object is reused for further batches; once its arrays are large enough, it allocates no
/// more memory.
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
    uint32_t body = batch::kNoRoom;  ///< index of the body's part; kNoRoom: no body is requested
    std::array<uint32_t, 6> seams{};
    uint32_t signs = 0;  ///< offset in scratch of the chunk's signs
    uint32_t item = 0;   ///< offset in scratch of the item (record) of the chunk's first brick
  };

  std::pmr::vector<uint32_t> words;    ///< content of descriptor binding 0
  std::pmr::vector<uint32_t> parts;    ///< initial content of descriptor binding 2
  std::pmr::vector<Chunk> chunks;      ///< the chunks that the device meshes
  std::pmr::vector<uint32_t> uniform;  ///< indices of jobs with constant fields, which need no device
  std::pmr::vector<uint32_t> refused;  ///< indices of jobs that the device cannot mesh
  batch::Sizes sizes{};
  uint32_t seam_count = 0;
  /// number of pruning jobs for planes; in the list of jobs they follow the jobs for bricks (one for each chunk)
  uint32_t plane_jobs = 0;
  uint32_t plane_jobs_at = 0;  ///< offset, in `words`, of the pruning jobs for the planes of seams
  uint32_t scratch_words = 0;
  uint64_t kinds = 0;                 ///< kinds of instructions in all tapes, one bit each (see Tape::kinds)
  bool meshes = false, sums = false;  ///< meshes: some job requests its mesh; sums: some job requests only sums
  TapeScratch tape_scratch;
  PruneScratch prune_scratch;
  PrunedProgram pruned;
};

/// Plans jobs for one submission, starting with the first job. Returns the number of planned jobs: at most 64; fewer if
/// the jobs need more than max_scratch words, but at least one. Throws std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const BatchRoom& room, uint32_t max_scratch, BatchPlan& plan);

}  // namespace sgm
