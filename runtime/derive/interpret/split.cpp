// Derives `split` and `comp`, which divide a scope into parts. The box of a scope is centred on its origin, as in
// box(scope).

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/statements.h"
#include "derive/layout/split_layout.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::interpret {
namespace {

constexpr double kMaxParts = 1e6;

/// A face of a box, with the rotation that makes z point out of the face.
struct Face {
  BoxPart part;
  int turn_axis;
  double quarters;
  int width, height, depth;  ///< axes of the box (0 to 2) along the face's x, y and z
  double sign;               ///< +1 or -1: the side of the box's centre on which the face lies
};

constexpr Face kFaces[] = {{BoxPart::front, 1, 0, 0, 1, 2, 1}, {BoxPart::right, 1, 1, 2, 1, 0, 1},
                           {BoxPart::back, 1, 2, 0, 1, 2, -1}, {BoxPart::left, 1, 3, 2, 1, 0, -1},
                           {BoxPart::top, 0, -1, 0, 2, 1, 1},  {BoxPart::bottom, 0, 1, 0, 2, 1, -1}};
constexpr size_t kSides = 4;

Placement facePlace(const Face& face, const Placement& box, Vec3 edges) {
  Vec3 out, axis;
  out[face.depth] = 0.5 * face.sign * edges[face.depth];
  axis[face.turn_axis] = 1;
  return box.moved(out).turned(axis, face.quarters * (kPi / 2));
}

/// Returns the signed distance along the axis from a point to the nearest snap plane; 0 if no plane is within `reach`.
double toNearestPlane(const SnapPlanes* planes, const Placement& place, int axis, Vec3 local, double reach) {
  constexpr double kParallel = 1 - 1e-9;
  Vec3 along;
  along[axis] = 1;
  const Vec3 direction = place.direction(along), at = place.toCell(local);
  double best = 0, nearest = reach;
  for (; planes != nullptr; planes = planes->outer) {
    const double facing = dot(direction, planes->normal);
    if (std::fabs(facing) < kParallel) continue;
    const double from = (dot(at, planes->normal) - planes->first) / planes->distance;
    const double by = (detFloor(from + 0.5) - from) * planes->distance / place.scale;
    if (!(std::fabs(by) <= nearest)) continue;
    nearest = std::fabs(by);
    best = facing > 0 ? by : -by;
  }
  return best;
}

/// Moves the borders between parts to snap planes, if the parts on both sides keep a positive size.
void snapLines(std::vector<SplitPlace>& places, double length, const SnapPlanes* planes, const Placement& place,
               int axis, double reach) {
  for (size_t i = 0; i + 1 < places.size(); ++i) {
    SplitPlace& low = places[i];
    SplitPlace& high = places[i + 1];
    Vec3 local;
    local[axis] = low.middle + 0.5 * low.size - 0.5 * length;
    const double by = toNearestPlane(planes, place, axis, local, reach);
    if (by == 0 || low.size + by <= kSeamOverlap || high.size - by <= kSeamOverlap) continue;
    low.middle += 0.5 * by;
    low.size += by;
    high.middle += 0.5 * by;
    high.size -= by;
  }
}

}  // namespace

void runSnap(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const int axis = static_cast<int>(s.extra);
  const double distance = c.evaluator.real(s.expr, env),
               first = s.amount == kNoId ? 0.0 : c.evaluator.real(s.amount, env);
  if (c.budget.failed()) return;
  Env inner = env;
  SnapPlanes planes;
  if (kSnapRange.holds(distance)) {
    Vec3 along, low;
    along[axis] = 1;
    low[axis] = first - 0.5 * env.scope[axis];
    planes.normal = env.place.direction(along);
    planes.first = dot(env.place.toCell(low), planes.normal);
    planes.distance = distance * env.place.scale;
    planes.outer = env.snaps;
    inner.snaps = &planes;
  } else {
    c.budget.note(std::string(kSnapRange.rule).append(", ").append(kSnapRange.example).append("; these are left out"),
                  s.span, env.activation);
  }
  runStatement(s.body, c, inner, out);
}

void runPart(const StmtNode& s, uint32_t index, uint64_t number, const Placement& place, Vec3 scope, CellContext& c,
             const Env& env, ShapeList& out) {
  if (!c.budget.step(1, s.span, env.activation)) return;
  Env inner = env;
  inner.cut_detail = 0;
  inner.place = place;
  inner.scope = scope;
  inner.key = env.key.child(kLoopSalt + s.ordinal, number);
  ShapeList own;
  runStatement(c.program.idAt(s.children, index), c, inner, own);
  out.insert(out.end(), own.begin(), own.end());
}

