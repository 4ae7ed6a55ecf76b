#pragma once
// What one submission meshes, as the arrays that its kernels read.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cuda/kernels/batch.h"

namespace sgm::cuda {

/// Chunks of one submission, at most.
inline constexpr uint32_t kMostChunks = 256;

/// How much of its result a batch has room for, by chunk; and how many bytes of scratch and parameters it takes at
/// most, unless one chunk alone takes more.
struct Room {
  uint32_t vertices = 6144;
  uint32_t indices = 36864;
  uint64_t scratch_bytes = uint64_t{512} << 20;
  uint64_t pool_bytes = uint64_t{128} << 20;  ///< of these, for what pruning leaves, at most
};

/// Reused from batch to batch: grows, and then takes no more memory.
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

  /// Where the meshes of a job will be.
  struct Parts {
    uint32_t job = 0;
    uint32_t body = kNone;
    std::array<uint32_t, 6> seams{};  ///< by Face; kNone: not asked for
  };

  std::pmr::vector<Instr> instrs;
  std::pmr::vector<uint32_t> params;
  std::pmr::vector<ProgramGroup> groups;
  std::pmr::vector<Program> programs;
  std::pmr::vector<Chunk> chunks;
  std::pmr::vector<Seam> seams;
  std::pmr::vector<PruneJob> jobs;
  std::pmr::vector<Parts> chunks_of;   ///< as chunks
  std::pmr::vector<uint32_t> uniform;  ///< numbers of jobs whose programs have no group: nothing is to be done
  uint32_t part_count = 0;
  bool meshes = false, sums = false;  ///< whether a job wants its mesh; whether one wants sums alone
  uint64_t marks = 0, bounds = 0;     ///< entries: an instruction, or group, of one box
};

/// How much pruning may leave in all boxes, in instructions and groups: all of them, as far as there is room.
struct PoolSize {
  uint64_t instrs, groups;
};
PoolSize poolOf(uint64_t marks, uint64_t bounds, const Room& room);

/// Plans jobs for one submission; how many of them were taken up, from the first on. At least one is. Throws
/// std::bad_alloc.
size_t planBatch(std::span<const ChunkJob> jobs, const Room& room, Plan& plan);

}  // namespace sgm::cuda
