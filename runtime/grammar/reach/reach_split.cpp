// Extents of split and comp: the possible places of their parts. See derive/layout/split_layout.h and
// derive/interpret/split.cpp.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/kept_scope.h"
#include "grammar/reach/reach_statements.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::reach {

namespace {

/// Sums of sizes over a split's parts outside the repeated group, or over the parts of one copy of the group. rigid:
/// sizes of rigid parts; wanted: preferred sizes of flexible parts.
struct Sums {
  Interval rigid{}, wanted{};
};

/// Number of pieces into which a range of sizes is divided. Small parts may lie farther out than large ones, so each
/// piece has a tighter bound than the whole range.
constexpr int kPieces = 4;

/// The possible places of a part along the axis of its split, metres.
struct PartPlace {
  size_t axis = 0;
  Interval length;               ///< possible lengths of the split's scope along the axis
  Interval size;                 ///< possible sizes of the part along the axis
  double before = 0, after = 0;  ///< total lengths of the other parts that certainly lie before and after this part
};

/// Returns the extent of a part for the sizes in `piece`. exact: the part has exactly one size.
Extent boundPiece(StmtId child, const PartPlace& part, Interval piece, bool exact, RangeFrame& frame,
                  ReachContext& context) {
  const KeptScope kept(frame);
  IntervalVector by{};
  const double end = 0.5 * (part.length.hi - piece.lo), low = part.before - end, high = end - part.after;
  by[part.axis] = std::isfinite(end) ? Interval{std::min(low, high), std::max(low, high)} : Interval::everything();
  by[part.axis] = by[part.axis] + Interval{-kSeamOverlap, kSeamOverlap};
  frame.scope[part.axis] = {piece.lo, std::min(piece.hi + 2 * kSeamOverlap, part.length.hi)};
  frame.place.move(by);
  context.pieces.enterSplit();
  if (!exact) context.values.misfits().enterLoose();
  Extent e = boundStatement(child, frame, context);
  if (!exact) context.values.misfits().leaveLoose();
  context.pieces.leaveSplit();
  e.move(by);
  return e;
}

/// Returns the extent of one copy of a part, for all of its possible sizes.
Extent boundPart(StmtId child, const PartPlace& part, RangeFrame& frame, ReachContext& context) {
  const Interval size = part.size;
  const bool wide = std::isfinite(size.hi) && size.hi - size.lo > part.length.hi / 8 && context.pieces.dividesSizes();
  std::optional<Extent> out;
  for (int k = 0; k < (wide ? kPieces : 1); ++k) {
    const double step = (size.hi - size.lo) / kPieces;
    const Interval piece =
        wide ? Interval{size.lo + k * step, k + 1 == kPieces ? size.hi : size.lo + (k + 1) * step} : size;
    addAlternative(out, boundPiece(child, part, piece, size.exact(), frame, context));
  }
  return *out;
}

/// Returns the extent of a child at a face of a box, or, if `edge` is set, at the edge to the right of the face. face:
/// index in the order of BoxPart: front, right, back, left, top, bottom. box: edges of the box.
Extent boundFace(StmtId child, int face, bool edge, const IntervalVector& box, RangeFrame& frame,
                 ReachContext& context) {
  const KeptScope kept(frame);
  const bool upright = face < 4;
  const size_t depth = !upright ? 1 : face % 2 == 0 ? 2 : 0, width = depth == 0 ? 2 : 0, height = upright ? 1 : 2;
  const Interval half = box[depth] * Interval::exactly(0.5);
  IntervalVector by{}, along{};
  by[depth] = face == 2 || face == 3 || face == 5 ? -half : half;
  if (edge) along[0] = box[width] * Interval::exactly(0.5);
  const double quarters = upright ? face : face == 4 ? -1 : 1;
  const Interval angle = Interval::exactly(quarters * (kPi / 2));
  frame.place.move(by);
  frame.place.turned = frame.place.turned || face != 0;
  frame.place.move(along);
  frame.scope = {edge ? Interval{} : box[width], box[height], Interval{}};
  Extent e = boundStatement(child, frame, context);
  e.move(along);
  if (face != 0) e.rotate(upright ? 1 : 0, angle);
  e.move(by);
  return e;
}

}  // namespace

