#pragma once
// Boxes that certainly hold a shape, from the semantics in shape.h.

#include <vector>

#include "derive/expr_range.h"
#include "derive/shape.h"

namespace sgm {

/// Answers for one chunk, which must outlive it and stay as it is. Const calls are thread-safe.
class ShapeBounds {
 public:
  explicit ShapeBounds(const GrammarChunk& chunk);

  /// Holds every integer point where the shape's field is <= a units, at every level (whatever `detail` leaves out),
  /// float rounding included: one unit and 1e-6 of the size. An axis without a bound reaches the ends of int32.
  IntBox level(uint32_t shape, double a) const;

  /// The range of an expression over all space.
  Range range(uint32_t expr) const { return ranges_[expr]; }

 private:
  const GrammarChunk& chunk_;
  std::vector<Range> ranges_;
};

/// ShapeBounds(chunk).level(shape, a), for a single question.
IntBox levelBounds(const GrammarChunk& chunk, uint32_t shape, double a);

/// Whether the box ends on every axis before the ends of int32.
bool isBounded(const IntBox& box);

}  // namespace sgm
