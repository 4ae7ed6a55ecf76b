#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/reach_check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Statements without a shape of their own.
bool isSilent(StmtKind kind) {
  return kind == StmtKind::let || kind == StmtKind::field || kind == StmtKind::mat || kind == StmtKind::tag ||
         kind == StmtKind::anchor || kind == StmtKind::footprint;
}

}  // namespace

Extent ReachCheck::body(StmtId id, RangeFrame& frame) {
  const IntervalVector scope = frame.scope;
  const PlaceRange place = frame.place;
  Extent e = statement(id, frame);
  frame.scope = scope;
  frame.place = place;
  return e;
}

Extent ReachCheck::statement(StmtId id, RangeFrame& frame) {
  if (id == kNoId) return Extent::nothing();
  if (tooFar()) return Extent::unbounded();
  --steps_;
  ++depth_;
  // Keep the loss of the enclosing statement's evaluations: a place, a count.
  const uint32_t around = values_.losses().takeLatest();
  Extent e = statementKinds(program_.stmt(id), frame);
  const uint32_t loss = values_.losses().takeLatest();
  if (e.loss == 0 && e.lost()) e.loss = loss;
  values_.losses().restoreLatest(around);
  --depth_;
  return e;
}

Extent ReachCheck::statementKinds(const StmtNode& s, RangeFrame& frame) {
  switch (s.kind) {
    case StmtKind::block:
      return tagged(s, s.tag, frame);
    case StmtKind::call:
      return callExtent(s.expr, frame, Call::written);
    case StmtKind::unite:
    case StmtKind::cut: {
      Extent e = body(s.body, frame);
      if (s.amount != kNoId) e.smooth(std::max(0.0, values_.number(s.amount, frame).hi));
      return e;
    }
    case StmtKind::meet:
      return tagged(s, program_.stmt(s.body).kind == StmtKind::block ? program_.stmt(s.body).tag : uint16_t{0}, frame);
    case StmtKind::sum: {
      Extent e = body(s.body, frame);
      e.summed();
      return e;
    }
    case StmtKind::morph:
      return morph(s, frame);
    case StmtKind::displace:
      return displaced(s, frame);
    case StmtKind::warp:
      return warped(s, frame);
    case StmtKind::transform:
      return transformed(s, frame);
    case StmtKind::repeat:
      return repeated(s, frame);
    case StmtKind::for_each:
      return forEach(s, frame);
    case StmtKind::scatter:
      return scattered(s, frame);
    case StmtKind::split:
      return split(s, frame);
    case StmtKind::comp:
      return comp(s, frame);
    case StmtKind::treemap:
      return treemap(s, frame);
    case StmtKind::wfc:
      return wave(s, frame);
    case StmtKind::let:
      frame.slots[s.slot] = values_.evaluate(s.expr, frame);
      return Extent::nothing();
    case StmtKind::snap:
      values_.number(s.expr, frame);  // queries in these
      if (s.amount != kNoId) values_.number(s.amount, frame);
      return body(s.body, frame);
    case StmtKind::detail: {
      values_.number(s.expr, frame);  // a query in it
      return body(s.body, frame);
    }
    case StmtKind::footprint:
      frame.slots[s.slot] = footprint(program_.ast.footprints[s.extra], frame);
      return Extent::nothing();
    case StmtKind::extrude:
      return tagged(s, s.body == kNoId ? uint16_t{0} : program_.stmt(s.body).tag, frame);
    case StmtKind::roof:
      return roof(s, frame);
    case StmtKind::fit:
      return fit(s, frame);
    case StmtKind::inner:
      return inner(s, frame);
    case StmtKind::field:
    case StmtKind::mat:
    case StmtKind::tag:
    case StmtKind::anchor:
    case StmtKind::link:
    case StmtKind::border:
      return Extent::nothing();
  }
  return Extent::unbounded();
}

Extent ReachCheck::block(const StmtNode& s, RangeFrame& frame, Extent first) {
  return blockFrom(s, 0, frame, std::move(first));
}

Extent ReachCheck::blockFrom(const StmtNode& s, uint32_t next, RangeFrame& frame, Extent out) {
  for (uint32_t i = next; i < s.children.count; ++i) {
    const StmtId child = program_.idAt(s.children, i);
    const StmtNode& inner = program_.stmt(program_.innermost(child));
    const Extent part = statement(child, frame);
    if (inner.kind == StmtKind::let && pieces_ != Pieces::none && hasPieces(frame.slots[inner.slot])) {
      const uint32_t slot = inner.slot;
      return overPieces({&frame.slots[slot]}, [&] {
        RangeFrame at = frame;
        return blockFrom(s, i + 1, at, out);
      });
    }
    if (inner.kind == StmtKind::cut && !(inner.layer_level && frame.top)) {
      // A nested cut adds nothing, but makes the content before it uncertain.
      if (!part.empty) out.uncertain();
      out.node();
      continue;
    }
    out.join(part);
  }
  return out;
}

