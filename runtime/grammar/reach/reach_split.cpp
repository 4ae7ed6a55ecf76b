// The possible places of parts of scopes; see derive/layout/split_layout.h and derive/interpret/split.cpp.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/reach_check.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm {

namespace {

/// Sizes of a split's unrepeated parts, and of one copy of its group.
struct Sums {
  Interval rigid{}, wanted{};
};

Interval notBelow(Interval v) { return {std::max(0.0, v.lo), std::max(0.0, v.hi)}; }

/// Pieces of a range of sizes: a small part lies farther out than a large one.
constexpr int kPieces = 4;
constexpr int kSplitsInPieces = 4;

}  // namespace

Extent ReachCheck::split(const StmtNode& s, RangeFrame& frame) {
  const size_t axis = s.extra;
  const IntervalVector scope = frame.scope;
  const Interval length = notBelow(scope[axis]);
  const PartNode* parts = program_.ast.parts.data() + s.parts.first;
  std::vector<Interval> sizes;
  Sums others, group;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    Interval size = values_.number(parts[i].size, frame);
    if (parts[i].relative) size = size * length;
    size = notBelow(size);
    sizes.push_back(size);
    Sums& sums = parts[i].repeated ? group : others;
    (parts[i].flexible ? sums.wanted : sums.rigid) = (parts[i].flexible ? sums.wanted : sums.rigid) + size;
  }
  // Rigid parts keep their size if nothing is cut off. Flexible parts of a group share up to half a copy more than they
  // want, or less than the rigid part of one copy that does not fit.
  const double snap = s.amount == kNoId ? 0 : std::max(0.0, values_.number(s.amount, frame).hi);
  const bool whole = others.rigid.hi <= length.lo && snap == 0;
  const double most = group.wanted.lo > 0 ? 1.5 + group.rigid.hi / group.wanted.lo + 1e-6 : kInfinity;
  const Interval once = group.rigid + group.wanted;
  const double times = once.lo > 0 ? std::max(1.0, length.hi / once.lo + 1) : kInfinity;
  double before = 0, after = 0;  // lengths that certainly lie there
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
    const bool wide =
        std::isfinite(size.hi) && size.hi - size.lo > length.hi / 8 && (!few_pieces_ || splits_ < kSplitsInPieces);
    Extent one = Extent::nothing();
    for (int k = 0; k < (wide ? kPieces : 1); ++k) {
      const double step = (size.hi - size.lo) / kPieces;
      const Interval piece =
          wide ? Interval{size.lo + k * step, k + 1 == kPieces ? size.hi : size.lo + (k + 1) * step} : size;
      IntervalVector by{};
      const double end = 0.5 * (length.hi - piece.lo);
      by[axis] = std::isfinite(end) ? Interval{std::min(before - end, end - after), std::max(before - end, end - after)}
                                    : Interval::everything();
      by[axis] = by[axis] + Interval{-kSeamOverlap, kSeamOverlap};
      const PlaceRange place = frame.place;
      frame.scope[axis] = {piece.lo, std::min(piece.hi + 2 * kSeamOverlap, length.hi)};
      frame.place.move(by);
      ++splits_;
      if (!size.exact()) values_.misfits().enterLoose();
      Extent e = body(program_.idAt(s.children, i), frame);
      if (!size.exact()) values_.misfits().leaveLoose();
      --splits_;
      frame.scope = scope;
      frame.place = place;
      e.move(by);
      if (k == 0)
        one = e;
      else
        one.either(e);
    }
    one.repeat({0, parts[i].repeated ? times : 1});
    out.join(one);
    if (sure) before += sizes[i].lo;
  }
  return out;
}

Extent ReachCheck::comp(const StmtNode& s, RangeFrame& frame) {
  const IntervalVector scope = {notBelow(frame.scope[0]), notBelow(frame.scope[1]), notBelow(frame.scope[2])};
  const IntervalVector written = frame.scope;
  const PlaceRange place = frame.place;
  Extent out = Extent::nothing();
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const StmtId child = program_.idAt(s.children, i);
    const BoxPart of = program_.ast.parts[s.parts.first + i].of;
    if (of == BoxPart::inside) {
      out.join(body(child, frame));
      continue;
    }
    const bool edges = of == BoxPart::edges;
    Extent some = Extent::nothing();
    double count = 0;
    for (int face = 0; face < 6; ++face) {
      const bool upright = face < 4;
      if (static_cast<int>(of) != face && !(upright && (edges || of == BoxPart::side))) continue;
      // Faces are in the order of BoxPart: front, right, back, left, top, bottom.
      const size_t depth = !upright ? 1 : face % 2 == 0 ? 2 : 0, width = depth == 0 ? 2 : 0, height = upright ? 1 : 2;
      const Interval half = scope[depth] * Interval::exactly(0.5);
      IntervalVector by{}, along{};
      by[depth] = face == 2 || face == 3 || face == 5 ? -half : half;
      if (edges) along[0] = scope[width] * Interval::exactly(0.5);
      const double quarters = upright ? face : face == 4 ? -1 : 1;
      const Interval angle = Interval::exactly(quarters * (kPi / 2));
      frame.place.move(by);
      frame.place.turned = frame.place.turned || face != 0;
      frame.place.move(along);
      frame.scope = {edges ? Interval{} : scope[width], scope[height], Interval{}};
      Extent e = body(child, frame);
      frame.scope = written;
      frame.place = place;
      e.move(along);
      if (face != 0) e.rotate(upright ? 1 : 0, angle);
      e.move(by);
      count += e.count;
      e.certain = false;
      some.join(e);
    }
    some.count = count;
    out.join(some);
  }
  return out;
}

}  // namespace sgm