Extent boundSplit(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const size_t axis = s.extra;
  const Interval length = atLeastZero(frame.scope[axis]);
  const PartNode* parts = context.program.ast.parts.data() + s.parts.first;
  std::vector<Interval> sizes;
  Sums others, group;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    Interval size = context.values.number(parts[i].size, frame);
    if (parts[i].relative) size = size * length;
    size = atLeastZero(size);
    sizes.push_back(size);
    Sums& sums = parts[i].repeated ? group : others;
    (parts[i].flexible ? sums.wanted : sums.rigid) = (parts[i].flexible ? sums.wanted : sums.rigid) + size;
  }
  // Rigid parts keep their size if nothing is cut off. A flexible part of the repeated group stretches at most by the
  // factor 1.5, since the number of copies is rounded to the nearest whole number. If this rounding asks for one more
  // copy, but the rigid parts of that copy do not fit, the factor grows by at most the ratio of the group's rigid size
  // to its preferred flexible size.
  const double snap = s.amount == kNoId ? 0 : std::max(0.0, context.values.number(s.amount, frame).hi);
  const bool whole = others.rigid.hi <= length.lo && snap == 0;
  const double most = group.wanted.lo > 0 ? 1.5 + group.rigid.hi / group.wanted.lo + 1e-6 : kInfinity;
  const Interval once = group.rigid + group.wanted;
  const double times = once.lo > 0 ? std::max(1.0, length.hi / once.lo + 1) : kInfinity;
  double before = 0, after = 0;  // total length of the other parts that certainly lie before or after the current part
  for (uint32_t i = 0; i < s.parts.count; ++i)
    if (whole && !parts[i].flexible && !parts[i].repeated) after += sizes[i].lo;
  Extent out = Extent::nothing();
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const bool rigid = whole && !parts[i].flexible;
    const bool sure = rigid && !parts[i].repeated;
    if (sure) after -= sizes[i].lo;
    Interval size{rigid ? std::min(sizes[i].lo, length.lo) : 0, length.hi};
    if (!parts[i].flexible) size.hi = std::min(size.hi, sizes[i].hi);
    if (parts[i].flexible) size.hi = std::max(0.0, size.hi - before - after);
    if (parts[i].flexible && parts[i].repeated) size.hi = std::min(size.hi, sizes[i].hi * most);
    size.hi = std::min(size.hi + 2 * snap, length.hi);
    Extent one = boundPart(context.program.idAt(s.children, i), {axis, length, size, before, after}, frame, context);
    one.repeat({0, parts[i].repeated ? times : 1});
    out.join(one);
    if (sure) before += sizes[i].lo;
  }
  return out;
}

Extent boundComp(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const IntervalVector scope = {atLeastZero(frame.scope[0]), atLeastZero(frame.scope[1]), atLeastZero(frame.scope[2])};
  Extent out = Extent::nothing();
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const StmtId child = context.program.idAt(s.children, i);
    const BoxPart of = context.program.ast.parts[s.parts.first + i].of;
    if (of == BoxPart::inside) {
      out.join(boundStatement(child, frame, context));
      continue;
    }
    const bool edges = of == BoxPart::edges;
    Extent some = Extent::nothing();
    double count = 0;
    for (int face = 0; face < 6; ++face) {
      if (static_cast<int>(of) != face && !(face < 4 && (edges || of == BoxPart::side))) continue;
      Extent e = boundFace(child, face, edges, scope, frame, context);
      count += e.count;
      e.certain = false;
      some.join(e);
    }
    some.count = count;
    out.join(some);
  }
  return out;
}

}  // namespace sgm::reach
