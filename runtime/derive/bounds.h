#pragma once
// Computes conservative bounding boxes of shapes, by the formulas in shape.h.

#include <vector>

#include "derive/expr_range.h"
#include "derive/shape.h"

namespace sgm {

/// Computes bounds of the shapes of one chunk, which must outlive this object unchanged. Const functions are
/// thread-safe.
class ShapeBounds {
 public:
  explicit ShapeBounds(const GrammarChunk& chunk);

  /// Returns a box that contains every integer point where the shape's field is at most `a` units, at every level of
  /// detail (including levels where `detail` drops parts). Includes a margin for float rounding: one unit and 1e-6 of
  /// the size. Axes without a bound extend to the ends of int32.
  IntBox level(uint32_t shape, double a) const;

  /// Returns the range of an expression's values over all positions.
  Range range(uint32_t expr) const { return ranges_[expr]; }

 private:
  const GrammarChunk& chunk_;
  std::vector<Range> ranges_;
};

/// Same as ShapeBounds(chunk).level(shape, a), for a single query.
IntBox levelBounds(const GrammarChunk& chunk, uint32_t shape, double a);

/// Whether the box has a bound on every axis, that is, does not extend to the ends of int32.
bool isBounded(const IntBox& box);

}  // namespace sgm
