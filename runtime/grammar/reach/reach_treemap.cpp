// The possible places of a treemap's rooms, corridors, doors and facades; see derive/layout/floor_plan.h and
// derive/interpret/rooms.cpp.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/range/reach_shapes.h"
#include "grammar/reach/reach_check.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm {

namespace {

/// Limit for rectangles of rooms and corridors, and doors.
constexpr double kMostBoxes = 1024;
/// Pieces of a range of edges: a small room lies farther out than a large one.
constexpr int kRoomPieces = 2;

Interval notNegative(Interval v) { return {std::max(0.0, v.lo), std::max(0.0, v.hi)}; }

}  // namespace

/// The content of a scope that lies anywhere in a box of these edges, along x and z.
Extent ReachCheck::inPieces(StmtId child, const IntervalVector& edges, RangeFrame& frame) {
  const IntervalVector scope = frame.scope;
  const PlaceRange place = frame.place;
  const auto bounded = [&](size_t axis) { return edges[axis].hi > 0 && std::isfinite(edges[axis].hi); };
  const int x_pieces = bounded(0) ? kRoomPieces : 1, z_pieces = bounded(2) ? kRoomPieces : 1;
  Extent out = Extent::nothing();
  bool first = true;
  for (int x = 0; x < x_pieces; ++x) {
    for (int z = 0; z < z_pieces; ++z) {
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
      values_.misfits().enterLoose();
      Extent e = body(child, frame);
      values_.misfits().leaveLoose();
      frame.scope = scope;
      frame.place = place;
      e.move(by);
      if (first)
        out = e;
      else
        out.either(e);
      first = false;
    }
  }
  return out;
}

Extent ReachCheck::treemap(const StmtNode& s, RangeFrame& frame) {
  const TreemapNode& node = program_.ast.treemaps[s.extra];
  for (const ExprId id : {node.wall, node.door, node.height, node.corridor})
    if (id != kNoId) values_.number(id, frame);  // a query in it
  const IntervalVector written = frame.scope;
  const IntervalVector edges = {notNegative(written[0]), notNegative(written[1]), notNegative(written[2])};
  const Interval reach = Interval::exactly(2 * kDoorReach);
  Extent out = solidIn({edges[0] + reach, edges[1], edges[2] + reach});
  out.repeat({0, kMostBoxes});
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = program_.ast.parts[s.parts.first + i];
    const StmtId child = program_.idAt(s.children, i);
    Extent one = Extent::nothing();
    switch (part.floor) {
      case FloorPart::link: {
        const LinkNode& link = program_.ast.links[program_.stmt(child).extra];
        for (const ExprId id : {link.width, link.height})
          if (id != kNoId) values_.number(id, frame);
        continue;
      }
      case FloorPart::room:
        values_.number(part.size, frame);
        [[fallthrough]];
      case FloorPart::corridor:
        one = inPieces(child, edges, frame);
        break;
      case FloorPart::facade:
        for (int side = 0; side < 4; ++side) {
          const size_t depth = side % 2 == 0 ? 2 : 0;
          const PlaceRange place = frame.place;
          IntervalVector by{};
          by[depth] = edges[depth] * Interval::exactly(side < 2 ? 0.5 : -0.5);
          frame.place.move(by);
          frame.place.turned = frame.place.turned || side != 0;
          Extent e = inPieces(child, {edges[2 - depth], edges[1], Interval{}}, frame);
          frame.place = place;
          if (side != 0) e.rotate(1, Interval::exactly(side * (kPi / 2)));
          e.move(by);
          one.join(e);
        }
        break;
    }
    one.certain = false;
    one.repeat({0, part.floor == FloorPart::room ? 1 : kMostBoxes});
    out.join(one);
  }
  frame.scope = written;
  return out;
}

}  // namespace sgm