void runSplit(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const int axis = static_cast<int>(s.extra);
  const double length = env.scope[axis];
  if (!(length > 0) || !std::isfinite(length)) {
    const std::string letter(1, "xyz"[axis]);
    c.budget.note(
        "this scope has no size along " + letter + ", so it is not split: give it one, such as size(" + letter + " 3m)",
        s.span, env.activation);
    return;
  }
  std::vector<SplitSize> sizes;
  double group = 0;
  const PartNode* repeated = nullptr;
  for (uint32_t i = 0; i < s.parts.count && !c.budget.failed(); ++i) {
    const PartNode& node = c.program.ast.parts[s.parts.first + i];
    double size = c.evaluator.real(node.size, env) * (node.relative ? length : 1);
    if (!(size >= 0) || !std::isfinite(size)) {
      c.budget.note("the size of a part is 0m or more, such as 2m; this one is left out", node.span, env.activation);
      size = 0;
    }
    sizes.push_back({size, node.flexible, node.repeated});
    if (!node.repeated) continue;
    group += size;
    repeated = &node;
  }
  if (c.budget.failed()) return;
  if (repeated != nullptr && !(group > 0))
    c.budget.note("the parts that are repeated have no size; they are left out: give one of them a size, such as 2m",
                  repeated->group, env.activation);
  SplitLayout layout = layOut(length, sizes, static_cast<size_t>(kMaxParts));
  if (layout.too_many)
    return c.budget.fail("one split has more than a million parts (give them a larger size)", s.span, env.activation);
  if (layout.cut_off)
    c.budget.note("the parts are longer than the scope; the rest is cut off: write a size that may shrink as ~2m",
                  s.span, env.activation);
  if (s.amount != kNoId) {
    const double reach = c.evaluator.real(s.amount, env);
    if (kSnapReachRange.holds(reach))
      snapLines(layout.places, length, env.snaps, env.place, axis, reach);
    else if (!c.budget.failed())
      c.budget.note(
          std::string(kSnapReachRange.rule).append(", ").append(kSnapReachRange.example).append("; none snap here"),
          c.program.expr(s.amount).span, env.activation);
  }
  for (const SplitPlace& place : layout.places) {
    const double low = std::max(0.0, place.middle - 0.5 * place.size);
    const double rest = std::max(0.0, length - place.middle - 0.5 * place.size);
    const double below = std::min(low, kSeamOverlap);
    // Each part overlaps its neighbours, so the scope of a part is longer than its place by up to two overlaps. If the
    // rigid parts of a nested split are sized for the place alone, they leave such a gap at the end of the scope; the
    // last part is then extended to fill it.
    const bool last = &place == &layout.places.back();
    const double above = !last ? std::min(rest, kSeamOverlap) : rest <= 2 * kSeamOverlap ? rest : 0;
    Vec3 at, scope = env.scope;
    at[axis] = place.middle + 0.5 * (above - below) - 0.5 * length;
    scope[axis] = place.size + below + above;
    runPart(s, place.part, uint64_t{place.repetition} << 32 | place.part, env.place.moved(at), scope, c, env, out);
    if (c.budget.failed()) return;
  }
}

void runComp(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const PartNode* parts = c.program.ast.parts.data() + s.parts.first;
  const Vec3 edges = env.scope;
  const auto named = [&](BoxPart of) {
    return std::any_of(parts, parts + s.parts.count, [&](const PartNode& p) { return p.of == of; });
  };
  for (uint32_t i = 0; i < s.parts.count && !c.budget.failed(); ++i) {
    const BoxPart of = parts[i].of;
    if (of == BoxPart::inside) {
      runPart(s, i, static_cast<uint64_t>(of), env.place, edges, c, env, out);
      continue;
    }
    for (size_t f = 0; f < std::size(kFaces) && !c.budget.failed(); ++f) {
      const Face& face = kFaces[f];
      const bool edge = of == BoxPart::edges && f < kSides;
      if (!edge && of != face.part && !(of == BoxPart::side && f < kSides && !named(face.part))) continue;
      const double width = edges[face.width], height = edges[face.height];
      if (!(height > 0) || (!edge && !(width > 0))) {
        c.budget.note(
            "this part of the scope's box has no size; it is left out: give the box one, such as size(4m, 3m, 4m)",
            parts[i].span, env.activation);
        continue;
      }
      const Placement place = facePlace(face, env.place, edges);
      // The key depends only on the face, so that adding further faces to the `comp` does not change the content of
      // this face.
      const uint64_t number = static_cast<uint64_t>(face.part);
      if (edge)
        runPart(s, i, number + 16, place.moved({0.5 * width, 0, 0}), {0, height, 0}, c, env, out);
      else
        runPart(s, i, number, place, {width, height, 0}, c, env, out);
    }
  }
}

}  // namespace sgm::interpret
