#include "derive/layout/floor_plan.h"

#include <algorithm>
#include <bit>
#include <unordered_set>

#include "derive/layout/plan_rects.h"
#include "derive/layout/wall_graph.h"

namespace sgm {
namespace {

/// A candidate layout: the rooms' open space, after a corridor is carved along some of the walls.
struct Carving {
  std::vector<Rects> rooms;
  Rects corridor;
  /// for each corridor rectangle: number of the connected part of the corridor that contains it
  std::vector<size_t> part;
  /// False if the corridor divides a room or leaves the room narrower than a door. That room is then the last in
  /// `rooms`.
  bool sound = true;
};

struct Access {
  std::vector<PlanDoor> doors;
  std::vector<bool> reached;
  size_t count = 0;  ///< number of rooms that can be reached
};

class FloorLayout {
 public:
  FloorLayout(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
              uint64_t max_work)
      : sizes_(sizes), links_(links), work_{max_work} {
    const int32_t x = sizes.x / 2 / kPlanStep * kPlanStep, z = sizes.z / 2 / kPlanStep * kPlanStep,
                  half = sizes.wall / 2;
    floor_ = {-x, -z, x, z};
    middle_ = grown(floor_, -half);
    if (middle_.width() <= 0 || middle_.depth() <= 0) return;
    cells_ = linkedRooms(middle_, areas, links, sizes.wall, kPlanStep, work_);
    // Mirrors the treemap in z, so that the largest rooms are in front (+z).
    for (PlanRect& cell : cells_) cell = {cell.x0, -cell.z1, cell.x1, -cell.z0};
    graph_ = wallGraph(middle_, cells_);
    near_ = roomsNearCorners();
  }

  FloorPlan run() {
    FloorPlan plan;
    std::vector<bool> walls(graph_.edges.size(), false);
    Carving carving = carved(walls);
    for (const Rects& room : carving.rooms)
      if (room.empty() || std::min(room[0].width(), room[0].depth()) < 2 * kDoorReachUnits) return plan;
    if (carving.rooms.empty()) return plan;
    plan.fits = true;
    while (entered_ < cells_.size() && !hasEntrance(carving)) ++entered_;
    Access access = connected(carving, false);
    while (access.count < cells_.size() && extend(walls, carving, access)) continue;
    if (work_.spent()) return plan;
    access = connected(carving, true);
    finish(plan, carving, access);
    return plan;
  }

  uint64_t work() const { return work_.done; }

 private:
  Carving carved(const std::vector<bool>& walls) const {
    Carving out;
    corridor(walls, out);
    for (const PlanRect& cell : cells_) {
      const PlanRect clear = grown(cell, -sizes_.wall / 2);
      Rects room;
      if (clear.width() > 0 && clear.depth() > 0) room.push_back(clear);
      for (const PlanRect& strip : out.corridor) takeAway(room, grown(strip, sizes_.wall));
      std::stable_sort(room.begin(), room.end(), [](const PlanRect& a, const PlanRect& b) {
        return int64_t{a.width()} * a.depth() > int64_t{b.width()} * b.depth();
      });
      const bool untouched = room.size() == 1 && room[0] == clear;
      out.sound = untouched || keepWalkable(room, sizes_.door);
      out.rooms.push_back(std::move(room));
      if (!out.sound) break;
    }
    return out;
  }

