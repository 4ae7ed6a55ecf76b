#pragma once
// Writes the parameter words of an op.

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/fixed.h"

namespace sgm {

/// Appends the parameter words of one op to a program's words.
class ParameterWriter {
 public:
  explicit ParameterWriter(std::pmr::vector<uint32_t>& words)
      : words_(words), first_(static_cast<uint32_t>(words.size())) {}

  /// Returns the index of the op's first word.
  uint32_t first() const { return first_; }

  /// Replaces denormals by 0, because devices treat them differently (shaders/common/real.h, settleReal).
  void put(float f) { words_.push_back(std::bit_cast<uint32_t>(std::abs(f) < 1e-30f ? 0.0f : f)); }
  void put(int32_t i) { words_.push_back(static_cast<uint32_t>(i)); }
  void put(Int3 p) {
    put(p.x);
    put(p.y);
    put(p.z);
  }

 private:
  std::pmr::vector<uint32_t>& words_;
  uint32_t first_;
};

}  // namespace sgm
