#pragma once
// Types for interval evaluation: ranges of values, of scopes' places, and the frames in which expressions are
// evaluated.

#include <cstdint>
#include <vector>

#include "grammar/range/interval.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// The possible values of an expression. The content of v depends on kind. number, boolean: the value in v[0]; vector,
/// pair: the components; cell: the offset from the derived cell, in cells; face: the offset of its lower cell;
/// segment(s): all coordinates of the ends in v[0], the depth in v[1]; plan: the edges of the boxes of its pieces,
/// whose centres are in `at`.
struct RangeValue {
  ValueKind kind = ValueKind::unknown;
  IntervalVector v{Interval::everything(), Interval::everything(), Interval::everything()};
  IntervalVector at{};
  /// index in BoundLosses of the reason for a missing bound; 0: it has a bound, or the reason is unknown
  uint32_t loss = 0;

  bool bounded() const;  ///< whether v is finite; true for kinds other than number, vector and pair

  static RangeValue number(Interval i) { return {ValueKind::number, {i, {}, {}}, {}}; }
  static RangeValue condition(Interval i) { return {ValueKind::boolean, {i, {}, {}}, {}}; }
  static RangeValue vector(const IntervalVector& v) { return {ValueKind::vector, v, {}}; }
  static RangeValue unknown() { return {}; }
};

/// The possible positions and orientations of a scope. offset: metres from the low corner of the derived cell.
struct PlaceRange {
  IntervalVector offset{};
  Interval scale{1, 1};
  bool turned = false;  ///< the scope may be rotated arbitrarily

  void move(const IntervalVector& by);
  friend bool operator==(const PlaceRange&, const PlaceRange&) = default;
};

/// The context in which a statement's or function's expressions are evaluated.
struct RangeFrame {
  std::vector<RangeValue> slots;
  IntervalVector scope{};  ///< ranges of the edge lengths of the scope's box
  PlaceRange place;        ///< place of the current statement's scope
  PlaceRange start;        ///< place of the scope with which the enclosing rule starts
  bool top = false;        ///< the statement is directly in a layer's start rule, where a cut removes from the domain
};

/// The possible truth values of a condition: 1 is true, 0 is false.
inline constexpr Interval kTrue{1, 1}, kFalse{0, 0}, kEither{0, 1};

/// Whether a value can be evaluated in pieces: a number with a finite range of more than one value.
bool hasPieces(const RangeValue& value);
/// Returns the point that divides a range into two pieces: the geometric mean if the whole range is positive (such as
/// sizes), otherwise the middle.
double dividingPoint(Interval range);

/// Returns a box that contains every vector in `v` after any rotation.
IntervalVector anyDirection(const IntervalVector& v);

}  // namespace sgm
