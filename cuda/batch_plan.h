#pragma once
// The plan of one submission: the arrays that its kernels read.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cuda/kernels/batch.h"

namespace sgm::cuda {

/// The maximum number of chunks in one submission.
inline constexpr uint32_t kMaxChunks = 256;

/// The maximum size of a batch's results per chunk, and limits for the scratch and the parameters of a batch, which
/// only a batch of one chunk may exceed.
struct Room {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint64_t scratch_bytes = uint64_t{512} << 20;
  uint64_t pool_bytes = uint64_t{128} << 20;  ///< the part of scratch_bytes for pruned programs
};

/// Reused for further batches: it stops allocating memory when it is large enough.
struct Plan {
  explicit Plan(std::pmr::memory_resource* memory)
      : instrs(memory),
        params(memory),
        groups(memory),
        programs(memory),
        chunks(memory),
        seams(memory),
        jobs(memory),
        chunks_of(memory),
        uniform(memory) {}

  /// The indices of a chunk's parts in the batch.
  struct Parts {
    uint32_t job = 0;
    uint32_t body = kNone;
    std::array<uint32_t, 6> seams{};  ///< index of each seam's part, by Face; kNone: the seam is not requested
  };

  std::pmr::vector<Instr> instrs;
  std::pmr::vector<uint32_t> params;
  std::pmr::vector<ProgramGroup> groups;
  std::pmr::vector<Program> programs;
  std::pmr::vector<Chunk> chunks;
  std::pmr::vector<Seam> seams;
  std::pmr::vector<PruneJob> jobs;
  std::pmr::vector<Parts> chunks_of;   ///< one for each of `chunks`
  std::pmr::vector<uint32_t> uniform;  ///< indices of jobs whose programs have no group, so that nothing is to be done
  uint32_t part_count = 0;
  bool meshes = false, sums = false;  ///< true if a job requests its mesh; true if a job requests only sums
  /// total number of entries, one for each pair of an instruction (or group) and a box
  uint64_t marks = 0, bounds = 0;
};

/// Returns the memory for pruned programs in all boxes, in instructions and groups: enough for all of them, up to the
/// limit.
struct PoolSize {
  uint64_t instrs, groups;
};
PoolSize poolOf(uint64_t marks, uint64_t bounds, const Room& room);

/// Plans jobs for one submission. Returns how many of the jobs were planned, from the first on; at least one. Throws
/// std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const Room& room, Plan& plan);

}  // namespace sgm::cuda
