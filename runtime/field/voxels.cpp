#include "field/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grammar/syntax/builtins.h"

namespace sgm {

namespace {

using Counts = std::pmr::vector<uint16_t>;

/// The sampling of a block along an axis at a level. step: number of voxels from one sample to the next; tent: half
/// width of the tent filter, in voxels.
struct Sampling {
  int32_t step = 1, tent = 2;
};

Sampling samplingAt(int32_t edge, int32_t cell) {
  if (cell / 2 < edge) return {1, 2};
  if (cell / 4 < edge) return {2, 2};
  return {4, 4};
}

/// Returns the voxels from index `first` on (an index in the world); beyond the end of the block, repeats the nearest
/// voxels.
Counts unpacked(const GrammarChunk& chunk, const VoxelBlock& block, Int3 first, const std::array<size_t, 3>& count,
                std::pmr::memory_resource* memory) {
  const auto held = [&](int axis, int64_t i) {
    return static_cast<size_t>(
        std::clamp<int64_t>(int64_t{first[axis]} + i - block.first[axis], 0, std::max(block.count[axis] - 1, 0)));
  };
  const auto row = static_cast<size_t>(std::max(block.count.x, 1)),
             column = static_cast<size_t>(std::max(block.count.y, 1));
  Counts out(memory);
  out.reserve(count[0] * count[1] * count[2]);
  for (size_t z = 0; z < count[2]; ++z) {
    for (size_t y = 0; y < count[1]; ++y) {
      const size_t at = (held(2, static_cast<int64_t>(z)) * column + held(1, static_cast<int64_t>(y))) * row;
      for (size_t x = 0; x < count[0]; ++x) {
        const size_t bit = at + held(0, static_cast<int64_t>(x));
        out.push_back(chunk.voxels[block.first_word + bit / 64] >> (bit % 64) & 1);
      }
    }
  }
  return out;
}

/// Applies the tent filter along an axis, with one weighted sum per sample. Sets count[axis] to the number of samples.
Counts tented(const Counts& in, std::array<size_t, 3>& count, size_t axis, size_t samples, Sampling sampling) {
  size_t inner = 1, outer = 1;
  for (size_t a = 0; a < axis; ++a) inner *= count[a];
  for (size_t a = axis + 1; a < 3; ++a) outer *= count[a];
  const size_t before = count[axis];
  count[axis] = samples;
  Counts out(samples * inner * outer, 0, in.get_allocator());
  for (size_t o = 0; o < outer; ++o) {
    for (size_t s = 0; s < samples; ++s) {
      uint16_t* to = out.data() + (o * samples + s) * inner;
      for (int32_t k = 1 - sampling.tent; k < sampling.tent; ++k) {
        const size_t voxel = s * static_cast<size_t>(sampling.step) + static_cast<size_t>(k + sampling.tent - 1);
        const uint16_t* from = in.data() + (o * before + voxel) * inner;
        const int weight = sampling.tent - std::abs(k);
        for (size_t i = 0; i < inner; ++i) to[i] = static_cast<uint16_t>(to[i] + weight * from[i]);
      }
    }
  }
  return out;
}

/// Returns the value of a sample, in units. solid, all: weighted number of solid voxels, and of all voxels, around the
/// sample.
int64_t valueOf(int64_t solid, int64_t all, int64_t edge, Sampling sampling) {
  const int64_t most = edge - edge / 8;
  return std::clamp(floorDiv((all - 2 * solid) * edge * (sampling.tent / 2), all), -most, most);
}

int64_t onItsSide(int64_t value, bool solid, int64_t edge) {
  return solid ? std::min(value, -(edge / 4)) : std::max(value, edge / 4);
}

Int3 movedBy(Int3 p, Int3 by, int sign) {
  return {saturate(int64_t{p.x} + int64_t{sign} * by.x), saturate(int64_t{p.y} + int64_t{sign} * by.y),
          saturate(int64_t{p.z} + int64_t{sign} * by.z)};
}

}  // namespace

bool voxelsShow(const VoxelBlock& block, int32_t cell) { return cell <= AutomatonLimits::coarsestCell(block.edge); }

std::optional<SampleLattice> sampleVoxels(const GrammarChunk& chunk, const Shape& shape, const IntBox& read,
                                          int32_t cell, std::pmr::vector<float>& samples) {
  const VoxelBlock& block = chunk.blocks[shape.block];
  const Sampling sampling = samplingAt(block.edge, cell);
  // The field is the maximum of the voxel samples and the block's box. At points more than one voxel edge outside the
  // box, this maximum is the value of the box, so no samples are needed there.
  IntBox decides;
  for (int axis = 0; axis < 3; ++axis) {
    const auto half = static_cast<int64_t>(shape.size[static_cast<size_t>(axis)]) + block.edge;
    decides.lo[axis] = saturate(shape.frame.origin[axis] - half);
    decides.hi[axis] = saturate(shape.frame.origin[axis] + half);
  }
  const IntBox box = decides.clipped(read);
  if (box.empty()) return std::nullopt;
  SampleLattice at =
      latticeAround({movedBy(box.lo, block.anchor, -1), movedBy(box.hi, block.anchor, -1)}, block.edge * sampling.step);

  Int3 first;
  std::array<size_t, 3> count{1, 1, 1};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    if (block.count[axis] == 0) {
      at.origin[axis] = 0;
      at.count[a] = 4;
      continue;
    }
    first[axis] = at.origin[axis] / block.edge - (sampling.tent - 1);
    count[a] = (at.count[a] - 1) * static_cast<size_t>(sampling.step) + static_cast<size_t>(2 * sampling.tent - 1);
  }
  at.origin = movedBy(at.origin, block.anchor, 1);

  const Counts solid = unpacked(chunk, block, first, count, samples.get_allocator().resource());
  const std::array<size_t, 3> voxels = count;
  Counts sums(solid, solid.get_allocator());
  int64_t all = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (block.count[axis] == 0) continue;
    all *= int64_t{sampling.tent} * sampling.tent;
    sums = tented(sums, count, static_cast<size_t>(axis), at.count[static_cast<size_t>(axis)], sampling);
  }

  const bool sided = sampling.tent == 2;
  samples.clear();
  samples.reserve(size_t{at.count[0]} * at.count[1] * at.count[2]);
  /// held() returns the index of a sample along an axis (all samples are equal along an axis with count 1); voxel()
  /// returns the index of the sample's voxel.
  const auto held = [&](size_t axis, size_t i) { return count[axis] == 1 ? size_t{0} : i; };
  const auto voxel = [&](size_t axis, size_t i) {
    return voxels[axis] == 1 ? size_t{0}
                             : i * static_cast<size_t>(sampling.step) + static_cast<size_t>(sampling.tent - 1);
  };
  for (size_t z = 0; z < at.count[2]; ++z) {
    for (size_t y = 0; y < at.count[1]; ++y) {
      for (size_t x = 0; x < at.count[0]; ++x) {
        const size_t i = (held(2, z) * count[1] + held(1, y)) * count[0] + held(0, x);
        int64_t value = valueOf(sums[i], all, block.edge, sampling);
        if (sided) {
          const size_t v = (voxel(2, z) * voxels[1] + voxel(1, y)) * voxels[0] + voxel(0, x);
          value = onItsSide(value, solid[v] != 0, block.edge);
        }
        samples.push_back(static_cast<float>(value));
      }
    }
  }
  return at;
}

}  // namespace sgm
