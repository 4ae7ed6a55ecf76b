#include <algorithm>

#include "backend/cpu/mesh_chunk.h"

namespace sgm {

namespace {

// A box of samples: first..last on each axis, both included.
struct SampleBox {
  std::array<int, 3> first{}, last{};
};

IntBox boxOf(const ChunkGrid& grid, const SampleBox& b, int margin) {
  auto at = [&](int axis, int sample) { return grid.origin[axis] + std::clamp(sample, 0, kChunkCells) * grid.cell; };
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    box.lo[axis] = at(axis, b.first[a] - margin);
    box.hi[axis] = at(axis, b.last[a] + margin);
  }
  return box;
}

void fillSigns(ChunkSamples& samples, const SampleBox& b) {
  const uint64_t run = ((uint64_t{1} << (b.last[0] - b.first[0] + 1)) - 1) << b.first[0];
  for (int z = b.first[2]; z <= b.last[2]; ++z) {
    for (int y = b.first[1]; y <= b.last[1]; ++y) {
      samples.signs[static_cast<size_t>(y + z * kChunkSamples)] |= run;
    }
  }
}

void sampleBrick(const FieldKernels& kernels, const ProgramView& field, const ChunkGrid& grid, const SampleBox& b,
                 ChunkScratch& scratch) {
  LatticeBox box;
  for (size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    box.origin[axis] = grid.origin[axis] + b.first[a] * grid.cell;
    box.size[a] = static_cast<size_t>(b.last[a] - b.first[a] + 1);
  }
  box.step = grid.cell;
  constexpr size_t kSide = kChunkSamples;
  const auto row = static_cast<size_t>(b.first[1] + b.first[2] * kChunkSamples),
             first = static_cast<size_t>(b.first[0]);
  kernels.box(field, box, scratch.evaluation,
              {scratch.samples.q.data() + row * kSide + first, kSide, kSide * kSide, scratch.samples.signs.data() + row,
               kSide, first});
}

/// True if the box has samples in one of the given faces of the chunk.
bool touches(const SampleBox& b, uint8_t faces) {
  for (int f = 0; f < 6; ++f) {
    const auto axis = static_cast<size_t>(f >> 1);
    if ((faces >> f & 1) && (f & 1 ? b.last[axis] == kChunkCells : b.first[axis] == 0)) return true;
  }
  return false;
}

}  // namespace

bool sampleChunk(const ChunkKernels& kernels, const ProgramView& field, const ChunkGrid& grid, ChunkScratch& scratch,
                 uint8_t faces) {
  ChunkSamples& samples = scratch.samples;
  std::fill(samples.signs.begin(), samples.signs.end(), 0);
  const SampleBox all{{0, 0, 0}, {kChunkCells, kChunkCells, kChunkCells}};
  prune(field, boxOf(grid, all, 0), scratch.pruning, scratch.whole);
  if (scratch.whole.solid()) fillSigns(samples, all);
  if (scratch.whole.solid() || scratch.whole.empty()) return false;

  // Each box is bounded together with one more layer of samples on every side. So if a box is uniform, the field does
  // not change sign on any edge that leads out of the box.
  for (int octant = 0; octant < 8; ++octant) {
    SampleBox half;
    for (size_t a = 0; a < 3; ++a) {
      const bool high = octant >> a & 1;
      half.first[a] = high ? kChunkCells / 2 : 0;
      half.last[a] = high ? kChunkCells : kChunkCells / 2 - 1;
    }
    if (faces != 0 && !touches(half, faces)) continue;
    prune(scratch.whole.view(), boxOf(grid, half, 1), scratch.pruning, scratch.octant);
    if (scratch.octant.solid()) fillSigns(samples, half);
    if (scratch.octant.solid() || scratch.octant.empty()) continue;
    for (int part = 0; part < 8; ++part) {
      SampleBox brick;
      int index = 0, stride = 1;
      for (size_t a = 0; a < 3; ++a) {
        const int at = 2 * (octant >> a & 1) + (part >> a & 1);
        brick.first[a] = at * kBrickSamples;
        brick.last[a] = at + 1 == kBricks ? kChunkCells : brick.first[a] + kBrickSamples - 1;
        index += at * stride;
        stride *= kBricks;
      }
      if (faces != 0 && !touches(brick, faces)) continue;
      PrunedProgram& program = scratch.bricks[static_cast<size_t>(index)];
      prune(scratch.octant.view(), boxOf(grid, brick, 1), scratch.pruning, program);
      if (program.solid()) fillSigns(samples, brick);
      if (program.solid() || program.empty()) continue;
      sampleBrick(kernels.field, program.view(), grid, brick, scratch);
    }
  }
  return true;
}

}  // namespace sgm
