// Derives transforms, loops and anchors.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/statements.h"

namespace sgm::interpret {
namespace {

void transform(IdRange xforms, CellContext& c, Env& env) {
  for (uint32_t i = 0; i < xforms.count && !c.budget.failed(); ++i) {
    const XformNode& x = c.program.ast.xforms[xforms.first + i];
    const auto part = [&](ExprId id) { return id == kNoId ? 0.0 : c.evaluator.real(id, env); };
    const Value first = x.a == kNoId ? Value{} : c.evaluator.evaluate(x.a, env);
    const bool whole = first.kind == ValueKind::vector;
    switch (x.kind) {
      case XformKind::at:
        env.place = env.place.moved(whole ? first.vec() : Vec3{first.real(), part(x.b), part(x.c)});
        break;
      case XformKind::rot: {
        Vec3 axis = whole ? first.vec() : Vec3{};
        if (x.axis < 3) axis[x.axis] = 1;
        const double angle = part(x.b);
        if (!(length(axis) > 0) || !(std::fabs(angle) <= 1e6)) {
          c.budget.note(
              "a turn needs an axis longer than 0 and an angle within a million radians; this one is left out", x.span,
              env.activation);
        } else {
          env.place = env.place.turned(axis, angle);
        }
        break;
      }
      case XformKind::scale:
        if (first.real() > 0 && std::isfinite(first.real())) {
          env.place = env.place.scaled(first.real());
        } else {
          c.budget.note("a scale must be positive; it is left out", x.span, env.activation);
        }
        break;
      case XformKind::size:
        if (whole) {
          env.scope = first.vec();
        } else {
          // All edges are evaluated before any of them is replaced, so that `size(scope.z, scope.y, scope.x)` swaps two
          // edges.
          Vec3 edges = env.scope;
          if (x.a != kNoId) edges.x = first.real();
          if (x.b != kNoId) edges.y = part(x.b);
          if (x.c != kNoId) edges.z = part(x.c);
          env.scope = edges;
        }
        break;
      case XformKind::mirror:
        env.place = env.place.mirrored(std::min<int>(x.axis, 2));
        break;
    }
  }
}

}  // namespace

void runTransform(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  Env inner = env;
  transform(s.xforms, c, inner);
  runStatement(s.body, c, inner, out);
}

void runRepeat(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const double count = detFloor(c.evaluator.real(s.expr, env) + 0.5);
  Env copy = env;
  for (double i = 0; i < count && !c.budget.failed(); ++i) {
    if (i > 0) transform(s.xforms, c, copy);
    copy.key = env.key.child(kLoopSalt + s.ordinal, static_cast<uint64_t>(i));
    runStatement(s.body, c, copy, out);
    if (!c.budget.step(1, s.span, env.activation)) return;
  }
}

void runForEach(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const Value list = c.evaluator.evaluate(s.expr, env);
  if (c.budget.failed() || env.slots == nullptr || s.slot >= env.slots->size()) return;
  Env inner = env;
  const auto body = [&](Value item, uint64_t key) {
    (*env.slots)[s.slot] = std::move(item);
    inner.key = env.key.child(kLoopSalt + s.ordinal, key);
    runStatement(s.body, c, inner, out);
    return !c.budget.failed() && c.budget.step(1, s.span, env.activation);
  };
  if (list.kind == ValueKind::faces) {
    // The key of each copy depends only on the face at which the copy is placed. So if another face opens or closes,
    // the copy at this face stays the same.
    for (const FaceId& face : list.faces) {
      if (!body(Value::ofFace(face), c.in.lattice.faceKey(face).value)) return;
    }
    return;
  }
  if (list.kind == ValueKind::segments) {
    // The key of each copy depends only on the segment at which the copy is placed. So if other segments change, the
    // shapes of this copy stay the same.
    for (uint32_t i = list.first; i < list.first + list.count; ++i) {
      if (!body(Value::ofSegment(i), c.evaluator.segment(i).key.value)) return;
    }
    return;
  }
  const double first = detFloor(list.n[0].value + 0.5), last = detFloor(list.n[1].value + 0.5);
  if (!(std::fabs(first) < 1e15)) return;
  for (double i = first; i < last; ++i) {
    if (!body(Value::number(i), static_cast<uint64_t>(static_cast<int64_t>(i)))) return;
  }
}

void runAnchor(const StmtNode& s, CellContext& c, const Env& env) {
  if (!env.anchors) return;
  Anchor anchor;
  anchor.frame = env.place.frame();
  anchor.kind = static_cast<uint16_t>(s.extra == kNoId ? 0 : s.extra);
  anchor.name = static_cast<uint16_t>(s.extra2 == kNoId ? 0 : s.extra2);
  anchor.tag = env.tag;
  anchor.key = env.key.child(kAnchorSalt, s.ordinal);
  if (!cellBox(c.in.layer, c.in.cell).contains(anchor.frame.origin)) {
    c.budget.note("an anchor must lie in the cell that derives it, which alone owns it; this one is left out", s.span,
                  env.activation);
    return;
  }
  if (c.sink.anchors().size() >= c.in.limits.shapes) {
    c.budget.fail("one cell has more than " + std::to_string(c.in.limits.shapes) +
                      " anchors (derive fewer, or make the cells smaller)",
                  s.span, env.activation);
    return;
  }
  c.sink.addAnchor(anchor);
}

}  // namespace sgm::interpret
