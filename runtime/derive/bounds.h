#pragma once
// Conservative bounding boxes of shapes, from the semantics in shape.h.

#include <vector>

#include "derive/expr_range.h"
#include "derive/shape.h"

namespace sgm {

/// For one chunk, which must outlive it unchanged. Const calls are thread-safe.
class ShapeBounds {
 public:
  explicit ShapeBounds(const GrammarChunk& chunk);

  /// Contains every integer point where the shape's field is <= a units, at every level (whatever `detail` leaves out),
  /// including float rounding: one unit and 1e-6 of the size. An unbounded axis extends to the ends of int32.
  IntBox level(uint32_t shape, double a) const;

  /// The range of an expression over all space.
  Range range(uint32_t expr) const { return ranges_[expr]; }

 private:
  const GrammarChunk& chunk_;
  std::vector<Range> ranges_;
};

/// ShapeBounds(chunk).level(shape, a), for a single query.
IntBox levelBounds(const GrammarChunk& chunk, uint32_t shape, double a);

/// True if the box ends on every axis before the ends of int32.
bool isBounded(const IntBox& box);

}  // namespace sgm
