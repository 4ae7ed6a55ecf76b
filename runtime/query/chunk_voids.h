#pragma once
// The voids of one chunk for agents of one size, sample by sample in its faces: what voids of chunks side by side have
// in common is then exact, unlike the masks of mesh/void_components.h, which streaming can afford to have too coarse.

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
    uint32_t samples = 0;  ///< of those that the chunk owns
    uint8_t faces = 0;     ///< that it touches, bit (1 << Face)
  };
  std::pmr::vector<Void> voids;  ///< in the order of their first samples
  /// By Face: one more than the number of the void that has sample a + 33 b of the face, 0 where none has; a and b
  /// count along the two other axes, the lower axis first. Empty where no void touches the face.
  std::array<std::pmr::vector<uint16_t>, 6> faces;
  std::vector<std::optional<uint32_t>> marked;  ///< of each mark the void that it lies in
};

/// rows: as ChunkSamples::signs, set where a sample is not free. owned: samples on each axis that count for this chunk,
/// from 0 on: 32, or 33 where no chunk comes after it. marks: samples, each 0 to 32 on each axis. Pure.
ChunkVoids chunkVoids(std::span<const uint64_t> rows, Int3 owned, std::span<const Int3> marks,
                      std::pmr::memory_resource* memory);

}  // namespace sgm