Extent ReachCheck::meet(const StmtNode& s, RangeFrame& frame) {
  const StmtNode& inner = program_.stmt(s.body);
  if (inner.kind != StmtKind::block) return body(s.body, frame);
  Extent out = Extent::nothing();
  double inner_radius = 0, count = 0;
  bool first = true, missing = false;
  for (uint32_t i = 0; i < inner.children.count; ++i) {
    const StmtId child = program_.idAt(inner.children, i);
    const Extent part = statement(child, frame);
    if (isSilent(program_.stmt(child).kind)) continue;
    if (program_.stmt(program_.innermost(child)).kind == StmtKind::cut) continue;
    missing = missing || part.empty;
    inner_radius = std::max(inner_radius, part.inner);
    count += part.count;
    if (first)
      out = part;
    else
      out.intersect(part);
    first = false;
  }
  if (missing || first) return Extent::nothing();
  // A missing operand removes the whole meet.
  out.certain = false;
  out.inner = inner_radius;
  out.inner_low = 0;
  out.count = std::max(1.0, count);
  out.node();
  return out;
}

Extent ReachCheck::morph(const StmtNode& s, RangeFrame& frame) {
  Extent a = body(program_.idAt(s.children, 0), frame);
  const Extent b = body(program_.idAt(s.children, 1), frame);
  bool apart = false;
  for (size_t i = 0; i < 3 && !a.empty && !b.empty; ++i)
    apart = apart || a.at.may[i].hi < b.at.may[i].lo || b.at.may[i].hi < a.at.may[i].lo;
  if (apart && pieces_ == Pieces::none)
    sink_.warning(s.span, codes::kMorphDisjoint, "the two shapes of this morph lie apart, and may vanish half way",
                  "let them overlap");
  // A blend contains the intersection of both: only that is certain.
  std::array<double, 3> lo = a.sure_lo, hi = a.sure_hi;
  for (size_t i = 0; i < 3; ++i) {
    lo[i] = std::max(lo[i], b.sure_lo[i]);
    hi[i] = std::min(hi[i], b.sure_hi[i]);
  }
  const bool both = a.certain && b.certain;
  const double inner_low = std::min(a.inner_low, b.inner_low);
  a.join(b);
  a.sure_lo = lo;
  a.sure_hi = hi;
  a.certain = both;
  a.inner_low = inner_low;
  if (s.power && !a.empty) {
    // A superquadric with radii in between.
    const double least = inner_low > 0 ? 1 / inner_low : kInfinity;
    a.at.core = a.at.may;
    a.at.ball = 0;
    a.at.core_radius = anyDirection(a.at.may)[0].hi;
    a.spread = std::max(1.0, a.size() * least);
    a.turned_spread = std::max(1.0, a.at.core_radius * least);
  }
  a.count = std::max(1.0, a.count);
  a.node();
  return a;
}

Extent ReachCheck::displaced(const StmtNode& s, RangeFrame& frame) {
  Interval by = values_.number(s.expr, frame);
  if (s.amount != kNoId) {
    const double most = values_.number(s.amount, frame).magnitude();
    by = minimum(maximum(by, {-most, -most}), {most, most});
  }
  Extent e = body(s.body, frame);
  const Unbound before = e.why;
  // Positive displacement makes the shape smaller, negative larger.
  e.shrinkSure(by.magnitude() * (std::isfinite(e.spread) ? e.spread : 1));
  e.grow(std::max(0.0, -by.lo));
  e.node();
  if ((!std::isfinite(by.lo) || e.why != before) && !e.empty) {
    e.largest_contributor = s.expr;
    e.contributor_size = kInfinity;
  }
  return e;
}

Extent ReachCheck::warped(const StmtNode& s, RangeFrame& frame) {
  IntervalVector by = values_.vector(s.expr, frame);
  double most = kInfinity, largest = 0;
  if (s.amount != kNoId) most = values_.number(s.amount, frame).magnitude();
  for (Interval& part : by) {
    part = -minimum(maximum(part, {-most, -most}), {most, most});
    largest = std::max(largest, part.magnitude());
  }
  Extent e = body(s.body, frame);
  e.add(by);
  e.node();
  e.shrinkSure(largest);
  if (!std::isfinite(largest) && !e.empty) {
    e.largest_contributor = s.expr;
    e.contributor_size = largest;
  }
  return e;
}

}  // namespace sgm
