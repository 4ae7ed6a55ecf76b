#pragma once
// How far shapes may extend: boxes of intervals, built up from the leaves through transforms and combiners.

#include <cstdint>
#include <limits>

#include "grammar/builtins.h"
#include "grammar/reach_values.h"

namespace sgm {

/// Bounds of what a statement may derive, in the scope in which it stands, metres.
struct Extent {
  bool empty = true;
  IntervalVector may{};                        ///< nothing lies outside; lo > hi nowhere unless empty
  double radius = 0;                           ///< nor farther than this from the scope's origin
  std::array<double, 3> sure_lo{}, sure_hi{};  ///< whenever it is derived, something reaches at least this far
  double inner = 0;                            ///< largest inner radius of its leaves, which a sum grows by
  ExprId culprit = kNoId;                      ///< the outermost call that extends farthest
  double culprit_size = -1;

  static Extent nothing();
  static Extent unbounded();
  /// A leaf: its box of intervals of the lower and the upper ends.
  static Extent leaf(const IntervalVector& lower, const IntervalVector& upper);

  void join(const Extent& other);
  void intersect(const Extent& other);
  void grow(double margin);        ///< may extend farther on every side
  void uncertain();                ///< parts of it may be taken away
  void shrinkSure(double margin);  ///< ... by at most this
  void move(const IntervalVector& by);
  void rotate(int axis, Interval angle);  ///< axis 3: any
  void scale(Interval factor);
  void mirror(int axis);
  void blame(ExprId call);
  double size() const;  ///< largest distance of its box from the origin along an axis
};

/// The extent of a terminal with its arguments.
Extent primitiveExtent(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame);

}  // namespace sgm
