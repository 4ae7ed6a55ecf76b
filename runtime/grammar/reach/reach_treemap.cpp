// Extents of treemaps: the possible places of rooms, corridors, doors and facades. See derive/layout/floor_plan.h and
// derive/interpret/rooms.cpp.

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/math.h"
#include "grammar/range/reach_shapes.h"
#include "grammar/reach/kept_scope.h"
#include "grammar/reach/reach_statements.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::reach {

namespace {

/// Upper bound of the number of rectangles that rooms and corridors consist of, and of the number of doors.
constexpr double kMaxBoxes = 1024;
/// Number of pieces into which a range of room edges is divided. Small rooms may lie farther out than large ones, so
/// each piece has a tighter bound than the whole range.
constexpr int kRoomPieces = 2;

/// Returns the extent of a child whose scope may lie anywhere in a box with these edges, along x and z.
Extent boundRoom(StmtId child, const IntervalVector& edges, RangeFrame& frame, ReachContext& context) {
  const auto bounded = [&](size_t axis) { return edges[axis].hi > 0 && std::isfinite(edges[axis].hi); };
  const int x_pieces = bounded(0) ? kRoomPieces : 1, z_pieces = bounded(2) ? kRoomPieces : 1;
  std::optional<Extent> out;
  for (int x = 0; x < x_pieces; ++x) {
    for (int z = 0; z < z_pieces; ++z) {
      const KeptScope kept(frame);
      IntervalVector by{};
      frame.scope[1] = edges[1];
      for (const auto& [axis, piece, pieces] :
           {std::tuple{size_t{0}, x, x_pieces}, std::tuple{size_t{2}, z, z_pieces}}) {
        const double step = edges[axis].hi / pieces;
        frame.scope[axis] = pieces == 1 ? Interval{0, edges[axis].hi} : Interval{piece * step, (piece + 1) * step};
        const double off = 0.5 * (edges[axis].hi - frame.scope[axis].lo);
        by[axis] = std::isfinite(off) ? Interval{-off, off} : Interval::everything();
      }
      frame.place.move(by);
      context.values.misfits().enterLoose();
      Extent e = boundStatement(child, frame, context);
      context.values.misfits().leaveLoose();
      e.move(by);
      addAlternative(out, e);
    }
  }
  return *out;
}

/// Returns the extent of a child at the outer walls of a room that may lie anywhere in a box with these edges.
Extent boundFacade(StmtId child, const IntervalVector& edges, RangeFrame& frame, ReachContext& context) {
  Extent out = Extent::nothing();
  for (int side = 0; side < 4; ++side) {
    const KeptScope kept(frame);
    const size_t depth = side % 2 == 0 ? 2 : 0;
    IntervalVector by{};
    by[depth] = edges[depth] * Interval::exactly(side < 2 ? 0.5 : -0.5);
    frame.place.move(by);
    frame.place.turned = frame.place.turned || side != 0;
    Extent e = boundRoom(child, {edges[2 - depth], edges[1], Interval{}}, frame, context);
    if (side != 0) e.rotate(1, Interval::exactly(side * (kPi / 2)));
    e.move(by);
    out.join(e);
  }
  return out;
}

}  // namespace

Extent boundTreemap(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const TreemapNode& node = context.program.ast.treemaps[s.extra];
  for (const ExprId id : {node.wall, node.door, node.height, node.corridor})
    if (id != kNoId) context.values.number(id, frame);  // the value is evaluated only to record the queries in it
  const IntervalVector edges = {atLeastZero(frame.scope[0]), atLeastZero(frame.scope[1]), atLeastZero(frame.scope[2])};
  const Interval reach = Interval::exactly(2 * kDoorReach);
  Extent out = solidIn({edges[0] + reach, edges[1], edges[2] + reach});
  out.repeat({0, kMaxBoxes});
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = context.program.ast.parts[s.parts.first + i];
    const StmtId child = context.program.idAt(s.children, i);
    Extent one = Extent::nothing();
    switch (part.floor) {
      case FloorPart::link: {
        const LinkNode& link = context.program.ast.links[context.program.stmt(child).extra];
        for (const ExprId id : {link.width, link.height})
          if (id != kNoId) context.values.number(id, frame);
        continue;
      }
      case FloorPart::room:
        context.values.number(part.size, frame);
        [[fallthrough]];
      case FloorPart::corridor:
        one = boundRoom(child, edges, frame, context);
        break;
      case FloorPart::facade:
        one = boundFacade(child, edges, frame, context);
        break;
    }
    one.certain = false;
    one.repeat({0, part.floor == FloorPart::room ? 1 : kMaxBoxes});
    out.join(one);
  }
  return out;
}

}  // namespace sgm::reach
