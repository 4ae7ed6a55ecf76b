#pragma once
// The layout of a batch's words, as the mesher's shaders read and write them. This is the C++ version of
// shaders/mesher/batch.glsl, which explains each word.

#include <cstdint>

namespace sgm::batch {

inline constexpr uint32_t kNoRoom = 0xFFFFFFFFu;

struct Chunk {
  int32_t origin[3];
  int32_t cell;
  uint32_t samples, signs, rows, part;
  uint32_t faces, reserved[7];
};
static_assert(sizeof(Chunk) == 16 * sizeof(uint32_t));

struct Seam {
  uint32_t chunk, face, samples, signs, counts, part, reserved[2];
};
static_assert(sizeof(Seam) == 8 * sizeof(uint32_t));

/// A pruning job: one program is pruned to each box of a set. The boxes are the bricks of a chunk, or the planes of its
/// seams.
struct PruneJob {
  enum Kind : uint32_t { bricks, own_planes, coarse_planes };
  uint32_t headers, records, kind, chunk, first_seam, seam_count, lists;
  float initial;
  uint32_t initial_label;
  float q_scale;
  uint32_t reserved[2];
};
static_assert(sizeof(PruneJob) == 12 * sizeof(uint32_t));

struct Head {
  uint32_t dispatch[3];
  uint32_t cells, vertices, indices;
  uint32_t sampled[3];
  uint32_t entries;
  uint32_t units[3];
  uint32_t reserved[3];
};
static_assert(sizeof(Head) == 16 * sizeof(uint32_t));

struct Part {
  uint32_t vertices, indices, first_vertex, first_index, hash[2], cells, middle;
};
static_assert(sizeof(Part) == 8 * sizeof(uint32_t));

/// The sums over a part's triangles. If sums are requested, these records follow the records of all parts.
struct Sums {
  uint32_t area[2], cross[3][2], six_volumes[2];  ///< 64-bit numbers, the low word first
};
static_assert(sizeof(Sums) == 10 * sizeof(uint32_t));

/// The push constants (shaders/mesher/sizes.glsl). The list of active cells has room for max_cells cells of kCellWords
/// words each.
struct Sizes {
  uint32_t part_count, seam_records, cell_list, max_vertices, max_indices, max_cells;
  // Sizes for pruning, sampling and attributes (shaders/mesher/items.glsl).
  uint32_t chunk_count = 0, jobs = 0, items = 0, sampled = 0, entries = 0, units = 0;
};
static_assert(sizeof(Sizes) == 12 * sizeof(uint32_t));

/// The largest number of parts for which the 32-bit sums of a batch cannot overflow, whatever the signs of samples.
inline constexpr uint32_t kMaxParts = 8192;

inline constexpr uint32_t kItemWords = 8;   ///< words per item, that is, per brick or plane (shaders/mesher/items.glsl)
inline constexpr uint32_t kBricks = 64;     ///< number of bricks in a chunk
inline constexpr uint32_t kMaxSlices = 16;  ///< the maximum number of slices into which sampling divides an item
/// number of words of a unit: a group of vertices whose attributes are evaluated together
inline constexpr uint32_t kUnitWords = 4;

// Numbers of words in scratch, rounded up so that every offset is a multiple of four.
inline constexpr uint32_t kSampleWords = 33 * 33 * 33 + 3;   ///< words for the samples of a chunk
inline constexpr uint32_t kSignWords = 2 * 33 * 33 + 2;      ///< words for the signs of a chunk
inline constexpr uint32_t kRowsWords = 5384;                 ///< words for the counts of all rows of a chunk
inline constexpr uint32_t kCoarseSampleWords = 17 * 17 + 3;  ///< words for the samples of a seam's coarser level
inline constexpr uint32_t kCoarseSignWords = 17 + 3;         ///< words for the signs of a seam's coarser level
inline constexpr uint32_t kSeamCountWords = 392;             ///< words for the counts of a seam
inline constexpr uint32_t kCellWords = 4;                    ///< words for an active cell

}  // namespace sgm::batch
