// Derives the statement `scatter`, which derives its body at each point of a point set.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/statements.h"
#include "derive/layout/scatter.h"

namespace sgm::interpret {
namespace {

/// Statistics of one scatter: the number of points probed, and how many of these started inside a solid.
struct ProbedPoints {
  uint64_t all = 0, buried = 0;
};

/// Adds a note if at least half of the probed points started inside a solid: they were probably meant to start above
/// the ground. Adds none in a solid domain, where most points lie in rock and are meant to find the caves.
void noteBuried(const StmtNode& s, CellContext& c, const Env& env, const ProbedPoints& probed) {
  if (c.program.domain.solid || 2 * probed.buried < probed.all) return;
  const ScatterNode& node = c.program.ast.scatters[s.extra];
  const std::string below(c.program.text(node.layer_name));
  c.budget.note((probed.buried == probed.all ? "all points of this scatter begin inside `"
                                             : "most points of this scatter begin inside `") +
                    below + "`, and are left out: let them begin in the open, such as after at(0m, " +
                    (node.probe > 0 ? "-" : "") + "50m, 0m), and probe farther",
                s.span, env.activation);
}

/// Moves the environment to the first surface in the probe's direction; returns false if there is none.
bool probe(const ScatterNode& node, CellContext& c, Env& env, ProbedPoints& probed) {
  const int32_t distance = toUnits(c.evaluator.real(node.distance, env) * env.place.scale);
  if (c.budget.failed() || distance <= 0) return false;
  if (!c.budget.step(static_cast<uint64_t>(distance / kProbeStep) + 12, node.span, env.activation)) return false;
  const int32_t within = node.gap == kNoId ? 0 : toUnits(c.evaluator.real(node.within, env) * env.place.scale);
  if (c.budget.failed() ||
      !c.budget.step(static_cast<uint64_t>(std::max(within, 0) / kProbeStep), node.span, env.activation))
    return false;
  const Vec3 d = env.place.direction({0, node.probe > 0 ? 1.0 : -1.0, 0});
  const Int3 from = env.place.snap({});
  const std::optional<int32_t> hit = c.in.lower.probe(node.layer, from, {d.x, d.y, d.z}, distance);
  ++probed.all;
  if (!hit) {
    if (!c.program.domain.solid && c.in.lower.solid(node.layer, from)) ++probed.buried;
    return false;
  }
  if (node.gap != kNoId && env.slots != nullptr && node.slot < env.slots->size()) {
    const std::optional<int32_t> back = c.in.lower.probe(node.layer, from, {-d.x, -d.y, -d.z}, within - *hit);
    if (!back) return false;
    (*env.slots)[node.slot] = Value::number(metres(*hit + *back) / env.place.scale);
  }
  const Int3 rel = saturatingSub(probePoint(from, {d.x, d.y, d.z}, *hit), env.place.base);
  env.place.offset = {metres(rel.x), metres(rel.y), metres(rel.z)};
  return true;
}

void scatterPoint(const StmtNode& s, CellContext& c, const Env& at, ProbedPoints& probed, ShapeList& out) {
  const ScatterNode& node = c.program.ast.scatters[s.extra];
  if (!c.budget.step(1, s.span, at.activation)) return;
  const auto wanted = [&] { return node.when == kNoId || c.evaluator.evaluate(node.when, at).truth(); };
  // Probes are expensive, so the condition is evaluated before the probe, unless it may use the gap: the free distance
  // that the probe measures.
  const bool asks_gap = node.gap != kNoId;
  if (!asks_gap && !wanted()) return;
  Env moved = at;
  if (node.probe != 0 && !probe(node, c, moved, probed)) return;
  if (asks_gap && !wanted()) return;
  runStatement(s.body, c, moved, out);
}

void scatterPoints(const StmtNode& s, CellContext& c, const Env& env, ProbedPoints& probed, ShapeList& out) {
  const ScatterNode& node = c.program.ast.scatters[s.extra];
  const double amount = c.evaluator.real(node.count, env);
  const auto point = [&](Vec3 local, uint64_t key) {
    Env at = env;
    at.place = env.place.moved(local);
    at.key = env.key.child(kLoopSalt + s.ordinal, key);
    scatterPoint(s, c, at, probed, out);
    return !c.budget.failed();
  };
  if (node.area == ScatterArea::cell) {
    // The point set extends over the whole layer: its key depends on the statement, not on the cell or the position.
    const Activation& use = c.activations[env.activation];
    const uint64_t owner = use.edit == kNone ? c.program.rules[use.rule].name_hash : c.program.overrides[use.edit].hash;
    const PathKey set = PathKey{c.in.lattice.seed}.child(kSetSalt + owner, s.ordinal);
    if (!(amount > 0)) {
      c.budget.note("the distance between points must be positive; there are no points", s.span, env.activation);
      return;
    }
    // All candidates are in memory at once, so their number is limited before they are allocated. kCandidate is the
    // assumed size of a candidate in bytes.
    constexpr size_t kCandidate = 64;
    const size_t most = std::min<size_t>(c.budget.stepsLeft(), c.in.limits.bytes / kCandidate);
    const auto points = poissonInCell(c.in.lattice, c.in.cell, set, toUnits(amount), most);
    if (!points) {
      c.budget.fail("one cell has more points than can be derived (take a larger distance in poisson())", s.span,
                    env.activation);
      return;
    }
    if (!c.budget.step(points->size() * 27, s.span, env.activation)) return;
    for (const LatticePoint& p : *points) {
      if (!point(c.in.origin() + Vec3{metres(p.offset.x), metres(p.offset.y), metres(p.offset.z)}, p.key.value)) return;
    }
    return;
  }
  const Value first = node.a == kNoId ? Value{} : c.evaluator.evaluate(node.a, env);
  const double b = node.b == kNoId ? (node.area == ScatterArea::shell ? 1.0 : 0.0) : c.evaluator.real(node.b, env);
  const double depth = node.c == kNoId ? 0.0 : c.evaluator.real(node.c, env);
  const double size = first.real();
  const Vec3 edges = first.kind == ValueKind::vector ? first.vec() : Vec3{size, b, depth};
  const double up = std::clamp(b, 0.0, 1.0);
  double count = amount;
  if (node.poisson) {
    if (!(amount > 0)) {
      c.budget.note("the distance between points must be positive; there are no points", s.span, env.activation);
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
    c.budget.fail("one scatter has more than a million points (take fewer, or a larger distance)", s.span,
                  env.activation);
    return;
  }
  const size_t n = static_cast<size_t>(count);
  if (!c.budget.step(node.poisson ? n * n / 8 + n : n, s.span, env.activation)) return;
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

}  // namespace

void runScatter(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ProbedPoints probed;
  scatterPoints(s, c, env, probed, out);
  if (probed.buried > 0 && !c.budget.failed()) noteBuried(s, c, env, probed);
}

}  // namespace sgm::interpret
