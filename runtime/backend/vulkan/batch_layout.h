#pragma once
// The words of a batch, as the mesher's shaders read and write them: shaders/mesher/batch.glsl in C++; see there for
// each word.

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

/// Boxes that are pruned together, with one program.
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

/// After all parts, if sums are requested.
struct Sums {
  uint32_t area[2], cross[3][2], six_volumes[2];  ///< low words first
};
static_assert(sizeof(Sums) == 10 * sizeof(uint32_t));

/// The push constants (shaders/mesher/sizes.glsl). The list of active cells has kCellWords for each of max_cells.
struct Sizes {
  uint32_t part_count, seam_records, cell_list, max_vertices, max_indices, max_cells;
  // The sizes that pruning, sampling and attributes need in addition (shaders/mesher/items.glsl).
  uint32_t chunk_count = 0, jobs = 0, items = 0, sampled = 0, entries = 0, units = 0;
};
static_assert(sizeof(Sizes) == 12 * sizeof(uint32_t));

/// The largest number for which the 32-bit sums of a batch cannot overflow, whatever its signs are.
inline constexpr uint32_t kMaxParts = 8192;

inline constexpr uint32_t kItemWords = 8;    ///< of a brick or a plane (shaders/mesher/items.glsl)
inline constexpr uint32_t kBricks = 64;      ///< of a chunk
inline constexpr uint32_t kMostSlices = 16;  ///< the most slices for sampling an item
inline constexpr uint32_t kUnitWords = 4;    ///< of attributes

// Words in scratch, rounded up: every offset is a multiple of four.
inline constexpr uint32_t kSampleWords = 33 * 33 * 33 + 3;   ///< a chunk's samples
inline constexpr uint32_t kSignWords = 2 * 33 * 33 + 2;      ///< its signs
inline constexpr uint32_t kRowsWords = 5384;                 ///< the census of its rows
inline constexpr uint32_t kCoarseSampleWords = 17 * 17 + 3;  ///< a seam's samples
inline constexpr uint32_t kCoarseSignWords = 17 + 3;         ///< its signs
inline constexpr uint32_t kSeamCountWords = 392;             ///< the census of a seam
inline constexpr uint32_t kCellWords = 4;                    ///< an active cell

}  // namespace sgm::batch
