#pragma once
// The voids of one chunk for agents of one size. For each face of the chunk, the samples are labelled with their voids,
// so that contacts with the voids of the adjacent chunk are exact. Streaming uses the masks of mesh/void_components.h
// instead, which are coarser: one bit per block of samples.

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
  std::pmr::vector<Void> voids;  ///< voids in the order of their first samples
  /// For each Face, the void of each of its samples: the element a + 33 * b contains the number of the void plus one,
  /// or 0 if the sample is not free. a and b count samples along the other two axes, the lower axis first. Empty if no
  /// void touches the face.
  std::array<std::pmr::vector<uint16_t>, 6> faces;
  /// for each of the `marks` (requested samples), the index of the void that contains it; nullopt if the sample is not
  /// free
  std::vector<std::optional<uint32_t>> marked;
};

/// Finds the voids. rows: in the format of ChunkSamples::signs; a bit is set if the sample is not free. owned: number
/// of samples on each axis that belong to this chunk: 32, or 33 if no chunk follows. marks: samples whose voids are to
/// be returned, each coordinate 0 to 32. Pure.
ChunkVoids chunkVoids(std::span<const uint64_t> rows, Int3 owned, std::span<const Int3> marks,
                      std::pmr::memory_resource* memory);

}  // namespace sgm
