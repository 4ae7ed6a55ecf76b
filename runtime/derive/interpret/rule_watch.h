#pragma once
// Observes the calls of one rule.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "derive/interpret/env.h"

namespace sgm::interpret {

/// The output of one call of the watched rule.
struct WatchedCall {
  uint32_t activation = 0;
  ShapeList shapes, layer_cuts;
  size_t first_anchor = 0, end_anchor = 0;
};

/// The outputs of all calls of one rule in a cell, in order of their beginnings.
class RuleWatch {
 public:
  explicit RuleWatch(uint32_t rule) : rule_(rule) {}

  bool watches(uint32_t rule) const { return rule == rule_; }

  /// anchors: how many the cell has before the call. Returns the number of the call.
  size_t begin(uint32_t activation, size_t anchors) {
    calls_.push_back({activation, {}, {}, anchors, anchors});
    return calls_.size() - 1;
  }
  /// The call has added these shapes and cuts of the domain; anchors: how many the cell has after it.
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
