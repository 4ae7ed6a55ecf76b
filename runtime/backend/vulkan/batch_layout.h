#pragma once
// The words of a batch as the mesher's shaders read and write them: shaders/mesher/batch.glsl in C++, where each is
// explained.

#include <cstdint>

namespace sgm::batch {

inline constexpr uint32_t kNoRoom = 0xFFFFFFFFu;

struct Chunk {
  int32_t origin[3];
  int32_t cell;
  uint32_t samples, signs, row_starts, part;
  uint32_t tape[8];
};
static_assert(sizeof(Chunk) == 16 * sizeof(uint32_t));

struct Seam {
  uint32_t chunk, face, samples, signs, counts, part, reserved[2];
};
static_assert(sizeof(Seam) == 8 * sizeof(uint32_t));

struct Head {
  uint32_t dispatch[3];
  uint32_t cells, vertices, indices, reserved[10];
};
static_assert(sizeof(Head) == 16 * sizeof(uint32_t));

struct Part {
  uint32_t vertices, indices, first_vertex, first_index, hash[2], cells, middle;
};
static_assert(sizeof(Part) == 8 * sizeof(uint32_t));

inline constexpr uint32_t kSamples = 33 * 33 * 33;   ///< words of a chunk's samples
inline constexpr uint32_t kSignWords = 2 * 33 * 33;  ///< of its signs
inline constexpr uint32_t kRowStartWords = 3 * 33 * 33;
inline constexpr uint32_t kCoarseSamples = 17 * 17;  ///< of a seam
inline constexpr uint32_t kCoarseSigns = 17;
inline constexpr uint32_t kSeamCounts = 352;

}  // namespace sgm::batch
