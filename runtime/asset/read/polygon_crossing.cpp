#include "asset/read/polygon_crossing.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <vector>

#include "asset/exact_sign.h"

namespace sgm::asset {

namespace {

class CrossingSweep {
 public:
  CrossingSweep(std::span<const Point> polygon, int drop)
      : points_(polygon), drop_(drop), status_(Order{*this}), place_(polygon.size(), status_.end()) {}

  bool run() {
    std::vector<uint32_t> order(points_.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return isBefore(a, b); });
    for (size_t first = 0, last = 0; first < order.size(); first = last) {
      while (last < order.size() && !isBefore(order[first], order[last])) ++last;
      // Remove the edges that end at this point before inserting the edges that begin at it.
      const auto here = std::span(order).subspan(first, last - first);
      for (const uint32_t corner : here)
        for (const uint32_t edge : {corner, previous(corner)})
          if (isEdge(edge) && end(edge) == corner && removal(edge)) return true;
      for (const uint32_t corner : here)
        if (passesThrough(corner)) return true;
      for (const uint32_t corner : here)
        for (const uint32_t edge : {corner, previous(corner)})
          if (isEdge(edge) && begin(edge) == corner && insertion(edge)) return true;
    }
    return false;
  }

 private:
  struct Corner {
    uint32_t number;
  };
  /// Orders non-crossing edges by their position along the sweep line, from bottom to top.
  struct Order {
    using is_transparent = void;
    const CrossingSweep& sweep;

    bool operator()(uint32_t e, uint32_t f) const {
      if (e == f) return false;
      const bool turned = sweep.isBefore(sweep.begin(f), sweep.begin(e));
      const uint32_t older = turned ? f : e, younger = turned ? e : f;
      int side = sweep.side(older, sweep.begin(younger));
      if (side == 0) side = sweep.side(older, sweep.end(younger));
      if (side == 0) return e < f;
      return (side > 0) != turned;
    }
    bool operator()(uint32_t e, Corner c) const { return sweep.side(e, c.number) > 0; }
    bool operator()(Corner c, uint32_t e) const { return sweep.side(e, c.number) < 0; }
  };

  uint32_t next(uint32_t corner) const { return corner + 1 == points_.size() ? 0 : corner + 1; }
  uint32_t previous(uint32_t corner) const {
    return corner == 0 ? static_cast<uint32_t>(points_.size() - 1) : corner - 1;
  }
  double u(uint32_t corner) const { return points_[corner][(drop_ + 1) % 3]; }
  double v(uint32_t corner) const { return points_[corner][(drop_ + 2) % 3]; }
  bool isBefore(uint32_t a, uint32_t b) const { return u(a) != u(b) ? u(a) < u(b) : v(a) < v(b); }
  /// Returns the end of an edge that the sweep line reaches first. Edge i leads from corner i of the polygon to the
  /// next corner.
  uint32_t begin(uint32_t edge) const { return isBefore(next(edge), edge) ? next(edge) : edge; }
  uint32_t end(uint32_t edge) const { return isBefore(next(edge), edge) ? edge : next(edge); }
  bool isEdge(uint32_t edge) const { return isBefore(edge, next(edge)) || isBefore(next(edge), edge); }
  /// Returns 1 if the corner lies above the edge (left of its direction), 0 if on it, -1 if below.
  int side(uint32_t edge, uint32_t corner) const {
    return orientationAlong(drop_, points_[begin(edge)], points_[end(edge)], points_[corner]);
  }
  bool cross(uint32_t e, uint32_t f) const {
    return side(e, begin(f)) * side(e, end(f)) < 0 && side(f, begin(e)) * side(f, end(e)) < 0;
  }

  bool removal(uint32_t edge) {
    const auto at = place_[edge];
    const auto above = std::next(at);
    const bool found = at != status_.begin() && above != status_.end() && cross(*std::prev(at), *above);
    status_.erase(at);
    return found;
  }
  bool insertion(uint32_t edge) {
    const auto at = place_[edge] = status_.insert(edge).first;
    const auto above = std::next(at);
    return (at != status_.begin() && cross(*std::prev(at), edge)) || (above != status_.end() && cross(edge, *above));
  }
  /// True if the corner lies on another edge, and its neighbouring corners lie on opposite sides of that edge.
  bool passesThrough(uint32_t corner) const {
    for (auto at = status_.lower_bound(Corner{corner}); at != status_.end() && side(*at, corner) == 0; ++at)
      if (side(*at, previous(corner)) * side(*at, next(corner)) < 0) return true;
    return false;
  }

  std::span<const Point> points_;
  int drop_;
  std::set<uint32_t, Order> status_;
  std::vector<std::set<uint32_t, Order>::iterator> place_;
};

}  // namespace

bool crossesItself(std::span<const Point> polygon, int drop) { return CrossingSweep(polygon, drop).run(); }

}  // namespace sgm::asset
