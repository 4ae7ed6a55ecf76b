#include "grammar/range/reach_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math.h"

namespace sgm {

namespace {

constexpr Interval kHalf{0.5, 0.5};
/// Size in metres up to which a shape counts as certainly derived. Once scaled, a larger shape may exceed the largest
/// size that derivation accepts, and is then omitted.
constexpr double kLargestSize = 1e5;

/// Computes the extent of one call of a primitive.
class Terminal {
 public:
  Terminal(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame)
      : program_(program), call_(call), values_(values), frame_(frame) {}

  Extent extent();

 private:
  ExprId arg(uint32_t i) const { return i < call_.bound.count ? program_.idAt(call_.bound, i) : kNoId; }
  Interval in(uint32_t i) { return arg(i) == kNoId ? Interval{} : values_.number(arg(i), frame_); }

  /// Sets the inner radius of a leaf. The leaf is certainly derived if all its sizes are positive and not too large.
  static void sized(Extent& e, std::initializer_list<Interval> sizes, Interval inner) {
    e.inner = positivePart(inner).hi;
    e.inner_low = positivePart(inner).lo;
    e.certain = std::all_of(sizes.begin(), sizes.end(), [](Interval v) { return v.lo > 0 && v.hi <= kLargestSize; });
    e.node();
  }

  // Returns the extent of a centred box with these half extents. Negative sizes count as 0, since derivation rejects
  // them.
  static Extent centred(Interval x, Interval y, Interval z) {
    const IntervalVector upper{positivePart(x), positivePart(y), positivePart(z)};
    Extent e = Extent::leaf({-upper[0], -upper[1], -upper[2]}, upper);
    sized(e, {x, y, z}, minimum(x, minimum(y, z)));
    return e;
  }

  /// For an expression that is a multiple of a local number, such as r, 0.6*r, r*n or r/2: returns its slot and the
  /// range of the factor. nullopt for other forms.
  std::optional<std::pair<uint32_t, Interval>> partOf(ExprId id) {
    const ExprNode& n = program_.expr(id);
    if (n.ref == Ref::local) return std::pair{n.id, Interval{1, 1}};
    if (n.kind != ExprKind::binary || (n.binary != BinaryOp::multiply && n.binary != BinaryOp::divide))
      return std::nullopt;
    const ExprId left = program_.idAt(n.children, 0), right = program_.idAt(n.children, 1);
    if (n.binary == BinaryOp::multiply && program_.expr(right).ref == Ref::local)
      return std::pair{program_.expr(right).id, values_.number(left, frame_)};
    if (program_.expr(left).ref != Ref::local) return std::nullopt;
    const Interval by = values_.number(right, frame_);
    return std::pair{program_.expr(left).id, n.binary == BinaryOp::multiply ? by : Interval{1, 1} / by};
  }

  /// Returns an upper bound of the ratio of the largest to the smallest radius.
  double ratio(bool scalar, double most, double least) {
    const double apart = least > 0 ? most / least : kInfinity;
    const ExprNode& n = program_.expr(arg(0));
    const bool vector = n.kind == ExprKind::vector && n.children.count == 3;
    if (scalar && arg(1) == kNoId) return 1;
    if (!scalar && !vector) return apart;
    // If all radii are multiples of the same local number, the ratio depends only on the factors.
    double high = 0, low = kInfinity;
    uint32_t slot = kNoId;
    for (uint32_t i = 0; i < 3; ++i) {
      const ExprId radius = vector ? program_.idAt(n.children, i) : arg(i);
      const auto part = radius == kNoId ? std::nullopt : partOf(radius);
      if (!part || (slot != kNoId && part->first != slot) || !(part->second.lo > 0)) return apart;
      slot = part->first;
      high = std::max(high, part->second.hi);
      low = std::min(low, part->second.lo);
    }
    return std::min(apart, high / low * (1 + 1e-9));
  }

  /// Returns the extent of an ellipsoid or superquadric. Its field has the slope of the smallest radius. Along the
  /// largest radius, level sets therefore move by the ratio of the largest to the smallest radius.
  Extent radial(const IntervalVector& v, bool scalar, bool round) {
    Extent e = centred(v[0], v[1], v[2]);
    if (round) e.at.core_radius = e.size();  // an ellipsoid does not fill the corners of its box
    e.spread = ratio(scalar, e.size(), e.inner_low);
    e.turned_spread = e.spread * (round ? 1 : 1.7320508075688774);
    // In a sum, the kernel enlarges all radii by the same factor, 1.6.
    e.in_sum = e.at;
    e.in_sum.scale({1, 1.6});
    return e;
  }

  Extent boxLike() {
    const Primitive kind = static_cast<Primitive>(call_.id);
    const RangeValue first = values_.evaluate(arg(0), frame_);
    IntervalVector v = first.v;
    if (first.kind != ValueKind::vector) {
      const Interval x = in(0);
      v = {x, arg(1) == kNoId ? x : in(1), arg(2) == kNoId ? x : in(2)};
      // The second argument of a superquadric is its squareness, not a radius, so the first one is the radius along all
      // axes.
      if (kind == Primitive::superq) v = {x, x, x};
    }
    if (kind == Primitive::box) return centred(v[0] * kHalf, v[1] * kHalf, v[2] * kHalf);
    return radial(v, first.kind != ValueKind::vector, kind == Primitive::ellipsoid);
  }

