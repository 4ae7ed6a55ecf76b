// Extents of wfc: the possible places of tiles. See derive/interpret/tiles.cpp.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/kept_scope.h"
#include "grammar/reach/reach_statements.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::reach {

namespace {

/// Returns the number of places for tiles along an edge: the whole number nearest to edge / wanted, at least 1.
Interval placesIn(Interval edge, Interval wanted) {
  const Interval count = floorOf(edge / wanted + Interval::exactly(0.5));
  return {std::max(1.0, std::isfinite(count.lo) ? count.lo : 1.0), std::max(1.0, count.hi)};
}

/// Returns the edge of a place for a tile: 3/4 to 3/2 of the wanted edge, unless the scope is smaller.
Interval placeEdge(Interval edge, Interval wanted, Interval count) {
  if (count.exact()) return edge / count;
  return {std::min(edge.lo, 0.75 * wanted.lo), std::min(edge.hi, 1.5 * wanted.hi)};
}

/// Returns the extent of a child whose scope has the edges `tile` and may lie anywhere in a box with the edges `edges`.
Extent boundTile(StmtId child, const IntervalVector& edges, const IntervalVector& tile, RangeFrame& frame,
                 ReachContext& context) {
  const KeptScope kept(frame);
  frame.scope = tile;
  IntervalVector by{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double off = 0.5 * (edges[axis].hi - tile[axis].lo);
    by[axis] = std::isfinite(off) ? Interval{-off, off} : Interval::everything();
  }
  frame.place.move(by);
  context.values.misfits().enterLoose();
  Extent e = boundStatement(child, frame, context);
  context.values.misfits().leaveLoose();
  e.move(by);
  return e;
}

}  // namespace

Extent boundWfc(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  IntervalVector wanted{};
  if (context.program.expr(s.expr).type.kind == ValueKind::vector)
    wanted = context.values.vector(s.expr, frame);
  else
    wanted.fill(context.values.number(s.expr, frame));
  IntervalVector edges{}, place{};
  double places = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    // Derivation leaves out tiles with an edge below kTileRange.low.
    wanted[axis] = maximum(wanted[axis], Interval::exactly(kTileRange.low));
    edges[axis] = atLeastZero(frame.scope[axis]);
    const Interval count = placesIn(edges[axis], wanted[axis]);
    place[axis] = placeEdge(edges[axis], wanted[axis], count);
    place[axis].hi = std::min(place[axis].hi + 2 * kSeamOverlap, edges[axis].hi);
    places *= count.hi;
  }
  Extent out = Extent::nothing();
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = context.program.ast.parts[s.parts.first + i];
    if (part.label == kNoId) continue;
    // The value of the weight is not needed, but its evaluation records the queries in it.
    context.values.number(part.size, frame);
    const StmtId child = context.program.idAt(s.children, i);
    std::optional<Extent> one;
    const int turns = context.program.ast.tiles[part.tile].turns ? 4 : 1;
    for (int turn = 0; turn < turns; ++turn) {
      // The scope is expressed in the tile's own axes: for an odd number of quarter turns, its x and z edges are
      // swapped.
      const bool across = turn % 2 != 0;
      const auto own = [&](const IntervalVector& v) { return across ? IntervalVector{v[2], v[1], v[0]} : v; };
      const bool turned = frame.place.turned;
      frame.place.turned = turned || turn != 0;
      Extent e = boundTile(child, own(edges), own(place), frame, context);
      frame.place.turned = turned;
      if (turn != 0) e.rotate(1, Interval::exactly(turn * (kPi / 2)));
      addAlternative(one, e);
    }
    one->certain = false;
    one->repeat({0, std::min(places, kMaxPlaces)});
    out.join(*one);
  }
  return out;
}

}  // namespace sgm::reach
