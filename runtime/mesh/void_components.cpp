#include "mesh/void_components.h"

#include <algorithm>

#include "mesh/void_runs.h"

namespace sgm {

namespace {

constexpr size_t kLast = kChunkCells;

/// For each coordinate of a sample along an axis: the blocks that contain the sample. A sample on the border of two
/// blocks is in both.
struct BlockTables {
  std::array<uint8_t, kChunkSamples> low{}, high{};
  std::array<uint64_t, kChunkSamples> bits{};  ///< bit i is set if block i contains the sample
  /// bit 8 i is set if block i contains the sample. The product of `bits` for one axis and `rows` for another is a mask
  /// of the blocks (a, b) of a square that contain the sample: bit a + 8 b is set for each of these blocks.
  std::array<uint64_t, kChunkSamples> rows{};

  constexpr BlockTables() {
    for (size_t sample = 0; sample < kChunkSamples; ++sample) {
      low[sample] = static_cast<uint8_t>(sample == 0 ? 0 : (sample - 1) / kVoidBlock);
      high[sample] = static_cast<uint8_t>(sample == kLast ? kVoidBlocks - 1 : sample / kVoidBlock);
      bits[sample] = uint64_t{1} << low[sample] | uint64_t{1} << high[sample];
      rows[sample] = uint64_t{1} << 8 * low[sample] | uint64_t{1} << 8 * high[sample];
    }
  }
};
constexpr BlockTables kBlocks;

bool inBorder(size_t first, size_t last, size_t y, size_t z) {
  return first == 0 || last == kLast || y == 0 || y == kLast || z == 0 || z == kLast;
}

/// Adds to a void the blocks that contain samples first..last of the row (y, z).
void add(VoidComponent& component, size_t first, size_t last, size_t y, size_t z) {
  const uint64_t x = (uint64_t{2} << kBlocks.high[last]) - (uint64_t{1} << kBlocks.low[first]);
  const uint64_t xy = x * kBlocks.rows[y];
  component.blocks[kBlocks.low[z]] |= xy;
  component.blocks[kBlocks.high[z]] |= xy;
  if (!inBorder(first, last, y, z)) return;
  const uint64_t xz = x * kBlocks.rows[z], yz = kBlocks.bits[y] * kBlocks.rows[z];
  const auto touch = [&](Face face, uint64_t mask) { component.faces[static_cast<size_t>(face)] |= mask; };
  if (first == 0) touch(Face::x_lo, yz);
  if (last == kLast) touch(Face::x_hi, yz);
  if (y == 0) touch(Face::y_lo, xz);
  if (y == kLast) touch(Face::y_hi, xz);
  if (z == 0) touch(Face::z_lo, xy);
  if (z == kLast) touch(Face::z_hi, xy);
}

}  // namespace

VoidComponents voidComponents(std::span<const uint64_t> signs, std::pmr::memory_resource* memory) {
  VoidRuns runs(signs, memory);
  std::pmr::vector<uint8_t> touches(runs.labels(), uint8_t{0}, memory), number(runs.labels(), uint8_t{0}, memory);
  for (size_t label = 0; label < runs.labels(); ++label) touches[runs.rootOf(label)] |= runs.touchesFace(label);
  size_t touching = 0;
  bool sealed = false;
  for (size_t label = 0; label < runs.labels(); ++label) {
    const size_t root = runs.rootOf(label);
    if (root == label && touches[label] != 0) {
      number[label] = static_cast<uint8_t>(std::min(touching, kMaxVoidComponents - 2));
      touching = size_t{number[label]} + 1;
    }
    number[label] = number[root];
    touches[label] = touches[root];
    sealed |= touches[label] == 0;
  }
  VoidComponents components(touching + sealed, memory);
  runs.forEach([&](size_t label, size_t first, size_t last, size_t y, size_t z) {
    add(components[touches[label] != 0 ? number[label] : touching], first, last, y, z);
  });
  return components;
}

VoidComponents voidOfUniform(bool solid, std::pmr::memory_resource* memory) {
  VoidComponents components(memory);
  if (!solid) {
    VoidComponent& all = components.emplace_back();
    all.faces.fill(~uint64_t{0});
    all.blocks.fill(~uint64_t{0});
  }
  return components;
}

uint64_t voidsAround(std::span<const VoidComponent> components, Int3 cell) {
  const int bit = cell.x / kVoidBlock + kVoidBlocks * (cell.y / kVoidBlock);
  uint64_t found = 0;
  for (size_t i = 0; i < components.size(); ++i) {
    found |= (components[i].blocks[static_cast<size_t>(cell.z / kVoidBlock)] >> bit & 1) << i;
  }
  return found;
}

}  // namespace sgm
