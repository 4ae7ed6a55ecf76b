#pragma once
// The input and output of a batch's kernels, as arrays of plain words. Offsets count from the beginning of their array.

#include <cstdint>

#include "field/program.h"
#include "mesh/chunk.h"
#include "mesh/tables.h"

namespace sgm::cuda {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;
inline constexpr uint32_t kSide = kChunkSamples;  ///< samples of a chunk on each axis
/// rows of samples in a chunk; row y + kSide * z
inline constexpr uint32_t kRows = kSide * kSide;
inline constexpr uint32_t kSamples = kRows * kSide;                          ///< samples of a chunk
inline constexpr uint32_t kCells = kChunkCells * kChunkCells * kChunkCells;  ///< cells of a chunk
/// bricks of a chunk: 4 on each axis, x fastest
inline constexpr uint32_t kBricks = 64;
inline constexpr uint32_t kBrickCells = 8;   ///< cells of a brick on each axis
inline constexpr uint32_t kCoarseSide = 17;  ///< coarse samples along a side of a face
inline constexpr uint32_t kCoarsePlane = kCoarseSide * kCoarseSide;
inline constexpr uint32_t kSeamCells = 16 * 16;

/// Where a program is in the batch's arrays. Its groups give offsets of instructions, and its instructions offsets of
/// parameters, relative to the program's first ones.
struct Program {
  uint32_t first_instr, instrs, first_param, params, first_group, groups;
  float initial;
  uint32_t initial_label;
  float q_scale;
};

struct Chunk {
  int32_t origin[3], cell;  ///< in units
  uint32_t body;            ///< index of the body's part; kNone: only seams are requested
  uint32_t faces;           ///< for a chunk without a body: the faces with seams, bit (1 << Face); otherwise 0
};

struct Seam {
  uint32_t chunk, face, part;
};

/// The boxes, at most 64, to which one program is pruned: the bricks of a chunk, or the planes of its seams.
struct PruneJob {
  enum Kind : uint32_t { bricks, own_planes, coarse_planes };
  uint32_t kind, chunk, program, first_seam, boxes;
  /// offsets in scratch; there is one entry for each pair of an instruction (or group) and a box
  uint64_t marks, bounds;
};

struct Mark {
  float lo, hi;
};

/// The bounds of a group in a box, which decide whether the group stays (field/prune_kernel.inl).
struct GroupBounds {
  Mark value;
  bool met, whole, live;
};

/// A program pruned to one box. The item for brick b of a chunk has index 64 * chunk + b. Two items for each seam
/// follow: its plane with the chunk's own program, and with that of the level above.
struct Item {
  enum State : uint32_t { mixed, solid, empty };
  uint32_t state;
  uint32_t program;
  /// 0: there was no memory, or the box is not sampled; then the whole program is used, which is valid everywhere
  uint32_t pruned;
  uint32_t first_instr, instrs, first_group, groups;  ///< range of the pruned program, if pruned
  float initial;
  uint32_t initial_label;
};

/// Numbers of vertices, cells and indices of a chunk before a row of samples.
struct Row {
  uint32_t vertices, indices, cells;
};

/// An active cell: x + 32 y + 1024 z, with its case in the bits above; and the number of its first index in the part.
struct Cell {
  uint32_t place, first_index;
};

/// The counts of a seam; arrays by row contain the counts before each row.
struct SeamCensus {
  uint64_t plane[kSide];  ///< the chunk's signs on the face: bit a of row b
  uint32_t fine[kSide], coarse[kCoarseSide], lateral[kCoarseSide];
  /// numbers of vertices before those on coarse edges, and before the lateral ones
  uint32_t first_coarse, first_lateral;
  uint32_t indices[kSeamCells];  ///< number of indices before each cell a + 16 b
};

struct Part {
  uint32_t vertices, indices;
  uint32_t first_vertex, first_index;  ///< where the part begins in the output; kNone: there was no memory for it
  uint32_t hash[2];
};

/// Sums over the triangles of a part, same as in mesh/part_sums.h.
struct Sums {
  uint64_t area, cross[3], six_volumes;
};

struct Head {
  uint32_t sampled;                   ///< number of items in the list of sampled items
  uint32_t pool_instrs, pool_groups;  ///< entries taken from the pools, including requests beyond their ends
  uint32_t vertices, indices;         ///< up to the end of the last part for which there was memory
};

/// The case tables (mesh/tables.h).
struct CaseTables {
  uint16_t cube_start[256 + 1];
  uint8_t cube_loops[kCubeLoopBytes];
  uint8_t cube_triangles[256];
  uint16_t cube_edge_faces[kCubeEdges];
  uint32_t seam_start[8192 + 1];
  uint8_t seam_loops[kSeamLoopBytes];
  uint8_t seam_triangles[8192];
  uint16_t seam_edge_faces[kSeamEdges];
};

/// The only argument of a kernel.
struct Batch {
  const CaseTables* tables;
  // The following arrays are input from the host.
  const Instr* instrs;
  const uint32_t* params;
  const ProgramGroup* groups;
  const Program* programs;
  const Chunk* chunks;
  const Seam* seams;
  const PruneJob* jobs;
  uint32_t chunk_count, seam_count, job_count, part_count;
  uint32_t pool_instrs_room, pool_groups_room, vertices_room, indices_room;
  // The following arrays are scratch.
  Mark* marks;
  GroupBounds* bounds;
  Item* items;
  Instr* pool_instrs;
  ProgramGroup* pool_groups;
  uint32_t* sampled;        ///< list of the items that are sampled, unordered
  int32_t* samples;         ///< kSamples per chunk: quantised values Q, x fastest
  uint64_t* signs;          ///< kRows per chunk; initially zero. Bit x is set if the sample is solid
  int32_t* coarse_samples;  ///< kCoarsePlane per seam
  uint32_t* coarse_signs;   ///< kCoarseSide per seam
  Row* rows;                ///< kRows per chunk
  Cell* cells;              ///< 32^3 per chunk
  SeamCensus* seam_census;  ///< one per seam
  // The following arrays are output.
  Head* head;   ///< initially zero
  Part* parts;  ///< initially zero
  Sums* sums;   ///< initially zero; one per part; null if no chunk requests sums
  bool meshes;  ///< true if a chunk requests its mesh: sums need no attributes
  Vertex* vertices;
  uint32_t* indices;
};

}  // namespace sgm::cuda
