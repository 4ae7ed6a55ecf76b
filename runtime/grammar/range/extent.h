#pragma once
// The extents of shapes: boxes of intervals, propagated from the leaves through transforms and combiners. They contain
// at least what derive/bounds.h computes for derived shapes; change both together.

#include <array>
#include <cstdint>
#include <optional>

#include "base/math.h"
#include "grammar/range/range_value.h"

namespace sgm {

/// Why a displacement has no bound although its amplitude is bounded.
enum class Unbound : uint8_t {
  none,
  sum,     ///< far from its leaves a sum's field is a constant, which the displacement may cancel completely
  radius,  ///< the smallest radius of an ellipsoid or superquadric may be arbitrarily small
};

/// Contains shapes in any orientation: a box, and a core with a ball around it.
struct Hull {
  IntervalVector may{};
  IntervalVector core{};
  double core_radius = 0;  ///< the largest distance of the core from the scope's origin
  double ball = 0;

  static Hull everywhere();
  void merge(const Hull& other);
  void grow(double margin, double turned_margin);
  void add(const IntervalVector& by);  ///< every point may move by this
  void rotate(int axis, Interval angle);
  void scale(Interval factor);
  void mirror(size_t axis);
};

/// Bounds of the shapes that a statement may derive, in the statement's scope, metres.
///
/// The region where the field is at most a lies within `at` grown by spread * a (when turned: by turned_spread * a),
/// for all a below `limit`.
struct Extent {
  bool empty = true;
  Hull at;      ///< nothing lies outside; if operands of a meet lie apart: the space between them
  Hull in_sum;  ///< the same for each shape's kernel in a sum
  double spread = 1, turned_spread = 1;
  double limit = kInfinity;
  std::array<double, 3> sure_lo{}, sure_hi{};  ///< whenever it is derived, some shape reaches at least this far

  double inner = 0;      ///< the largest inner radius of its leaves; a sum reaches beyond them in proportion to it
  double inner_low = 0;  ///< lower bound of the largest inner radius, if there is any
  double count = 0;      ///< the most shapes
  bool certain = false;  ///< whether at least one shape is certain

  ExprId largest_contributor = kNoId;  ///< the outermost call that extends farthest
  double contributor_size = -1;        ///< metres; its distance from the origin, or -1
  uint32_t override_id = kNoId;        ///< the override that adds that call, or none
  ExprId inside = kNoId;  ///< the responsible call if it is in the standard library, called by largest_contributor
  uint32_t loss = 0;      ///< index in RangeEvaluator::losses() where its bound was lost; 0: nowhere, or unknown
  Unbound why = Unbound::none;
  double allowed = 0;  ///< for Unbound::sum: a displacement must stay below this

  static Extent nothing();
  static Extent unbounded();
  /// The extent of a leaf: intervals for the lower and the upper ends of its box, and a ball that may contain it.
  static Extent leaf(const IntervalVector& lower, const IntervalVector& upper, double ball = 0);

  void join(const Extent& other);    ///< both are derived
  void either(const Extent& other);  ///< one of the two is derived
  void intersect(const Extent& other);
  void grow(double margin);    ///< the field decreases by at most this
  void smooth(double radius);  ///< for a round union
  void add(const IntervalVector& by);
  void node();                     ///< all of it becomes one shape
  void uncertain();                ///< parts of it may be cut away
  void shrinkSure(double margin);  ///< the same, but by at most this
  void move(const IntervalVector& by);
  void rotate(int axis, Interval angle);  ///< axis 3: any axis
  void scale(Interval factor);
  void mirror(int axis);
  void repeat(Interval times);  ///< multiplies the number of shapes
  void summed();                ///< the compact sum of its shapes
  /// Makes a call the largest contributor, unless an unbounded contributor is known.
  void attribute(ExprId call);
  bool lost() const;    ///< whether no bound is proven
  double size() const;  ///< the largest distance of its box from the origin along an axis

 private:
  void merge(const Extent& other);
  void loseBound(Unbound reason);
};

/// Adds another alternative of which one is derived: joins it with the others by Extent::either. nullopt: none yet.
void addAlternative(std::optional<Extent>& all, const Extent& one);

/// The range of a scale; derivation omits scales that are not positive.
Interval scaleFactor(Interval written);

}  // namespace sgm
