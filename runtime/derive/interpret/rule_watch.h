#pragma once
// Records the shapes, cuts and anchors that the calls of one rule derive.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "derive/interpret/env.h"

namespace sgm::interpret {

/// The output of one call of the watched rule: shapes, cuts of the domain, and anchors first_anchor to end_anchor - 1
/// of the cell.
struct WatchedCall {
  uint32_t activation = 0;
  ShapeList shapes, layer_cuts;
  size_t first_anchor = 0, end_anchor = 0;
};

/// The outputs of all calls of one rule in a cell, in the order in which the calls begin.
class RuleWatch {
 public:
  explicit RuleWatch(uint32_t rule) : rule_(rule) {}

  bool watches(uint32_t rule) const { return rule == rule_; }

  /// Records the start of a call. anchors: number of the cell's anchors so far. Returns the call's index.
  size_t begin(uint32_t activation, size_t anchors) {
    calls_.push_back({activation, {}, {}, anchors, anchors});
    return calls_.size() - 1;
  }
  /// Records the end of a call. number: the call's index; shapes, layer_cuts: output of the call; anchors: current
  /// number of the cell's anchors.
  void end(size_t number, std::span<const uint32_t> shapes, std::span<const uint32_t> layer_cuts, size_t anchors) {
    WatchedCall& call = calls_[number];
    call.shapes.assign(shapes.begin(), shapes.end());
    call.layer_cuts.assign(layer_cuts.begin(), layer_cuts.end());
    call.end_anchor = anchors;
  }

  const std::vector<WatchedCall>& calls() const { return calls_; }

 private:
  const uint32_t rule_;
  std::vector<WatchedCall> calls_;
};

}  // namespace sgm::interpret
