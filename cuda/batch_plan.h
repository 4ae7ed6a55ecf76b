#pragma once
// The plan of one batch (one GPU submission): the arrays that its kernels read.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cuda/kernels/batch.h"

namespace sgm::cuda {

/// The maximum number of chunks in one batch.
inline constexpr uint32_t kMaxChunks = 256;

/// Memory limits of a batch. vertices, indices: number of output vertices and of indices per chunk, on average, for
/// which memory is reserved. scratch_bytes: limit on a batch's scratch memory and parameters; only a batch of a single
/// chunk may exceed it.
struct Room {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint64_t scratch_bytes = uint64_t{512} << 20;
  uint64_t pool_bytes = uint64_t{128} << 20;  ///< the share of scratch_bytes that holds pruned programs
};

/// The arrays of one batch. The same object is reused for later batches: its arrays keep their memory, so they soon
/// need no more allocations.
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

  /// The numbers, within the batch, of one chunk's mesh parts: its body, and its seams to coarser neighbours.
  struct Parts {
    uint32_t job = 0;
    uint32_t body = kNone;
    std::array<uint32_t, 6> seams{};  ///< for each Face: number of the seam's part; kNone if the seam is not requested
  };

  std::pmr::vector<Instr> instrs;
  std::pmr::vector<uint32_t> params;
  std::pmr::vector<ProgramGroup> groups;
  std::pmr::vector<Program> programs;
  std::pmr::vector<Chunk> chunks;
  std::pmr::vector<Seam> seams;
  std::pmr::vector<PruneJob> jobs;
  std::pmr::vector<Parts> chunks_of;   ///< one entry for each element of `chunks`, in the same order
  std::pmr::vector<uint32_t> uniform;  ///< indices of jobs whose field has the same sign everywhere: they have no
                                       ///< surface, so the GPU skips them
  uint32_t part_count = 0;
  bool meshes = false, sums = false;  ///< whether any job requests its mesh; whether any job requests only sums
  /// numbers of entries of two scratch arrays: `marks` has an entry for each instruction and box, `bounds` for each
  /// instruction group and box
  uint64_t marks = 0, bounds = 0;
};

/// The size of the pools for pruned programs: enough to store every program unpruned for each of its boxes, but at most
/// room.pool_bytes.
struct PoolSize {
  uint64_t instrs, groups;
};
PoolSize poolOf(uint64_t marks, uint64_t bounds, const Room& room);

/// Fills the plan with jobs from the beginning of the list, until the limits are reached. Returns how many jobs were
/// planned, at least one. Throws std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const Room& room, Plan& plan);

}  // namespace sgm::cuda
