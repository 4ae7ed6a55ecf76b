#pragma once
// How far shapes may extend: boxes of intervals, built up from the leaves through transforms and combiners. Everything
// here holds at least what derive/bounds.h computes for the derived shapes; the two change together.

#include <cstdint>

#include "base/math.h"
#include "grammar/range/reach_values.h"

namespace sgm {

/// Why a displacement has no bound though its amplitude has one.
enum class Unbound : uint8_t {
  none,
  sum,     ///< far from its leaves a sum's field is a constant, which the displacement takes away altogether
  radius,  ///< the smallest radius of an ellipsoid or superquadric may be as small as one likes
};

/// Where shapes lie: in a box, and in a core with a ball about it, however both are turned.
struct Hull {
  IntervalVector may{};
  IntervalVector core{};
  double core_radius = 0;  ///< the core is not farther than this from the scope's origin
  double ball = 0;

  static Hull everywhere();
  void merge(const Hull& other);
  void grow(double margin, double turned_margin);
  void add(const IntervalVector& by);  ///< every point may be elsewhere by this
  void rotate(int axis, Interval angle);
  void scale(Interval factor);
  void mirror(size_t axis);
};

/// Bounds of what a statement may derive, in the scope in which it stands, metres.
///
/// A level a of the field (where it is at most a) lies within `at` grown by spread * a, and, turned, by
/// turned_spread * a, for all a below `limit`.
struct Extent {
  bool empty = true;
  Hull at;      ///< nothing lies outside; where operands of a meet lie apart: what is between them
  Hull in_sum;  ///< ... of each shape's kernel in a sum
  double spread = 1, turned_spread = 1;
  double limit = kInfinity;
  std::array<double, 3> sure_lo{}, sure_hi{};  ///< whenever it is derived, something reaches at least this far

  double inner = 0;      ///< largest inner radius of its leaves, which a sum grows by
  double inner_low = 0;  ///< the largest is at least this, if there is any
  double count = 0;      ///< at most so many shapes
  bool certain = false;  ///< at least one shape for sure

  ExprId culprit = kNoId;  ///< the outermost call that extends farthest
  uint32_t edit = kNoId;   ///< the override that puts it there, or none
  double culprit_size = -1;
  ExprId inside = kNoId;  ///< what it blames where that stands in the standard library, and the culprit calls it
  uint32_t loss = 0;      ///< where its bound was lost, RangeEvaluator::losses(); 0: nowhere, or it is not known
  Unbound why = Unbound::none;
  double allowed = 0;  ///< Unbound::sum: a displacement must stay below this

  static Extent nothing();
  static Extent unbounded();
  /// A leaf: its box of intervals of the lower and the upper ends, which a ball of this radius is part of.
  static Extent leaf(const IntervalVector& lower, const IntervalVector& upper, double ball = 0);

  void join(const Extent& other);    ///< both
  void either(const Extent& other);  ///< one of the two
  void intersect(const Extent& other);
  void grow(double margin);    ///< the field is less by at most this
  void smooth(double radius);  ///< of a round union
  void add(const IntervalVector& by);
  void node();                     ///< all of it becomes one shape
  void uncertain();                ///< parts of it may be taken away
  void shrinkSure(double margin);  ///< ... by at most this
  void move(const IntervalVector& by);
  void rotate(int axis, Interval angle);  ///< axis 3: any
  void scale(Interval factor);
  void mirror(int axis);
  void repeat(Interval times);  ///< of the number of shapes
  void summed();                ///< the compact sum of its shapes
  void blame(ExprId call);
  bool lost() const;    ///< no bound is proven
  double size() const;  ///< largest distance of its box from the origin along an axis

 private:
  void merge(const Extent& other);
  void loseBound(Unbound reason);
};

/// A scale that is not positive is left out when derived.
Interval scaleFactor(Interval written);

}  // namespace sgm
