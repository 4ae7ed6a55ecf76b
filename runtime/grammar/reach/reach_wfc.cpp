// The possible places of tiles; see derive/interpret/tiles.cpp.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/reach_check.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm {

namespace {

Interval notUnderZero(Interval v) { return {std::max(0.0, v.lo), std::max(0.0, v.hi)}; }

/// The number of places along an edge: the whole number nearest to edge / wanted, but at least one.
Interval placesIn(Interval edge, Interval wanted) {
  const Interval count = floorOf(edge / wanted + Interval::exactly(0.5));
  return {std::max(1.0, std::isfinite(count.lo) ? count.lo : 1.0), std::max(1.0, count.hi)};
}

/// The edge of such a place: 3/4 to 3/2 of the wanted one, unless the scope is smaller.
Interval placeEdge(Interval edge, Interval wanted, Interval count) {
  if (count.exact()) return edge / count;
  return {std::min(edge.lo, 0.75 * wanted.lo), std::min(edge.hi, 1.5 * wanted.hi)};
}

}  // namespace

/// The content of a box with edges `tile` that lies anywhere in one with edges `edges`.
Extent ReachCheck::tile(StmtId child, const IntervalVector& edges, const IntervalVector& tile, RangeFrame& frame) {
  const IntervalVector written = frame.scope;
  const PlaceRange place = frame.place;
  frame.scope = tile;
  IntervalVector by{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double off = 0.5 * (edges[axis].hi - tile[axis].lo);
    by[axis] = std::isfinite(off) ? Interval{-off, off} : Interval::everything();
  }
  frame.place.move(by);
  values_.misfits().enterLoose();
  Extent e = body(child, frame);
  values_.misfits().leaveLoose();
  frame.scope = written;
  frame.place = place;
  e.move(by);
  return e;
}

Extent ReachCheck::wave(const StmtNode& s, RangeFrame& frame) {
  IntervalVector wanted{};
  if (program_.expr(s.expr).type.kind == ValueKind::vector)
    wanted = values_.vector(s.expr, frame);
  else
    wanted.fill(values_.number(s.expr, frame));
  IntervalVector edges{}, place{};
  double places = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    // Smaller tiles are omitted.
    wanted[axis] = maximum(wanted[axis], Interval::exactly(kTileRange.low));
    edges[axis] = notUnderZero(frame.scope[axis]);
    const Interval count = placesIn(edges[axis], wanted[axis]);
    place[axis] = placeEdge(edges[axis], wanted[axis], count);
    place[axis].hi = std::min(place[axis].hi + 2 * kSeamOverlap, edges[axis].hi);
    places *= count.hi;
  }
  Extent out = Extent::nothing();
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = program_.ast.parts[s.parts.first + i];
    if (part.label == kNoId) continue;
    values_.number(part.size, frame);  // a query in it
    const StmtId child = program_.idAt(s.children, i);
    Extent one = Extent::nothing();
    const int turns = program_.ast.tiles[part.tile].turns ? 4 : 1;
    for (int turn = 0; turn < turns; ++turn) {
      // In the tile's own axes; its surroundings are turned the other way.
      const bool across = turn % 2 != 0;
      const auto own = [&](const IntervalVector& v) { return across ? IntervalVector{v[2], v[1], v[0]} : v; };
      const bool turned = frame.place.turned;
      frame.place.turned = turned || turn != 0;
      Extent e = tile(child, own(edges), own(place), frame);
      frame.place.turned = turned;
      if (turn != 0) e.rotate(1, Interval::exactly(turn * (kPi / 2)));
      if (turn == 0)
        one = e;
      else
        one.either(e);
    }
    one.certain = false;
    one.repeat({0, std::min(places, kMostPlaces)});
    out.join(one);
  }
  return out;
}

}  // namespace sgm
