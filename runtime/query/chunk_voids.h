#pragma once
// The voids of one chunk for agents of one size. For each face of the chunk, the samples are labelled with their voids,
// so that contacts with the voids of the adjacent chunk are exact. The masks of mesh/void_components.h have only blocks
// of samples, which is precise enough for streaming.

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
    uint32_t samples = 0;  ///< number of the void's samples that the chunk owns
    uint8_t faces = 0;     ///< faces that the void touches: bit (1 << Face)
  };
  std::pmr::vector<Void> voids;  ///< sorted by their first samples
  /// By Face: for sample a + 33 b of the face, the number of its void plus one; 0 if the sample is not free. a and b
  /// count along the other two axes, the lower axis first. Empty if no void touches the face.
  std::array<std::pmr::vector<uint16_t>, 6> faces;
  /// for each mark, the void that contains it; nullopt if the mark is not free
  std::vector<std::optional<uint32_t>> marked;
};

/// Finds the voids. rows: in the format of ChunkSamples::signs; a bit is set if the sample is not free. owned: number
/// of samples on each axis that belong to this chunk: 32, or 33 if no chunk follows. marks: samples whose voids are
/// wanted, each 0 to 32 on each axis. Pure.
ChunkVoids chunkVoids(std::span<const uint64_t> rows, Int3 owned, std::span<const Int3> marks,
                      std::pmr::memory_resource* memory);

}  // namespace sgm