  /// Returns the extent of a shape around the line between two points. radius: radius of the shape. ball: distance from
  /// the line within which the whole shape lies.
  Extent around(Interval radius, double ball, bool certain) {
    const IntervalVector a = values_.vector(arg(0), frame_), b = values_.vector(arg(1), frame_);
    IntervalVector lower, upper;
    for (size_t i = 0; i < 3; ++i) {
      const Interval reach = Interval::exactly(ball);
      lower[i] = minimum(a[i], b[i]) - reach;
      upper[i] = maximum(a[i], b[i]) + reach;
    }
    Extent e = Extent::leaf(lower, upper, ball);
    for (size_t i = 0; i < 3; ++i) {
      e.sure_lo[i] = minimum(a[i], b[i]).hi - radius.lo;
      e.sure_hi[i] = maximum(a[i], b[i]).lo + radius.lo;
    }
    sized(e, {radius}, radius);
    e.certain = e.certain && certain;
    return e;
  }

  Extent prism() {
    const Interval h = positivePart(in(0) * kHalf);
    IntervalVector lower{Interval{kInfinity, kInfinity}, -h, Interval{kInfinity, kInfinity}};
    IntervalVector upper{Interval{-kInfinity, -kInfinity}, h, Interval{-kInfinity, -kInfinity}};
    for (uint32_t i = 1; i < call_.bound.count; ++i) {
      const IntervalVector corner = values_.vector(arg(i), frame_);
      for (size_t axis : {size_t{0}, size_t{2}}) {
        lower[axis] = minimum(lower[axis], corner[axis == 0 ? 0 : 1]);
        upper[axis] = maximum(upper[axis], corner[axis == 0 ? 0 : 1]);
      }
    }
    Extent e = Extent::leaf(lower, upper);
    e.inner = std::min(h.hi, e.at.core_radius);
    e.node();
    return e;  // not certain: derivation leaves out a prism whose corners coincide
  }

  const Program& program_;
  const ExprNode& call_;
  RangeEvaluator& values_;
  const RangeFrame& frame_;
};

Extent Terminal::extent() {
  switch (static_cast<Primitive>(call_.id)) {
    case Primitive::sphere:
    case Primitive::blob: {
      const Interval r = positivePart(in(0));
      Extent e = Extent::leaf({-r, -r, -r}, {r, r, r}, r.hi);
      sized(e, {in(0)}, r);
      return e;
    }
    case Primitive::box:
    case Primitive::ellipsoid:
    case Primitive::superq:
      return boxLike();
    case Primitive::cylinder:
      return centred(in(0), in(1) * kHalf, in(0));
    case Primitive::truncone: {
      const Interval top = in(1), bottom = in(2), widest = maximum(positivePart(top), positivePart(bottom));
      Extent e = centred(widest, in(0) * kHalf, widest);
      // One of a truncone's radii may be 0; with a negative one, derivation leaves the truncone out.
      e.certain = e.certain && top.lo >= 0 && bottom.lo >= 0;
      return e;
    }
    case Primitive::torus: {
      const Interval ring = positivePart(in(0)) + positivePart(in(1));
      Extent e = centred(ring, in(1), ring);
      sized(e, {in(0), in(1)}, in(1));
      return e;
    }
    case Primitive::capsule:
      return around(positivePart(in(2)), positivePart(in(2)).hi, true);
    // Derivation leaves out a tube or a beam whose ends coincide, so the shape is not certainly derived.
    case Primitive::tube:
      return around(positivePart(in(2)), positivePart(in(2)).hi + positivePart(in(3)).hi, false);
    // A corner of the square end section lies r beyond the end along the axis, and r off the axis in both directions
    // across: at the distance sqrt(3) r.
    case Primitive::beam:
      return around(positivePart(in(2)), positivePart(in(2)).hi * 1.7320508075688774 + positivePart(in(3)).hi, false);
    case Primitive::halfspace: {
      Extent e = Extent::unbounded();
      e.count = 1;
      e.certain = true;
      if (arg(0) != kNoId) e.at.may[1].hi = in(0).hi;
      if (arg(1) != kNoId) e.at.may[1].lo = in(1).lo;
      e.at.core = e.at.may;
      return e;
    }
    case Primitive::prism:
      return prism();
    case Primitive::ca:
      // unreachable: the extent of `ca` follows from the cell (boundAutomaton() of grammar/reach), not from the scope
      break;
  }
  return Extent::unbounded();
}

}  // namespace

Extent primitiveExtent(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame) {
  return Terminal(program, call, values, frame).extent();
}

Extent solidIn(const IntervalVector& edges) {
  IntervalVector lower, upper;
  for (size_t i = 0; i < 3; ++i) {
    upper[i] = positivePart(edges[i] * kHalf);
    lower[i] = -upper[i];
  }
  Extent e = Extent::leaf(lower, upper);
  e.inner = e.size();
  e.uncertain();
  e.node();
  return e;
}

}  // namespace sgm
