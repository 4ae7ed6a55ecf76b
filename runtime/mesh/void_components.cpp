#include "mesh/void_components.h"

#include <algorithm>
#include <bit>

namespace sgm {

namespace {

constexpr size_t kRows = size_t{kChunkSamples} * kChunkSamples;
constexpr int kLast = kChunkSamples - 1;
constexpr uint64_t kRowBits = (uint64_t{1} << kChunkSamples) - 1;
constexpr uint64_t kEnds = uint64_t{1} << kLast | 1;

/// The runs of void samples of each row, labelled by what they touch among the rows before; labels that meet later are
/// united. A run at a time instead of a sample: a cave has one or two a row, and few labels.
class VoidRuns {
 public:
  VoidRuns(std::span<const uint64_t> signs, std::pmr::memory_resource* memory)
      : open_(kRows, memory),
        starts_(kRows, memory),
        first_(kRows, memory),
        labels_(memory),
        parents_(memory),
        touches_(memory) {
    for (size_t row = 0; row < kRows; ++row) {
      open_[row] = ~signs[row] & kRowBits;
      starts_[row] = open_[row] & ~(open_[row] << 1);
    }
    labels_.reserve(2 * kRows);
    for (size_t z = 0, row = 0; z < kChunkSamples; ++z) {
      for (size_t y = 0; y < kChunkSamples; ++y, ++row) label(row, y, z);
    }
  }

  size_t labels() const { return parents_.size(); }
  /// The lowest label of the same void.
  size_t rootOf(size_t label) {
    while (parents_[label] != label) {
      parents_[label] = parents_[parents_[label]];
      label = parents_[label];
    }
    return label;
  }

  /// Whether a run of that very label touches a face.
  uint8_t touchesFace(size_t label) const { return touches_[label]; }

  /// visit(label, first sample, last sample, y, z), in order.
  template <class Visit>
  void forEach(const Visit& visit) const {
    size_t run = 0;
    for (size_t z = 0, row = 0; z < kChunkSamples; ++z) {
      for (size_t y = 0; y < kChunkSamples; ++y, ++row) {
        for (uint64_t open = open_[row]; open != 0; ++run) {
          const int begin = std::countr_zero(open), end = begin + std::countr_one(open >> begin);
          visit(labels_[run], static_cast<size_t>(begin), static_cast<size_t>(end - 1), y, z);
          open &= ~uint64_t{0} << end;
        }
      }
    }
  }

 private:
  static constexpr uint16_t kNone = 0xFFFF;

  uint16_t labelAt(size_t row, int x) const {
    const uint64_t before = starts_[row] & ((uint64_t{2} << x) - 1);
    // Counting bits costs where the processor has no instruction for it, and most rows have one run.
    const size_t at = (before & (before - 1)) == 0 ? 0 : static_cast<size_t>(std::popcount(before)) - 1;
    return labels_[first_[row] + at];
  }

  void label(size_t row, size_t y, size_t z) {
    first_[row] = static_cast<uint16_t>(labels_.size());
    for (uint64_t open = open_[row]; open != 0;) {
      const uint64_t rest = open & (open + (open & -open)), run = open ^ rest;
      const uint64_t around = run | run << 1 | run >> 1;
      uint16_t label = kNone;
      if (y > 0) join(label, row - 1, around);
      if (z > 0) {
        const size_t below = row - kChunkSamples;
        join(label, below, around);
        // Where one of the other two corners is void the axes have joined, or will.
        if (y > 0) join(label, below - 1, run & ~open_[row - 1] & ~open_[below]);
        if (y < kLast) join(label, below + 1, run & ~open_[row + 1] & ~open_[below]);
      }
      if (label == kNone) {
        label = static_cast<uint16_t>(parents_.size());
        parents_.push_back(label);
        touches_.push_back(0);
      }
      labels_.push_back(label);
      touches_[label] |= y % kLast == 0 || z % kLast == 0 || (run & kEnds) != 0;
      open = rest;
    }
  }

  /// Joins with the runs of a row that have one of the samples.
  void join(uint16_t& label, size_t row, uint64_t samples) {
    for (uint64_t touched = samples & open_[row]; touched != 0; touched &= touched + (touched & -touched)) {
      const uint16_t other = labelAt(row, std::countr_zero(touched));
      if (label == kNone) label = other;
      if (label == other) continue;
      const size_t a = rootOf(label), b = rootOf(other);
      parents_[std::max(a, b)] = static_cast<uint16_t>(std::min(a, b));
    }
  }

  std::pmr::vector<uint64_t> open_, starts_;
  std::pmr::vector<uint16_t> first_, labels_;  ///< of each row its first run; of each run its label
  std::pmr::vector<uint16_t> parents_;         ///< union-find over labels; a set's root is its lowest
  std::pmr::vector<uint8_t> touches_;
};

/// The blocks that samples lie in, by sample.
struct BlockTables {
  std::array<uint8_t, kChunkSamples> low{}, high{};
  std::array<uint64_t, kChunkSamples> bits{};  ///< bit i: block i
  std::array<uint64_t, kChunkSamples> rows{};  ///< bit 8 i: times the bits of another axis these are a square's blocks

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

/// Adds samples first..last of a row.
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
      number[label] = static_cast<uint8_t>(std::min(touching, kMostVoidComponents - 2));
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
