#pragma once
// The voids of one chunk for agents of one size. For each face of the chunk they tell which sample belongs to which
// void, so that contacts with the voids of the adjacent chunk are exact. The masks of mesh/void_components.h are
// coarser, but good enough for streaming.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

struct ChunkVoids {
  struct Void {
    uint32_t samples = 0;  ///< that the chunk owns
    uint8_t faces = 0;     ///< that the void touches, bit (1 << Face)
  };
  std::pmr::vector<Void> voids;  ///< in the order of their first samples
  /// By Face: the number of the void with sample a + 33 b of the face, plus one; 0 if there is none. a and b count
  /// along the other two axes, the lower axis first. Empty if no void touches the face.
  std::array<std::pmr::vector<uint16_t>, 6> faces;
  std::vector<std::optional<uint32_t>> marked;  ///< for each mark, the void that contains it
};

/// rows: as ChunkSamples::signs, set if a sample is not free. owned: the number of samples on each axis that belong to
/// this chunk: 32, or 33 if no chunk follows. marks: samples, each 0 to 32 on each axis. Pure.
ChunkVoids chunkVoids(std::span<const uint64_t> rows, Int3 owned, std::span<const Int3> marks,
                      std::pmr::memory_resource* memory);

}  // namespace sgm