  /// Adds corridor strips along walls. Where two of these walls meet, their strips overlap; at a free end, a strip
  /// stops at the face of the wall that it runs into.
  void corridor(const std::vector<bool>& walls, Carving& out) const {
    std::vector<int> degree(graph_.corners.size(), 0);
    for (size_t e = 0; e < walls.size(); ++e) {
      if (!walls[e]) continue;
      ++degree[graph_.edges[e].from];
      ++degree[graph_.edges[e].to];
    }
    const int32_t half = sizes_.corridor / 2;
    for (size_t e = 0; e < walls.size(); ++e) {
      if (!walls[e]) continue;
      const WallGraph::Edge& edge = graph_.edges[e];
      const WallGraph::Corner& a = graph_.corners[edge.from];
      const WallGraph::Corner& b = graph_.corners[edge.to];
      const int32_t before = degree[edge.from] > 1 ? half : -sizes_.wall / 2;
      const int32_t after = degree[edge.to] > 1 ? half : -sizes_.wall / 2;
      PlanRect strip = edge.along_x ? PlanRect{a.x - before, a.z - half, b.x + after, b.z + half}
                                    : PlanRect{a.x - half, a.z - before, b.x + half, b.z + after};
      strip = common(strip, grown(middle_, -sizes_.wall / 2));
      if (!admits(strip, sizes_.door)) continue;
      out.part.push_back(out.corridor.size());
      out.corridor.push_back(strip);
      for (size_t i = 0; i + 1 < out.corridor.size(); ++i) {
        if (!admits(common(out.corridor[i], strip), sizes_.door)) continue;
        const size_t one = out.part.back(), other = out.part[i];
        std::replace(out.part.begin(), out.part.end(), std::max(one, other), std::min(one, other));
      }
    }
  }

  bool hasEntrance(const Carving& carving) const {
    const std::vector<PlanFacade> facades = facadesOf(carving, entered_);
    return std::any_of(facades.begin(), facades.end(),
                       [&](const PlanFacade& f) { return f.high - f.low >= sizes_.door; });
  }

  /// Places doors, and finds the rooms that they reach. through: allows doors from any room to rooms that are not
  /// reached otherwise.
  Access connected(const Carving& carving, bool through) const {
    const size_t rooms = cells_.size(), first = entered_ < rooms ? entered_ : 0;
    Access out;
    out.reached.assign(rooms, false);
    const auto door = [&](const Rects& a, const Rects& b, int32_t width, size_t room, size_t to, size_t link) {
      const auto hole = holeBetween(a, b, sizes_.wall, width);
      if (hole) out.doors.push_back({*hole, room, to, link});
      return hole.has_value();
    };
    for (size_t l = 0; l < links_.size(); ++l)
      door(carving.rooms[links_[l].a], carving.rooms[links_[l].b], links_[l].width, links_[l].a, links_[l].b, l);
    const auto reach = [&](size_t room) {
      std::vector<size_t> open{room};
      while (!open.empty()) {
        const size_t r = open.back();
        open.pop_back();
        if (out.reached[r]) continue;
        out.reached[r] = true;
        ++out.count;
        for (const PlanDoor& d : out.doors)
          if (d.to < rooms && (d.from == r || d.to == r)) open.push_back(d.from == r ? d.to : d.from);
      }
    };
    reach(first);
    const auto reachFrom = [&](size_t source) {
      for (size_t room = 0; room < rooms; ++room)
        if (!out.reached[room] &&
            door(carving.rooms[source], carving.rooms[room], sizes_.door, source, room, PlanDoor::kNoLink))
          reach(room);
    };
    reachFrom(first);
    for (size_t p = 0; p < carving.corridor.size(); ++p) {
      if (carving.part[p] != p) continue;
      Rects strips;
      for (size_t i = p; i < carving.corridor.size(); ++i)
        if (carving.part[i] == p) strips.push_back(carving.corridor[i]);
      if (!door(carving.rooms[first], strips, sizes_.door, first, PlanDoor::kCorridor, PlanDoor::kNoLink)) continue;
      for (size_t room = 0; room < rooms; ++room)
        if (!out.reached[room] &&
            door(carving.rooms[room], strips, sizes_.door, room, PlanDoor::kCorridor, PlanDoor::kNoLink))
          reach(room);
    }
    for (size_t before = 0; through && before != out.count;) {
      before = out.count;
      for (size_t room = 0; room < rooms; ++room)
        if (out.reached[room]) reachFrom(room);
    }
    return out;
  }

  static size_t linksMet(const Access& access) {
    return static_cast<size_t>(std::count_if(access.doors.begin(), access.doors.end(),
                                             [](const PlanDoor& d) { return d.link != PlanDoor::kNoLink; }));
  }

  /// A possible extension of the corridor. most: upper bound of its gain, the number of additional rooms reached per
  /// length of corridor.
  struct Candidate {
    double most = 0;
    double length = 0;
    std::vector<bool> walls;
  };

