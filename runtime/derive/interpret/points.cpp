// Transforms, loops, point sets and anchors.

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/interpreter.h"
#include "derive/layout/scatter.h"

namespace sgm {

void Interpreter::transform(IdRange xforms, Env& env) {
  for (uint32_t i = 0; i < xforms.count && !failed(); ++i) {
    const XformNode& x = program_.ast.xforms[xforms.first + i];
    const auto part = [&](ExprId id) { return id == kNoId ? 0.0 : real(id, env); };
    const Value first = x.a == kNoId ? Value{} : evaluate(x.a, env);
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
          note("a turn needs an axis longer than 0 and an angle within a million radians; this one is left out", x.span,
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
          note("a scale must be positive; it is left out", x.span, env.activation);
        }
        break;
      case XformKind::size:
        if (whole) {
          env.scope = first.vec();
        } else {
          // All edges are read in the original scope: `size(scope.z, scope.y, scope.x)` swaps two.
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

void Interpreter::repeat(const StmtNode& s, const Env& env, ShapeList& out) {
  const double count = detFloor(real(s.expr, env) + 0.5);
  Env copy = env;
  for (double i = 0; i < count && !failed(); ++i) {
    if (i > 0) transform(s.xforms, copy);
    copy.key = env.key.child(kLoopSalt + s.ordinal, static_cast<uint64_t>(i));
    statement(s.body, copy, out);
    if (!step(1, s.span, env.activation)) return;
  }
}

void Interpreter::forEach(const StmtNode& s, const Env& env, ShapeList& out) {
  const Value list = evaluate(s.expr, env);
  if (failed() || env.slots == nullptr || s.slot >= env.slots->size()) return;
  Env inner = env;
  const auto body = [&](Value item, uint64_t key) {
    (*env.slots)[s.slot] = std::move(item);
    inner.key = env.key.child(kLoopSalt + s.ordinal, key);
    statement(s.body, inner, out);
    return !failed() && step(1, s.span, env.activation);
  };
  if (list.kind == ValueKind::faces) {
    // With the face's own key: a face that opens or closes changes nothing at the others.
    for (const FaceId& face : list.faces) {
      if (!body(Value::ofFace(face), lattice_.faceKey(face).value)) return;
    }
    return;
  }
  if (list.kind == ValueKind::segments) {
    // In the same way, shapes at one segment do not depend on the others.
    for (uint32_t i = list.first; i < list.first + list.count; ++i) {
      if (!body(Value::ofSegment(i), segments_[i].key.value)) return;
    }
    return;
  }
  const double first = detFloor(list.n[0].value + 0.5), last = detFloor(list.n[1].value + 0.5);
  if (!(std::fabs(first) < 1e15)) return;
  for (double i = first; i < last; ++i) {
    if (!body(Value::number(i), static_cast<uint64_t>(static_cast<int64_t>(i)))) return;
  }
}

void Interpreter::scatter(const StmtNode& s, const Env& env, ShapeList& out) {
  const ProbedPoints outside = std::exchange(probed_, {});
  scatterPoints(s, env, out);
  if (probed_.buried > 0 && !failed()) noteBuried(s, env);
  probed_ = outside;
}

/// In a domain of rock most points are inside the rock, and are meant to find the caves. Elsewhere a solid is the
/// ground on which the points are probably meant to be.
void Interpreter::noteBuried(const StmtNode& s, const Env& env) {
  if (program_.domain.solid || 2 * probed_.buried < probed_.all) return;
  const ScatterNode& node = program_.ast.scatters[s.extra];
  const std::string below(program_.text(node.layer_name));
  note((probed_.buried == probed_.all ? "all points of this scatter begin inside `"
                                      : "most points of this scatter begin inside `") +
           below + "`, and are left out: let them begin in the open, such as after at(0m, " +
           (node.probe > 0 ? "-" : "") + "50m, 0m), and probe farther",
       s.span, env.activation);
}

void Interpreter::scatterPoints(const StmtNode& s, const Env& env, ShapeList& out) {
  const ScatterNode& node = program_.ast.scatters[s.extra];
  const double amount = real(node.count, env);
  const auto point = [&](Vec3 local, uint64_t key) {
    Env at = env;
    at.place = env.place.moved(local);
    at.key = env.key.child(kLoopSalt + s.ordinal, key);
    scatterPoint(s, at, out);
    return !failed();
  };
  if (node.area == ScatterArea::cell) {
    // The set is common to the whole layer: its key depends on the statement, not on the cell.
    const Activation& use = activations_[env.activation];
    const uint64_t owner = use.edit == kNone ? program_.rules[use.rule].name_hash : program_.overrides[use.edit].hash;
    const PathKey set = PathKey{lattice_.seed}.child(kSetSalt + owner, s.ordinal);
    if (!(amount > 0)) {
      note("the distance between points must be positive; there are no points", s.span, env.activation);
      return;
    }
    // Candidates are all held at once: their memory is counted before they are allocated.
    constexpr size_t kCandidate = 64;
    const size_t most = std::min<size_t>(limits_.steps - steps_, limits_.bytes / kCandidate);
    const auto points = poissonInCell(lattice_, cell_, set, toUnits(amount), most);
    if (!points) {
      fail("one cell has more points than can be derived (take a larger distance in poisson())", s.span,
           env.activation);
      return;
    }
    if (!step(points->size() * 27, s.span, env.activation)) return;
    for (const LatticePoint& p : *points) {
      if (!point(cellOrigin() + Vec3{metres(p.offset.x), metres(p.offset.y), metres(p.offset.z)}, p.key.value)) return;
    }
    return;
  }
  const Value first = node.a == kNoId ? Value{} : evaluate(node.a, env);
  const double b = node.b == kNoId ? (node.area == ScatterArea::shell ? 1.0 : 0.0) : real(node.b, env);
  const double c = node.c == kNoId ? 0.0 : real(node.c, env);
  const double size = first.real();
  const Vec3 edges = first.kind == ValueKind::vector ? first.vec() : Vec3{size, b, c};
  const double up = std::clamp(b, 0.0, 1.0);
  double count = amount;
  if (node.poisson) {
    if (!(amount > 0)) {
      note("the distance between points must be positive; there are no points", s.span, env.activation);
      return;
    }
    const double cube = amount * amount * amount, square = amount * amount;
    count = node.area == ScatterArea::shell  ? 4.0 * kPi * size * size * up / square
            : node.area == ScatterArea::disc ? kPi * size * size / square
                                             : edges.x * edges.y * edges.z / cube;
  }
  count = detFloor(count + 0.5);
  if (!(count >= 1)) return;
  if (!(count < 1e6)) {
    fail("one scatter has more than a million points (take fewer, or a larger distance)", s.span, env.activation);
    return;
  }
  const size_t n = static_cast<size_t>(count);
  if (!step(node.poisson ? n * n / 8 + n : n, s.span, env.activation)) return;
  const PathKey key = env.key.child(kSetSalt, s.ordinal);
  const std::vector<Vec3> points = node.area == ScatterArea::shell  ? scatterOnShell(key, n, size, up)
                                   : node.area == ScatterArea::disc ? scatterOnDisc(key, n, size)
                                                                    : scatterInBox(key, n, edges);
  if (!node.poisson) {
    for (size_t i = 0; i < n; ++i) {
      if (!point(points[i], i)) return;
    }
    return;
  }
  for (size_t i : thinned(key, points, amount)) {
    if (!point(points[i], i)) return;
  }
}

void Interpreter::scatterPoint(const StmtNode& s, const Env& at, ShapeList& out) {
  const ScatterNode& node = program_.ast.scatters[s.extra];
  if (!step(1, s.span, at.activation)) return;
  const auto wanted = [&] { return node.when == kNoId || evaluate(node.when, at).truth(); };
  // Probes are expensive; a point depends only on a probe that yields a gap.
  const bool asks_gap = node.gap != kNoId;
  if (!asks_gap && !wanted()) return;
  Env moved = at;
  if (node.probe != 0 && !probe(node, moved)) return;
  if (asks_gap && !wanted()) return;
  statement(s.body, moved, out);
}

bool Interpreter::probe(const ScatterNode& node, Env& env) {
  const int32_t distance = toUnits(real(node.distance, env) * env.place.scale);
  if (failed() || distance <= 0) return false;
  if (!step(static_cast<uint64_t>(distance / kProbeStep) + 12, node.span, env.activation)) return false;
  const int32_t within = node.gap == kNoId ? 0 : toUnits(real(node.within, env) * env.place.scale);
  if (failed() || !step(static_cast<uint64_t>(std::max(within, 0) / kProbeStep), node.span, env.activation))
    return false;
  const Vec3 d = env.place.direction({0, node.probe > 0 ? 1.0 : -1.0, 0});
  const Int3 from = env.place.snap({});
  const std::optional<int32_t> hit = lower_.probe(node.layer, from, {d.x, d.y, d.z}, distance);
  ++probed_.all;
  if (!hit) {
    if (!program_.domain.solid && lower_.solid(node.layer, from)) ++probed_.buried;
    return false;
  }
  if (node.gap != kNoId && env.slots != nullptr && node.slot < env.slots->size()) {
    const std::optional<int32_t> back = lower_.probe(node.layer, from, {-d.x, -d.y, -d.z}, within - *hit);
    if (!back) return false;
    (*env.slots)[node.slot] = Value::number(metres(*hit + *back) / env.place.scale);
  }
  const Int3 rel = saturatingSub(probePoint(from, {d.x, d.y, d.z}, *hit), env.place.base);
  env.place.offset = {metres(rel.x), metres(rel.y), metres(rel.z)};
  return true;
}

void Interpreter::anchor(const StmtNode& s, const Env& env) {
  if (!env.anchors) return;
  Anchor anchor;
  anchor.frame = env.place.frame();
  anchor.kind = static_cast<uint16_t>(s.extra == kNoId ? 0 : s.extra);
  anchor.name = static_cast<uint16_t>(s.extra2 == kNoId ? 0 : s.extra2);
  anchor.tag = env.tag;
  anchor.key = env.key.child(kAnchorSalt, s.ordinal);
  if (!cellBox(layer_, cell_).contains(anchor.frame.origin)) {
    note("an anchor must lie in the cell that derives it, which alone owns it; this one is left out", s.span,
         env.activation);
    return;
  }
  if (anchors_.size() >= limits_.shapes) {
    fail("one cell has more than " + std::to_string(limits_.shapes) +
             " anchors (derive fewer, or make the cells smaller)",
         s.span, env.activation);
    return;
  }
  anchors_.push_back(anchor);
}

}  // namespace sgm
