#pragma once
// What the kernels of one batch read and write. Plain words; places are counted from the beginning of their array.

#include <cstdint>

#include "field/program.h"
#include "mesh/chunk.h"
#include "mesh/tables.h"

namespace sgm::cuda {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;
inline constexpr uint32_t kSide = kChunkSamples;                             ///< samples on each axis
inline constexpr uint32_t kRows = kSide * kSide;                             ///< of samples, y + kSide * z
inline constexpr uint32_t kSamples = kRows * kSide;                          ///< of a chunk
inline constexpr uint32_t kCells = kChunkCells * kChunkCells * kChunkCells;  ///< of a chunk
inline constexpr uint32_t kBricks = 64;                                      ///< of a chunk, 4 on each axis, x fastest
inline constexpr uint32_t kBrickCells = 8;                                   ///< on each axis
inline constexpr uint32_t kCoarseSide = 17;                                  ///< coarse samples along a side of a face
inline constexpr uint32_t kCoarsePlane = kCoarseSide * kCoarseSide;
inline constexpr uint32_t kSeamCells = 16 * 16;

/// Where a program lies in the batch's arrays. Its groups count instructions, and these parameters, from its own first.
struct Program {
  uint32_t first_instr, instrs, first_param, params, first_group, groups;
  float initial;
  uint32_t initial_label;
  float q_scale;
};

struct Chunk {
  int32_t origin[3], cell;  ///< units
  uint32_t body;            ///< number of its part; kNone: only seams are asked for
  uint32_t faces;           ///< 0, or of a chunk without a body the faces that it has seams on, bit (1 << Face)
};

struct Seam {
  uint32_t chunk, face, part;
};

/// All boxes that one program is asked about, at most 64: the bricks of a chunk, or the planes of its seams.
struct PruneJob {
  enum Kind : uint32_t { bricks, own_planes, coarse_planes };
  uint32_t kind, chunk, program, first_seam, boxes;
  uint64_t marks, bounds;  ///< places in scratch: for each instruction, and for each group, one for each box
};

struct Mark {
  float lo, hi;
};

/// What decides about a group (field/prune_kernel.inl).
struct GroupBounds {
  Mark value;
  bool met, whole, live;
};

/// What pruning has left of a program in one box: of a brick by 64 * chunk + brick, then two for each seam, its plane
/// by the chunk's own program and by that of the level above.
struct Item {
  enum State : uint32_t { mixed, solid, empty };
  uint32_t state;
  uint32_t program;
  uint32_t pruned;  ///< 0: found no room, or is not sampled. The program as a whole holds everywhere
  uint32_t first_instr, instrs, first_group, groups;  ///< where pruned
  float initial;
  uint32_t initial_label;
};

/// Of a row of samples, what lies before it in its chunk.
struct Row {
  uint32_t vertices, indices, cells;
};

/// An active cell, x + 32 y + 1024 z, its case above, and the first of its indices in the part.
struct Cell {
  uint32_t place, first_index;
};

/// The census of a seam. Rows: what lies before them.
struct SeamCensus {
  uint64_t plane[kSide];  ///< the chunk's signs on the face, bit a of row b
  uint32_t fine[kSide], coarse[kCoarseSide], lateral[kCoarseSide];
  uint32_t first_coarse, first_lateral;  ///< vertices before them
  uint32_t indices[kSeamCells];          ///< before each cell, a + 16 b
};

struct Part {
  uint32_t vertices, indices;
  uint32_t first_vertex, first_index;  ///< kNone: there is no room for it
  uint32_t hash[2];
};

/// Over a part's triangles, as mesh/part_sums.h has them.
struct Sums {
  uint64_t area, cross[3], six_volumes;
};

struct Head {
  uint32_t sampled;                   ///< entries of the list of items that are sampled
  uint32_t pool_instrs, pool_groups;  ///< taken, or asked for in vain
  uint32_t vertices, indices;         ///< up to the end of the last part that has room
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

/// A kernel's one argument.
struct Batch {
  const CaseTables* tables;
  // What the host has written.
  const Instr* instrs;
  const uint32_t* params;
  const ProgramGroup* groups;
  const Program* programs;
  const Chunk* chunks;
  const Seam* seams;
  const PruneJob* jobs;
  uint32_t chunk_count, seam_count, job_count, part_count;
  uint32_t pool_instrs_room, pool_groups_room, vertices_room, indices_room;
  // Scratch.
  Mark* marks;
  GroupBounds* bounds;
  Item* items;
  Instr* pool_instrs;
  ProgramGroup* pool_groups;
  uint32_t* sampled;        ///< items that are sampled, in no order
  int32_t* samples;         ///< kSamples a chunk: Q, x fastest
  uint64_t* signs;          ///< kRows a chunk; zero at first. Bit x: solid
  int32_t* coarse_samples;  ///< kCoarsePlane a seam
  uint32_t* coarse_signs;   ///< kCoarseSide a seam
  Row* rows;                ///< kRows a chunk
  Cell* cells;              ///< 32^3 a chunk
  SeamCensus* seam_census;  ///< one a seam
  // What comes of it.
  Head* head;   ///< zero at first
  Part* parts;  ///< likewise
  Sums* sums;   ///< likewise, one a part; null where no chunk wants sums alone
  bool meshes;  ///< whether a chunk wants its mesh: attributes are of nothing else
  Vertex* vertices;
  uint32_t* indices;
};

}  // namespace sgm::cuda
