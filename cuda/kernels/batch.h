#pragma once
// The input and output of a batch's kernels. Plain words; offsets are relative to the beginning of their array.

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

/// The location of a program in the batch's arrays. Its groups count instructions, and these count parameters, from its
/// own first ones.
struct Program {
  uint32_t first_instr, instrs, first_param, params, first_group, groups;
  float initial;
  uint32_t initial_label;
  float q_scale;
};

struct Chunk {
  int32_t origin[3], cell;  ///< units
  uint32_t body;            ///< index of its part; kNone: only seams are requested
  uint32_t faces;           ///< for a chunk without a body: the faces with seams, bit (1 << Face); else 0
};

struct Seam {
  uint32_t chunk, face, part;
};

/// All boxes for which one program is pruned, at most 64: the bricks of a chunk, or the planes of its seams.
struct PruneJob {
  enum Kind : uint32_t { bricks, own_planes, coarse_planes };
  uint32_t kind, chunk, program, first_seam, boxes;
  uint64_t marks, bounds;  ///< offsets in scratch: one entry for each instruction (or group) and box
};

struct Mark {
  float lo, hi;
};

/// The bounds that decide about a group (field/prune_kernel.inl).
struct GroupBounds {
  Mark value;
  bool met, whole, live;
};

/// A program pruned to one box. Index: 64 * chunk + brick for bricks; then two for each seam, its plane with the
/// chunk's own program and with that of the level above.
struct Item {
  enum State : uint32_t { mixed, solid, empty };
  uint32_t state;
  uint32_t program;
  uint32_t pruned;  ///< 0: no room, or not sampled; then use the whole program, which is valid everywhere
  uint32_t first_instr, instrs, first_group, groups;  ///< if pruned
  float initial;
  uint32_t initial_label;
};

/// The counts of a chunk before a row of samples.
struct Row {
  uint32_t vertices, indices, cells;
};

/// An active cell, x + 32 y + 1024 z, with its case above these bits, and its first index in the part.
struct Cell {
  uint32_t place, first_index;
};

/// The census of a seam. Rows: the counts before them.
struct SeamCensus {
  uint64_t plane[kSide];  ///< the chunk's signs on the face, bit a of row b
  uint32_t fine[kSide], coarse[kCoarseSide], lateral[kCoarseSide];
  uint32_t first_coarse, first_lateral;  ///< number of vertices before them
  uint32_t indices[kSeamCells];          ///< number before each cell, a + 16 b
};

struct Part {
  uint32_t vertices, indices;
  uint32_t first_vertex, first_index;  ///< kNone: no room
  uint32_t hash[2];
};

/// Sums over a part's triangles, as in mesh/part_sums.h.
struct Sums {
  uint64_t area, cross[3], six_volumes;
};

struct Head {
  uint32_t sampled;                   ///< length of the list of sampled items
  uint32_t pool_instrs, pool_groups;  ///< entries taken, or requested without success
  uint32_t vertices, indices;         ///< up to the end of the last part with room
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
  // Input from the host.
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
  uint32_t* sampled;        ///< sampled items, unordered
  int32_t* samples;         ///< kSamples a chunk: Q, x fastest
  uint64_t* signs;          ///< kRows a chunk; zero at first. Bit x: solid
  int32_t* coarse_samples;  ///< kCoarsePlane a seam
  uint32_t* coarse_signs;   ///< kCoarseSide a seam
  Row* rows;                ///< kRows a chunk
  Cell* cells;              ///< 32^3 a chunk
  SeamCensus* seam_census;  ///< one a seam
  // Output.
  Head* head;   ///< zero at first
  Part* parts;  ///< same as above
  Sums* sums;   ///< same as above, one a part; null if no chunk wants only sums
  bool meshes;  ///< whether a chunk wants its mesh: only meshes need attributes
  Vertex* vertices;
  uint32_t* indices;
};

}  // namespace sgm::cuda
