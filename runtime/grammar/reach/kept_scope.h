#pragma once

#include "grammar/range/range_value.h"

namespace sgm::reach {

/// Saves a frame's scope and place when it is constructed, and restores them when it is destroyed.
class KeptScope {
 public:
  /// The frame must outlive this object.
  explicit KeptScope(RangeFrame& frame) : frame_(frame), scope_(frame.scope), place_(frame.place) {}
  ~KeptScope() {
    frame_.scope = scope_;
    frame_.place = place_;
  }
  KeptScope(const KeptScope&) = delete;
  KeptScope& operator=(const KeptScope&) = delete;

 private:
  RangeFrame& frame_;
  const IntervalVector scope_;
  const PlaceRange place_;
};

}  // namespace sgm::reach
