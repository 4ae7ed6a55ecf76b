#pragma once
// Labels the connected voids among a chunk's samples, run by run. Used by voidComponents() and by exact searches.
//
// Void samples are connected along the axes and across the diagonal of a face: see mesh/void_components.h.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

inline constexpr size_t kVoidRows = size_t{kChunkSamples} * kChunkSamples;  ///< number of rows; row (y, z) is y + 33 z

/// Finds the runs of void samples in each row. A run gets the label of the runs that it touches in previous rows;
/// labels that turn out to be connected later are united. Labelling runs is faster than labelling samples: a row in a
/// cave has one or two runs.
class VoidRuns {
 public:
  VoidRuns(std::span<const uint64_t> signs, std::pmr::memory_resource* memory)
      : open_(kVoidRows, memory),
        starts_(kVoidRows, memory),
        first_(kVoidRows, memory),
        labels_(memory),
        parents_(memory),
        touches_(memory) {
    for (size_t row = 0; row < kVoidRows; ++row) {
      open_[row] = ~signs[row] & kRowBits;
      starts_[row] = open_[row] & ~(open_[row] << 1);
    }
    labels_.reserve(2 * kVoidRows);
    for (size_t z = 0, row = 0; z < kChunkSamples; ++z) {
      for (size_t y = 0; y < kChunkSamples; ++y, ++row) label(row, y, z);
    }
  }

  size_t labels() const { return parents_.size(); }
  /// Returns the lowest label of the void that a label belongs to.
  size_t rootOf(size_t label) {
    while (parents_[label] != label) {
      parents_[label] = parents_[parents_[label]];
      label = parents_[label];
    }
    return label;
  }

  /// Returns 1 if a run with exactly this label touches a face of the chunk, else 0.
  uint8_t touchesFace(size_t label) const { return touches_[label]; }

  /// Calls visit(label, first sample, last sample, y, z) for each run, in order.
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
  static constexpr int kLast = kChunkSamples - 1;
  static constexpr uint64_t kRowBits = (uint64_t{1} << kChunkSamples) - 1;
  static constexpr uint64_t kEnds = uint64_t{1} << kLast | 1;

  uint16_t labelAt(size_t row, int x) const {
    const uint64_t before = starts_[row] & ((uint64_t{2} << x) - 1);
    // Avoids popcount in the usual case of one run: popcount is slow on processors without an instruction for it.
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
        // Joins the run with runs across the diagonal of a cell face. This is necessary only where both other corners
        // of the face are solid: otherwise the samples are connected along the axes anyway.
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

  /// Unites the label with the labels of those runs of `row` that contain a sample of the mask `samples`.
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
  std::pmr::vector<uint16_t> first_, labels_;  ///< index of each row's first run; label of each run
  std::pmr::vector<uint16_t> parents_;         ///< union-find parents of labels; the root of a set is its lowest label
  std::pmr::vector<uint8_t> touches_;
};

}  // namespace sgm
