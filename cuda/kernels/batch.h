#pragma once
// The input and output of a batch's kernels, as arrays of plain words. Offsets are indices into these arrays.

#include <cstdint>

#include "field/program.h"
#include "mesh/chunk.h"
#include "mesh/tables.h"

namespace sgm::cuda {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;
inline constexpr uint32_t kSide = kChunkSamples;  ///< number of samples of a chunk along each axis
/// number of rows of samples (along x) in a chunk; row number: y + kSide * z
inline constexpr uint32_t kRows = kSide * kSide;
inline constexpr uint32_t kSamples = kRows * kSide;                          ///< number of samples of a chunk
inline constexpr uint32_t kCells = kChunkCells * kChunkCells * kChunkCells;  ///< number of cells of a chunk
/// number of bricks of a chunk: 4 along each axis, numbered with x fastest
inline constexpr uint32_t kBricks = 64;
inline constexpr uint32_t kBrickCells = 8;   ///< number of cells of a brick along each axis
inline constexpr uint32_t kCoarseSide = 17;  ///< number of samples of the coarser level along each side of a chunk's
                                             ///< face
inline constexpr uint32_t kCoarsePlane = kCoarseSide * kCoarseSide;
inline constexpr uint32_t kSeamCells = 16 * 16;

/// The ranges of a program in the batch's arrays. Within them, offsets are relative to the ranges: groups refer to
/// instructions relative to first_instr, and instructions to parameters relative to first_param.
struct Program {
  uint32_t first_instr, instrs, first_param, params, first_group, groups;
  float initial;
  uint32_t initial_label;
  float q_scale;
};

struct Chunk {
  int32_t origin[3], cell;  ///< in units
  uint32_t body;            ///< number of the body's part; kNone if only seams are requested
  uint32_t faces;           ///< if no body is requested: the faces with requested seams, as bits 1 << Face; otherwise 0
};

struct Seam {
  uint32_t chunk, face, part;
};

/// A program and the boxes to which it is pruned (at most 64): either the bricks of a chunk, or the face planes of the
/// chunk's seams.
struct PruneJob {
  enum Kind : uint32_t { bricks, own_planes, coarse_planes };
  uint32_t kind, chunk, program, first_seam, boxes;
  /// offsets into the scratch arrays of the same names, which have an entry for each pair of instruction (or group) and
  /// box
  uint64_t marks, bounds;
};

struct Mark {
  float lo, hi;
};

/// The bounds of an instruction group's value in a box, which decide whether the pruned program keeps the group
/// (field/prune_kernel.inl).
struct GroupBounds {
  Mark value;
  bool met, whole, live;
};

/// A program pruned to one box. In the array of items, brick b of chunk c has the index 64 c + b. After all bricks,
/// each seam has two items for its face plane: first the chunk's own program, then the program of the next coarser
/// level.
struct Item {
  enum State : uint32_t { mixed, solid, empty };
  uint32_t state;
  uint32_t program;
  /// 0 if the pool for pruned programs was full or the box needed no pruned program; then the whole program is used,
  /// which is valid everywhere
  uint32_t pruned;
  uint32_t first_instr, instrs, first_group, groups;  ///< range of the pruned program in the pools, if pruned
  float initial;
  uint32_t initial_label;
};

/// For one row of samples: the totals of vertices, indices and active cells over all previous rows of the chunk.
struct Row {
  uint32_t vertices, indices, cells;
};

/// An active cell, that is, a cell that the surface crosses. place: the low 15 bits are x + 32 y + 1024 z; the bits
/// above are the cell's marching cubes case. first_index: position of the cell's first index, counted from the part's
/// first index.
struct Cell {
  uint32_t place, first_index;
};

/// The vertex and index counts of a seam (the strip of triangles between a chunk and a coarser neighbour). fine, coarse
/// and lateral have an entry for each row: the number of vertices in all previous rows.
struct SeamCensus {
  uint64_t plane[kSide];  ///< the signs of the chunk's samples on the face: bit a of word b belongs to sample (a, b)
  uint32_t fine[kSide], coarse[kCoarseSide], lateral[kCoarseSide];
  /// number of the first vertex on a coarse edge, and of the first vertex on a lateral edge (an edge between the
  /// levels)
  uint32_t first_coarse, first_lateral;
  uint32_t indices[kSeamCells];  ///< for each cell (its number is a + 16 b): the total of the indices of all previous
                                 ///< cells
};

struct Part {
  uint32_t vertices, indices;
  uint32_t first_vertex, first_index;  ///< offsets of the part's first vertex and first index in the output arrays;
                                       ///< kNone if the arrays have no room for the part
  uint32_t hash[2];
};

/// Sums over the triangles of a part, with the same meaning as in mesh/part_sums.h.
struct Sums {
  uint64_t area, cross[3], six_volumes;
};

struct Head {
  uint32_t sampled;                   ///< number of items in the list Batch::sampled
  uint32_t pool_instrs, pool_groups;  ///< number of entries requested from the pools; may exceed their capacity
  uint32_t vertices, indices;         ///< number of used elements of the output arrays: the end of the last part for
                                      ///< which they had room
};

/// The marching cubes tables, for cells of bodies and of seams (mesh/tables.h).
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

/// All input and output arrays of a batch; the only argument of a kernel.
struct Batch {
  const CaseTables* tables;
  // Input arrays, uploaded by the host:
  const Instr* instrs;
  const uint32_t* params;
  const ProgramGroup* groups;
  const Program* programs;
  const Chunk* chunks;
  const Seam* seams;
  const PruneJob* jobs;
  uint32_t chunk_count, seam_count, job_count, part_count;
  uint32_t pool_instrs_room, pool_groups_room, vertices_room, indices_room;
  // Scratch arrays, used only by kernels:
  Mark* marks;
  GroupBounds* bounds;
  Item* items;
  Instr* pool_instrs;
  ProgramGroup* pool_groups;
  uint32_t* sampled;        ///< numbers of the items to sample, in any order
  int32_t* samples;         ///< quantised field values Q, kSamples per chunk, x fastest
  uint64_t* signs;          ///< kRows words per chunk, initially zero; bit x is set if the row's sample x is solid
  int32_t* coarse_samples;  ///< quantised field values of the coarser level, kCoarsePlane per seam
  uint32_t* coarse_signs;   ///< signs of the coarser level, kCoarseSide words per seam
  Row* rows;                ///< kRows entries per chunk
  Cell* cells;              ///< 32^3 per chunk
  SeamCensus* seam_census;  ///< one entry per seam
  // Output arrays, downloaded by the host:
  Head* head;   ///< initially zero
  Part* parts;  ///< initially zero
  Sums* sums;   ///< one entry per part, initially zero; null if no chunk requests sums
  bool meshes;  ///< true if any chunk requests its mesh; if false, all chunks request only sums, so vertices need no
                ///< attributes
  Vertex* vertices;
  uint32_t* indices;
};

}  // namespace sgm::cuda
