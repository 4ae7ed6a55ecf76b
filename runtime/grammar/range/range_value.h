#pragma once
// The possible values of expressions, the possible places of scopes, and the frames in which expressions are evaluated.

#include <cstdint>
#include <vector>

#include "grammar/range/interval.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// By kind: a number or condition uses v[0]; a vector or pair uses v. A cell is its offset from the derived cell, in
/// cells, and a face that of its lower cell. A segment (or a list of them) has the coordinates of its ends in v[0] and
/// its depth in v[1]. A plan has the edges of its pieces' boxes in v, and the places of their middles in `at`.
struct RangeValue {
  ValueKind kind = ValueKind::unknown;
  IntervalVector v{Interval::everything(), Interval::everything(), Interval::everything()};
  IntervalVector at{};
  uint32_t loss = 0;  ///< why it has no bound: an index of BoundLosses; 0: it has one, or the reason is unknown

  bool bounded() const;  ///< or not a number, vector or pair

  static RangeValue number(Interval i) { return {ValueKind::number, {i, {}, {}}, {}}; }
  static RangeValue condition(Interval i) { return {ValueKind::boolean, {i, {}, {}}, {}}; }
  static RangeValue vector(const IntervalVector& v) { return {ValueKind::vector, v, {}}; }
  static RangeValue unknown() { return {}; }
};

/// The possible places of a scope: metres from the cell's low corner.
struct PlaceRange {
  IntervalVector offset{};
  Interval scale{1, 1};
  bool turned = false;  ///< in any direction

  void move(const IntervalVector& by);
  friend bool operator==(const PlaceRange&, const PlaceRange&) = default;
};

/// The context of a frame's expressions.
struct RangeFrame {
  std::vector<RangeValue> slots;
  IntervalVector scope{};  ///< edges of the scope's box
  PlaceRange place;        ///< of the statement
  PlaceRange start;        ///< of the rule
  bool top = false;        ///< the layer's own use of its start rule, where a cut applies to the domain
};

/// The ranges of conditions.
inline constexpr Interval kTrue{1, 1}, kFalse{0, 0}, kEither{0, 1};

/// Whether the value can be divided for a proof in pieces: a number with a finite range.
bool hasPieces(const RangeValue& value);
/// The point that divides such a range into two pieces: by ratio if all of it is positive, as for sizes.
double dividingPoint(Interval range);

/// Any vector with the length of one of these.
IntervalVector anyDirection(const IntervalVector& v);

}  // namespace sgm