  /// Returns all shortest paths that may reach further rooms, in descending order of Candidate::most.
  std::vector<Candidate> candidates(const std::vector<bool>& walls, const Access& access) const {
    const WallPaths paths(graph_, walls);
    std::vector<Candidate> out;
    for (size_t from = 0; from < graph_.corners.size(); ++from) {
      for (size_t to = from + 1; to < graph_.corners.size(); ++to) {
        Candidate one{0, static_cast<double>(paths.length(from, to) + sizes_.corridor), walls};
        if (!paths.walk(from, to, one.walls) || one.walls == walls) continue;
        uint64_t near = 0;
        for (size_t e = 0; e < one.walls.size(); ++e)
          if (one.walls[e] && !walls[e]) near |= near_[graph_.edges[e].from] | near_[graph_.edges[e].to];
        for (size_t room = 0; room < cells_.size(); ++room)
          if (access.reached[room]) near &= ~(uint64_t{1} << room);
        one.most = static_cast<double>(std::popcount(near)) / one.length;
        if (near != 0) out.push_back(std::move(one));
      }
    }
    std::stable_sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.most > b.most; });
    return out;
  }

  /// Returns, for each corner of the wall graph, a bit set of rooms: the rooms that touch the corner, and all rooms
  /// that are joined to these by the links of the treemap, directly or through other rooms.
  std::vector<uint64_t> roomsNearCorners() const {
    std::vector<uint64_t> beyond(cells_.size());
    for (size_t room = 0; room < beyond.size(); ++room) beyond[room] = uint64_t{1} << room;
    for (size_t round = 0; round < beyond.size(); ++round)
      for (const RoomLink& link : links_) beyond[link.a] = beyond[link.b] = beyond[link.a] | beyond[link.b];
    std::vector<uint64_t> near(graph_.corners.size(), 0);
    for (size_t c = 0; c < near.size(); ++c)
      for (size_t room = 0; room < cells_.size(); ++room) {
        const WallGraph::Corner& at = graph_.corners[c];
        const PlanRect& r = cells_[room];
        if (at.x >= r.x0 && at.x <= r.x1 && at.z >= r.z0 && at.z <= r.z1) near[c] |= beyond[room];
      }
    return near;
  }

  /// The best candidate so far. Candidates are visited in descending order of their upper bound Candidate::most.
  struct Best {
    double gain = 0;
    bool found = false;  ///< true: the best candidate is known, since no other can have a larger gain
    std::vector<bool> walls;

    bool takes(double other) const { return !found && other > gain; }
  };

  /// Extends the corridor by the path that reaches the largest number of further rooms per length. Prefers paths that
  /// keep all doors requested by links. If every path removes such a door, accepts that: without a corridor, rooms
  /// could be reached only through other rooms.
  bool extend(std::vector<bool>& walls, Carving& carving, Access& access) {
    Best keeping, any;
    const size_t corners = graph_.corners.size();
    work_.done += corners * corners * (1 + corners / 256);
    std::unordered_set<std::vector<bool>> seen;
    for (Candidate& one : candidates(walls, access)) {
      keeping.found = keeping.found || one.most <= keeping.gain;
      any.found = any.found || one.most <= any.gain;
      if (keeping.found) break;
      // Paths that differ only within the existing corridor add the same new walls, so only the first of them is tried.
      if (!seen.insert(one.walls).second) continue;
      Carving with = carved(one.walls);
      work_.done += cells_.size() + with.corridor.size();
      if (work_.spent()) return false;
      if (!with.sound || (entered_ < cells_.size() && !hasEntrance(with))) continue;
      Access then = connected(with, false);
      if (then.count <= access.count) continue;
      const double gain = static_cast<double>(then.count - access.count) / one.length;
      if (any.takes(gain)) any.gain = gain, any.walls = one.walls;
      if (keeping.takes(gain) && linksMet(then) >= linksMet(access)) keeping.gain = gain, keeping.walls = one.walls;
    }
    Best& best = keeping.gain > 0 ? keeping : any;
    if (!(best.gain > 0)) return false;
    walls = std::move(best.walls);
    carving = carved(walls);
    access = connected(carving, false);
    return true;
  }

