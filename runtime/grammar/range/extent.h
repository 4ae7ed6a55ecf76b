#pragma once
// Computes extents of shapes: boxes of intervals, propagated from the leaves through transforms and combiners. Must
// contain all boxes that derive/bounds.h computes for derived shapes, so change both together.

#include <array>
#include <cstdint>
#include <optional>

#include "base/math.h"
#include "grammar/range/range_value.h"

namespace sgm {

/// The reason why a displaced shape has no bound although the amplitude of the displacement has one.
enum class Unbound : uint8_t {
  none,
  sum,     ///< far from its leaves a sum's field is a constant, which the displacement may cancel completely
  radius,  ///< the smallest radius of an ellipsoid or superquadric may be arbitrarily small
};

/// Two bounds of the same shapes: the box `may`, and all points within the distance `ball` of the box `core`. rotate()
/// computes `may` from the second bound.
struct Hull {
  IntervalVector may{};
  IntervalVector core{};
  double core_radius = 0;  ///< largest distance of a point of the box `core` from the scope's origin, metres
  double ball = 0;         ///< distance from the box `core` within which the shapes lie, metres

  static Hull everywhere();
  void merge(const Hull& other);
  void grow(double margin, double turned_margin);
  void add(const IntervalVector& by);  ///< bounds the shapes after a move by any vector in `by`
  void rotate(int axis, Interval angle);
  void scale(Interval factor);
  void mirror(size_t axis);
};

/// Bounds of the shapes that a statement may derive, in the statement's scope, in metres.
///
/// Level sets: for all a < limit, the region where the field is at most `a` lies within `at` grown by spread * a (in
/// rotated scopes: by turned_spread * a).
struct Extent {
  bool empty = true;
  Hull at;      ///< bounds all shapes; for an intersection (meet) of disjoint operands: the gap between them
  Hull in_sum;  ///< bounds each shape's kernel, in case a `sum` adds the shapes up
  double spread = 1, turned_spread = 1;
  double limit = kInfinity;
  /// if anything is derived, some shape certainly extends at least this far in each direction
  std::array<double, 3> sure_lo{}, sure_hi{};

  /// the largest inner radius of the leaves; the distance by which a sum extends beyond its leaves is proportional to
  /// it
  double inner = 0;
  /// lower bound of the largest inner radius of the derived leaves; meaningless if the extent is empty
  double inner_low = 0;
  double count = 0;      ///< upper bound of the number of shapes
  bool certain = false;  ///< at least one shape is certainly derived

  ExprId largest_contributor = kNoId;  ///< the outermost call whose shapes extend farthest, for messages
  /// the largest distance in metres of largest_contributor's shapes from the origin; -1: there is no such call
  double contributor_size = -1;
  uint32_t override_id = kNoId;  ///< the override whose block contains largest_contributor; kNoId: none
  /// if largest_contributor calls the standard library: the call within the library that is responsible
  ExprId inside = kNoId;
  /// index in RangeEvaluator::losses() of the expression whose value has no bound; 0: the extent has a bound, or the
  /// reason is unknown
  uint32_t loss = 0;
  Unbound why = Unbound::none;
  double allowed = 0;  ///< for Unbound::sum: displacements with a smaller amplitude have a bound

  static Extent nothing();
  static Extent unbounded();
  /// Returns the extent of one leaf (a primitive), whose bounding box is known only approximately. lower, upper: for
  /// each axis, an interval in metres that contains the box's low end (lower) or high end (upper). ball: Hull::ball of
  /// the result; its Hull::core is the box Hull::may shrunk by `ball` on each side.
  static Extent leaf(const IntervalVector& lower, const IntervalVector& upper, double ball = 0);

  void join(const Extent& other);    ///< adds the extent of another statement, which is derived in addition
  void either(const Extent& other);  ///< adds an alternative: exactly one of the two extents is derived
  void intersect(const Extent& other);
  void grow(double margin);    ///< grows the bounds, so that they hold if the field changes by at most `margin`
  void smooth(double radius);  ///< grows the bounds, so that they hold after a smooth union with this blend radius
  void add(const IntervalVector& by);
  void node();                     ///< treats all shapes as one shape, such as the result of a blend
  void uncertain();                ///< marks that any part of the content may be cut away
  void shrinkSure(double margin);  ///< like uncertain(), but shapes lose at most `margin` on each side
  void move(const IntervalVector& by);
  void rotate(int axis, Interval angle);  ///< axis: 0, 1 or 2; 3: an arbitrary axis
  void scale(Interval factor);
  void mirror(int axis);
  void repeat(Interval times);  ///< multiplies the number of shapes by `times`
  void summed();                ///< replaces separate shapes by their sum (with compact kernels)
  /// Makes a call the largest contributor, unless a contributor without a bound is already known.
  void attribute(ExprId call);
  bool lost() const;    ///< whether no finite bound is proven
  double size() const;  ///< the largest distance of the box from the origin along any axis, metres

 private:
  void merge(const Extent& other);
  void loseBound(Unbound reason);
};

/// Adds an alternative to `all`, by Extent::either(): of all added alternatives, exactly one is derived. all: nullopt
/// before the first call.
void addAlternative(std::optional<Extent>& all, const Extent& one);

/// Returns the range of a written scale factor, limited to positive values: derivation omits content with other
/// factors.
Interval scaleFactor(Interval written);

}  // namespace sgm
