#pragma once
// Conversions between positions in a chunk and indices in the arrays of a batch.

#include "cuda/kernels/batch.h"
#include "cuda/kernels/block.h"
#include "mesh/hash.h"
#include "mesh/vertex.h"

namespace sgm::cuda {

SGM_KERNEL size_t rowOf(int y, int z) { return static_cast<size_t>(y) + size_t{kSide} * static_cast<size_t>(z); }

/// One of the 64 boxes into which a chunk's samples are divided: 8 samples along each axis, and 9 in the last brick of
/// an axis.
struct Brick {
  int at[3];
  SGM_KERNEL explicit Brick(uint32_t number)
      : at{static_cast<int>(number & 3), static_cast<int>(number >> 2 & 3), static_cast<int>(number >> 4)} {}
  SGM_KERNEL int first(int axis) const { return at[axis] * static_cast<int>(kBrickCells); }
  SGM_KERNEL int last(int axis) const {
    return at[axis] == 3 ? kChunkCells : first(axis) + static_cast<int>(kBrickCells) - 1;
  }
  SGM_KERNEL int count(int axis) const { return last(axis) - first(axis) + 1; }
  /// Returns a mask of the brick's samples within the sign word of a row.
  SGM_KERNEL uint64_t bits() const { return ((uint64_t{1} << count(0)) - 1) << first(0); }
};

SGM_KERNEL uint32_t planeItem(const Batch& b, uint32_t seam, bool coarse) {
  return kBricks * b.chunk_count + 2 * seam + (coarse ? 1 : 0);
}

SGM_KERNEL ProgramView viewOf(const Batch& b, const Program& p) {
  ProgramView view;
  view.instrs = {b.instrs + p.first_instr, p.instrs};
  view.params = {b.params + p.first_param, p.params};
  view.groups = {b.groups + p.first_group, p.groups};
  view.initial = p.initial;
  view.initial_label = p.initial_label;
  view.q_scale = p.q_scale;
  return view;
}

/// Returns a program that is valid in the item's box: the pruned program if it exists, otherwise the whole program.
SGM_KERNEL ProgramView viewOf(const Batch& b, const Item& item) {
  ProgramView view = viewOf(b, b.programs[item.program]);
  if (item.pruned == 0) return view;
  view.instrs = {b.pool_instrs + item.first_instr, item.instrs};
  view.groups = {b.pool_groups + item.first_group, item.groups};
  view.initial = item.initial;
  view.initial_label = item.initial_label;
  return view;
}

SGM_KERNEL ChunkGrid gridOf(const Chunk& chunk) {
  ChunkGrid grid;
  grid.origin = {chunk.origin[0], chunk.origin[1], chunk.origin[2]};
  grid.cell = chunk.cell;
  return grid;
}

/// The crossed edges (edges whose two ends have different signs) that start at the samples of one row. One word per
/// axis: bit x belongs to the edge that starts at sample x.
struct RowEdges {
  uint64_t x, y, z;
  SGM_KERNEL RowEdges(const uint64_t* signs, int row_y, int row_z) {
    const uint64_t* row = signs + rowOf(row_y, row_z);
    x = (row[0] ^ row[0] >> 1) & ((uint64_t{1} << kChunkCells) - 1);
    y = row_y < kChunkCells ? row[0] ^ row[1] : 0;
    z = row_z < kChunkCells ? row[0] ^ row[kSide] : 0;
  }
  SGM_KERNEL uint32_t countIn(uint64_t samples) const {
    return countOf(x & samples) + countOf(y & samples) + countOf(z & samples);
  }
  /// Returns how many vertices of the row precede the vertex on the edge that starts at sample `at` along `axis`.
  SGM_KERNEL uint32_t before(uint32_t at, uint32_t axis) const {
    return countIn((uint64_t{1} << at) - 1) + (axis > 0 ? static_cast<uint32_t>(x >> at & 1) : 0) +
           (axis > 1 ? static_cast<uint32_t>(y >> at & 1) : 0);
  }
};

/// One thread's contribution to the content hash of a part (mesh/hash.h).
struct PartSum {
  uint32_t a = 0, b = 0;
  SGM_KERNEL void add(uint32_t word, uint32_t place) {
    const uint32_t h = mixWord(word, place);
    a += h;
    b += h * (2 * place + 1);
  }
  SGM_KERNEL void add(const Vertex& v, uint32_t number) {
    const uint32_t words[4] = {static_cast<uint16_t>(v.x) | uint32_t{static_cast<uint16_t>(v.y)} << 16,
                               static_cast<uint16_t>(v.z) | uint32_t{v.material} << 16,
                               static_cast<uint16_t>(v.normal_x) | uint32_t{static_cast<uint16_t>(v.normal_y)} << 16,
                               v.tag | uint32_t{v.kind} << 16};
    for (uint32_t w = 0; w < 4; ++w) add(words[w], 4 * number + w);
  }
  SGM_KERNEL void addIndex(uint32_t index, uint32_t place) { add(index, 0x80000000u + place); }
  SGM_KERNEL void giveTo(uint32_t (&hash)[2]) const {
    if ((a | b) == 0) return;
    addTo(hash[0], a);
    addTo(hash[1], b);
  }
};

}  // namespace sgm::cuda
