#pragma once
// The plan of one submission: the arrays that its kernels read.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cuda/kernels/batch.h"

namespace sgm::cuda {

/// The most chunks in one submission.
inline constexpr uint32_t kMostChunks = 256;

/// The space for a batch's results, per chunk; and limits for its scratch and parameters, which only a single chunk may
/// exceed.
struct Room {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint64_t scratch_bytes = uint64_t{512} << 20;
  uint64_t pool_bytes = uint64_t{128} << 20;  ///< the part of scratch_bytes that pruned programs may take
};

/// Reused from batch to batch: grows, then allocates no more memory.
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

  /// The indices of a job's meshes.
  struct Parts {
    uint32_t job = 0;
    uint32_t body = kNone;
    std::array<uint32_t, 6> seams{};  ///< by Face; kNone: not requested
  };

  std::pmr::vector<Instr> instrs;
  std::pmr::vector<uint32_t> params;
  std::pmr::vector<ProgramGroup> groups;
  std::pmr::vector<Program> programs;
  std::pmr::vector<Chunk> chunks;
  std::pmr::vector<Seam> seams;
  std::pmr::vector<PruneJob> jobs;
  std::pmr::vector<Parts> chunks_of;   ///< one for each of `chunks`
  std::pmr::vector<uint32_t> uniform;  ///< indices of jobs whose programs have no group: nothing to do
  uint32_t part_count = 0;
  bool meshes = false, sums = false;  ///< whether a job wants its mesh; whether a job wants only sums
  uint64_t marks = 0, bounds = 0;     ///< number of entries, one for each instruction (or group) and box
};

/// The space for pruned programs in all boxes, in instructions and groups: for all of them, up to the limit.
struct PoolSize {
  uint64_t instrs, groups;
};
PoolSize poolOf(uint64_t marks, uint64_t bounds, const Room& room);

/// Plans jobs for one submission. Returns the number of planned jobs, counted from the first; at least one. Throws
/// std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const Room& room, Plan& plan);

}  // namespace sgm::cuda