  /// Returns the stretches of the building's outer walls that adjoin the open space of a room.
  std::vector<PlanFacade> facadesOf(const Carving& carving, size_t room) const {
    const PlanRect inner = grown(middle_, -sizes_.wall / 2);
    std::vector<PlanFacade> out;
    for (int side = 0; side < 4; ++side) {
      std::vector<PlanFacade> some;
      for (const PlanRect& r : carving.rooms[room]) {
        const bool outer[] = {r.z1 == inner.z1, r.x1 == inner.x1, r.z0 == inner.z0, r.x0 == inner.x0};
        if (outer[side]) some.push_back({room, side, side % 2 == 0 ? r.x0 : r.z0, side % 2 == 0 ? r.x1 : r.z1});
      }
      std::sort(some.begin(), some.end(), [](const PlanFacade& a, const PlanFacade& b) { return a.low < b.low; });
      for (const PlanFacade& f : some) {
        if (!out.empty() && out.back().side == side && f.low <= out.back().high)
          out.back().high = std::max(out.back().high, f.high);
        else
          out.push_back(f);
      }
    }
    return out;
  }

  void finish(FloorPlan& plan, const Carving& carving, const Access& access) const {
    for (size_t room = 0; room < cells_.size(); ++room) {
      plan.rooms.push_back({cells_[room], carving.rooms[room]});
      if (!access.reached[room]) plan.closed.push_back(room);
      for (const PlanFacade& f : facadesOf(carving, room)) plan.facades.push_back(f);
    }
    plan.corridor = carving.corridor;
    for (size_t i = 0; i < plan.facades.size(); ++i) {
      const PlanFacade f = plan.facades[i];
      if (f.room != entered_ || f.high - f.low < sizes_.door) continue;
      const int32_t low = f.low + (f.high - f.low - sizes_.door) / 2 / kPlanStep * kPlanStep, high = low + sizes_.door;
      const int32_t sign = f.side < 2 ? 1 : -1, outer = f.side % 2 == 0 ? floor_.z1 : floor_.x1;
      const int32_t a = sign * (outer + kDoorReachUnits), b = sign * (outer - sizes_.wall - kDoorReachUnits);
      const PlanRect hole = f.side % 2 == 0 ? PlanRect{low, std::min(a, b), high, std::max(a, b)}
                                            : PlanRect{std::min(a, b), low, std::max(a, b), high};
      plan.doors.push_back({hole, PlanDoor::kOutside, f.room, PlanDoor::kNoLink});
      // The entrance splits its facade into two: the stretches on both sides of the entrance.
      plan.facades[i].high = low - sizes_.wall;
      plan.facades.insert(plan.facades.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                          {f.room, f.side, high + sizes_.wall, f.high});
      break;
    }
    std::erase_if(plan.facades, [](const PlanFacade& f) { return f.high <= f.low; });
    for (size_t l = 0; l < links_.size(); ++l)
      if (std::none_of(access.doors.begin(), access.doors.end(), [&](const PlanDoor& d) { return d.link == l; }))
        plan.unmet.push_back(l);
    plan.doors.insert(plan.doors.end(), access.doors.begin(), access.doors.end());
  }

  FloorPlanSizes sizes_;
  std::span<const RoomLink> links_;
  /// outlines of the floor: floor_ at the outer faces of the outer walls, middle_ at their centre lines
  PlanRect floor_, middle_;
  std::vector<PlanRect> cells_;
  WallGraph graph_;
  std::vector<uint64_t> near_;  ///< see roomsNearCorners()
  PlanWork work_;
  /// index of the room with the entrance; the number of rooms if no room has a wall that is wide enough for the
  /// entrance
  size_t entered_ = 0;
};

}  // namespace

FloorPlan layOutFloor(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                      uint64_t max_work) {
  FloorLayout layout(sizes, areas, links, max_work);
  FloorPlan plan = layout.run();
  plan.work = layout.work();
  return plan;
}

}  // namespace sgm
