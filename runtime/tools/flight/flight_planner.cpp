#include "tools/flight/flight_planner.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/hash.h"

namespace sgm::cli {
namespace {

constexpr int64_t kFirstLook = 1'000;  // maximum path cost, in tenths of a step, of the first search for a new place
// Maximum path cost, in tenths of a step, of the last search. If even this search finds only visited places, they are
// accepted.
constexpr int64_t kFarthestLook = 81'000;
constexpr size_t kMaxNodes = 1'000'000;  // maximum number of visited nodes in a search
constexpr int64_t kShortest = 240;       // minimum path cost of a planned piece of path, in tenths of a step
constexpr size_t kWorthIt = 500;         // minimum number of nodes that must be reachable from a starting point
constexpr int kRegion = 16;              // edge of a region, in steps; a region counts as visited as a whole
constexpr int kTries = 40;               // maximum number of attempts to find a far place or a waypoint
constexpr int kGoals = 24;
constexpr int kWays = 8;  // number of paths to each goal that are tried

Metres3 metresOf(Int3 p) { return {metres(p.x), metres(p.y), metres(p.z)}; }

Int3 unitsOf(const Metres3& p) {
  Int3 units;
  for (int axis = 0; axis < 3; ++axis)
    units[axis] = saturate(static_cast<int64_t>(std::floor(p[axis] * kUnitsPerMetre + 0.5)));
  return units;
}

int64_t distanceSquared(Int3 a, Int3 b) {
  int64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t d = (int64_t{a[axis]} - b[axis]) / 16;  // divide, so that the sum of squares cannot overflow
    sum += d * d;
  }
  return sum;
}

Error noRoom(const std::string& what) { return {Code::limit, what + ": give a path with --path"}; }

}  // namespace

FlightPlanner::FlightPlanner(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings)
    : field_(field), grammar_(grammar), settings_(settings) {
  sgm_grammar_domain(grammar, &domain_);
  int32_t edge = 0;
  for (uint32_t i = 0; domain_.infinite != 0 && i < sgm_grammar_layer_count(grammar); ++i) {
    sgm_layer_info layer = SGM_LAYER_INFO_INIT;
    sgm_grammar_layer(grammar, i, &layer);
    edge = std::max({edge, layer.cell_units[0], layer.cell_units[1], layer.cell_units[2]});
  }
  for (int axis = 0; domain_.infinite == 0 && axis < 3; ++axis)
    edge = std::max(edge, saturate((int64_t{domain_.maximum[axis]} - domain_.minimum[axis]) / 4));
  scale_ = std::max(edge, 8 * kUnitsPerMetre);
  if (settings_.room <= 0)
    settings_.room = domain_.solid != 0 ? 0.5 : std::clamp(scale_ / kUnitsPerMetre / 200, 0.5, 4.0);
  grid_ = std::make_unique<VoidGrid>(field, std::max(2, static_cast<int32_t>(2 * settings_.room * kUnitsPerMetre)));
}

double FlightPlanner::spacing() const { return metres(grid_->step()) / 4; }

Result<FlightPlanner> FlightPlanner::begin(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings) {
  std::optional<Error> error;
  AutoFlight narrower = settings;
  // If the caller requires no particular clearance, there is a second attempt, with half of the clearance that the
  // first attempt used.
  for (int attempt = 0; attempt < (settings.room > 0 ? 1 : 2); ++attempt) {
    FlightPlanner planner(field, grammar, narrower);
    const Result<void> settled = planner.settle(unitsOf(settings.near_place), 512 * kUnitsPerMetre);
    if (settled) {
      planner.home_ = planner.grid_->placeOf(planner.node_);
      return planner;
    }
    if (!error) error = settled.error();
    narrower.room = planner.settings_.room / 2;
  }
  return *error;
}

Result<void> FlightPlanner::settle(Int3 near, int32_t reach) {
  way_.reset();
  been_.clear();
  if (domain_.solid == 0) {
    if (Result<void> ok = findSolids(near); !ok) return ok.error();
    near = waypoint(waypoint_);
  }
  const auto settleAt = [&](const std::vector<Int3>& places) {
    for (const Int3 place : places) {
      const std::optional<Int3> node = grid_->nearestClear(grid_->nodeAt(place), domain_.solid != 0 ? 4 : 24);
      if (!node || !leadsOn(*node)) continue;
      node_ = *node;
      return true;
    }
    return false;
  };
  if (settleAt(domain_.solid != 0 ? anchorsNear(near, reach) : std::vector<Int3>{near})) return {};
  // If there is no usable anchor, search for void everywhere. Begin with the nearest places, because each sample
  // requires the derivation of grammar cells.
  for (int32_t half = 32 * kUnitsPerMetre; domain_.solid != 0 && half <= reach; half *= 4) {
    const Result<std::vector<Int3>> found = voidsNear(near, half);
    if (!found) return found.error();
    if (settleAt(*found)) return {};
  }
  if (grid_->error()) return *grid_->error();
  return noRoom(fmt::format("there is no void to fly in, {} m wide, near {:.0f},{:.0f},{:.0f} m", metres(grid_->step()),
                            metres(near.x), metres(near.y), metres(near.z)));
}

/// Finds up to 16 places in the void, nearest to `near` first, at most `half` units away on each axis.
Result<std::vector<Int3>> FlightPlanner::voidsNear(Int3 near, int32_t half) {
  constexpr size_t kMaxPlaces = 16;
  std::vector<Int3> lattice;
  for (int i = 0; i < 24 * 24 * 24; ++i) {
    const std::array<int, 3> at{i % 24, i / 24 % 24, i / 576};
    Int3 place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = saturate(near[axis] + int64_t{2 * at[static_cast<size_t>(axis)] - 23} * half / 24);
    lattice.push_back(place);
  }
  std::stable_sort(lattice.begin(), lattice.end(),
                   [&](Int3 a, Int3 b) { return distanceSquared(a, near) < distanceSquared(b, near); });
  std::vector<Int3> places;
  // Sample the places in batches. The first batch usually suffices, and requires the derivation of only a few grammar
  // cells.
  constexpr size_t kAtOnce = 512;
  for (size_t first = 0; first < lattice.size() && places.size() < kMaxPlaces; first += kAtOnce) {
    const std::span<const Int3> asked = std::span(lattice).subspan(first, std::min(kAtOnce, lattice.size() - first));
    const Result<std::vector<bool>> solid = solidAt(field_, asked);
    if (!solid) return solid.error();
    for (size_t i = 0; i < asked.size() && places.size() < kMaxPlaces; ++i)
      if (!(*solid)[i]) places.push_back(asked[i]);
  }
  return places;
}

bool FlightPlanner::leadsOn(Int3 node) {
  size_t around = 0;
  const VoidSearch search(*grid_, node, kWorthIt, {}, [&](Int3, int64_t) { return ++around < kWorthIt; });
  return around == kWorthIt;
}

std::vector<Int3> FlightPlanner::anchorsNear(Int3 place, int32_t reach) {
  for (int32_t half = 64 * kUnitsPerMetre; half <= reach; half *= 2) {
    int32_t minimum[3], maximum[3];
    for (int axis = 0; axis < 3; ++axis) {
      minimum[axis] = saturate(int64_t{place[axis]} - half);
      maximum[axis] = saturate(int64_t{place[axis]} + half);
    }
    size_t count = 0;
    if (sgm_field_anchors(field_, minimum, maximum, nullptr, 0, &count, nullptr) < SGM_OK || count == 0) continue;
    std::vector<sgm_anchor> anchors(count);
    if (sgm_field_anchors(field_, minimum, maximum, anchors.data(), 0, &count, nullptr) != SGM_OK) continue;
    const auto order = [&](const sgm_anchor& a) {
      const char* kind = sgm_grammar_name(grammar_, a.kind);
      const bool spawn = kind != nullptr && std::strcmp(kind, "spawn") == 0;
      return std::pair(!spawn, distanceSquared({a.position[0], a.position[1], a.position[2]}, place));
    };
    std::stable_sort(anchors.begin(), anchors.end(),
                     [&](const sgm_anchor& a, const sgm_anchor& b) { return order(a) < order(b); });
    std::vector<Int3> places;
    for (size_t i = 0; i < std::min<size_t>(anchors.size(), 16); ++i)
      places.push_back({anchors[i].position[0], anchors[i].position[1], anchors[i].position[2]});
    return places;
  }
  return {};
}

Result<std::vector<Metres3>> FlightPlanner::next() {
  for (int attempt = 0; attempt < kGoals * kWays; ++attempt) {
    const Result<std::vector<Int3>> way = wayOn();
    if (!way) return way.error();
    if (attempt % kWays == kWays - 1) {
      // All paths to this goal are blocked by an obstacle wider than a few nodes: choose another goal.
      grid_->unblock();
      been_.insert(regionOf(way->back()));
      ++waypoint_;
      continue;
    }
    const int32_t room = attempt < kGoals * kWays / 2 ? grid_->step() / 2 : grid_->step() / 8;
    // Try a smooth curve through every third node first; if it comes too close to rock, use a curve through every node.
    for (const size_t stride : {size_t{3}, size_t{1}}) {
      std::vector<Metres3> controls;
      for (size_t i = 0; i + 1 < way->size(); i += stride) controls.push_back(metresOf(grid_->placeOf((*way)[i])));
      const Metres3 last = metresOf(grid_->placeOf(way->back()));
      if (controls.size() > 1 && glm::length(last - controls.back()) < 1.5 * metres(grid_->step())) controls.pop_back();
      controls.push_back(last);
      for (int pass = 0; stride > 1 && pass < 2; ++pass) {
        const std::vector<Metres3> before = controls;
        for (size_t i = 1; i + 1 < controls.size(); ++i)
          controls[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
      }
      std::vector<Metres3> points = splinePoints(controls, spacing() / 2, false, way_);
      const Result<std::optional<Int3>> tight = tightPlace(points, room);
      if (!tight) return tight.error();
      if (*tight && stride > 1) continue;
      if (*tight) {
        // An obstacle lies between nodes of the grid: block the nearest node, and plan again. At the start of a piece,
        // the cause may instead be too sharp a turn: then allow any direction.
        const auto nearest = std::min_element(way->begin(), way->end(), [&](Int3 a, Int3 b) {
          return distanceSquared(grid_->placeOf(a), **tight) < distanceSquared(grid_->placeOf(b), **tight);
        });
        if (nearest - way->begin() < 2 && way_) {
          way_.reset();
        } else {
          grid_->block(nearest == way->begin() ? (*way)[1] : *nearest);
        }
        break;
      }
      for (const Int3 node : *way) been_.insert(regionOf(node));
      node_ = way->back();
      way_ = points.back() - points[points.size() - 2];
      grid_->unblock();
      ++pieces_;
      ++waypoint_;
      return points;
    }
  }
  return noRoom("there is no continuation of the path that is wide enough");
}

Result<std::vector<Int3>> FlightPlanner::wayOn() { return domain_.solid != 0 ? wayToNew() : wayAround(); }

Result<std::vector<Int3>> FlightPlanner::wayToNew() {
  for (int64_t look = kFirstLook;; look *= 3) {
    // Prefer far nodes; a random factor that depends on the seed varies the choice.
    std::optional<Int3> best;
    double most = 0;
    const VoidSearch search(*grid_, node_, kMaxNodes, {}, [&](Int3 node, int64_t cost) {
      if (cost > look) return false;
      if (cost < kShortest || been_.count(regionOf(node)) != 0) return true;
      const PathKey key{hashCombine(hashCombine(settings_.seed, pieces_), PlaceHash{}(regionOf(node)))};
      const double worth = static_cast<double>(cost) * (1 + 0.5 * key.unit(0));
      if (!best || worth > most) {
        best = node;
        most = worth;
      }
      return true;
    });
    if (grid_->error()) return *grid_->error();
    if (best) return search.wayTo(*best);
    if (look < kFarthestLook) continue;
    if (been_.size() <= 1) return noRoom("the void around the flight is too small");
    // All reachable regions are visited: forget the visits and start again.
    been_.clear();
    look = kFirstLook / 3;
  }
}

Result<std::vector<Int3>> FlightPlanner::wayAround() {
  for (int skipped = 0; skipped < kTries; ++skipped, ++waypoint_) {
    const std::optional<Int3> goal = grid_->nearestClear(grid_->nodeAt(waypoint(waypoint_ + 1)), 8);
    if (!goal || *goal == node_) continue;
    bool there = false;
    const VoidSearch search(
        *grid_, node_, size_t{100'000},
        [&](Int3 node) {
          double sum = 0;
          for (int axis = 0; axis < 3; ++axis) {
            const double d = node[axis] - (*goal)[axis];
            sum += d * d;
          }
          return static_cast<int64_t>(12 * std::sqrt(sum));
        },
        [&](Int3 node, int64_t) { return !(there = node == *goal); });
    if (grid_->error()) return *grid_->error();
    if (there) return search.wayTo(*goal);
  }
  return noRoom("there is no path between the solids");
}

Result<void> FlightPlanner::findSolids(Int3 near) {
  centre_ = near;
  if (domain_.infinite == 0)
    for (int axis = 0; axis < 3; ++axis)
      centre_[axis] = saturate((int64_t{domain_.minimum[axis]} + domain_.maximum[axis]) / 2);
  height_ = scale_ / 8;
  for (double half = scale_ / 2; half <= 8 * scale_ || half <= 2048.0 * kUnitsPerMetre; half *= 2) {
    constexpr int kSide = 32;
    std::vector<Int3> lattice;
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const std::array<int, 3> at{i % kSide, i / kSide % kSide, i / kSide / kSide};
      Int3 place;
      for (int axis = 0; axis < 3; ++axis)
        place[axis] = saturate(centre_[axis] +
                               static_cast<int64_t>((2 * at[static_cast<size_t>(axis)] - kSide + 1) * (half / kSide)));
      lattice.push_back(place);
    }
    const Result<std::vector<bool>> solid = solidAt(field_, lattice);
    if (!solid) return solid.error();
    double sum = 0, squares = 0, count = 0;
    for (size_t i = 0; i < lattice.size(); ++i) {
      if (!(*solid)[i]) continue;
      const double y = lattice[i].y - centre_.y;
      sum += y;
      squares += y * y;
      ++count;
    }
    if (count < 8) continue;
    const double mean = sum / count;
    centre_.y = saturate(static_cast<int64_t>(centre_.y + mean));
    height_ = std::max(height_, 2 * std::sqrt(std::max(0.0, squares / count - mean * mean)));
    return {};
  }
  return {};
}

Int3 FlightPlanner::waypoint(int64_t number) const {
  // Each turn of the spiral is wider by `scale_` than the previous turn, and waypoints are half of `scale_` apart along
  // it. The length of a spiral grows with the square of the angle, so the angle of a waypoint is proportional to the
  // square root of its number.
  constexpr double kTurn = 2 * std::numbers::pi;
  const double angle = std::sqrt(kTurn * (1.0 + static_cast<double>(number)));
  double radius = scale_ * (0.25 + angle / kTurn);
  if (domain_.infinite == 0) {
    // In a finite world, let the radius alternately grow and shrink, so that the path stays inside.
    const double widest = 2.5 * scale_;
    radius = std::fabs(std::remainder(radius, 2 * widest));
  }
  const double turn = angle + kTurn * PathKey{settings_.seed}.unit(1);
  const auto at = [](int32_t from, double by) { return saturate(from + static_cast<int64_t>(by)); };
  return {at(centre_.x, radius * std::cos(turn)), at(centre_.y, height_ * std::sin(0.7 * angle)),
          at(centre_.z, radius * std::sin(turn))};
}

Result<std::optional<Int3>> FlightPlanner::tightPlace(const std::vector<Metres3>& points, int32_t room) {
  std::vector<Int3> places;
  for (const Metres3& point : points) {
    const Int3 place = unitsOf(point);
    places.push_back(place);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Int3 beside = place;
        beside[axis] = saturate(int64_t{beside[axis]} + side * room);
        places.push_back(beside);
      }
    }
  }
  const Result<std::vector<bool>> solid = solidAt(field_, places);
  if (!solid) return solid.error();
  for (size_t i = 0; i < places.size(); ++i)
    if ((*solid)[i]) return std::optional(places[i / 7 * 7]);
  return std::optional<Int3>();
}

Int3 FlightPlanner::regionOf(Int3 node) const {
  Int3 region;
  for (int axis = 0; axis < 3; ++axis) region[axis] = static_cast<int32_t>(floorDiv(node[axis], kRegion));
  return region;
}

Result<void> FlightPlanner::teleport(uint64_t number) {
  const PathKey key = PathKey{settings_.seed}.child(hashText("teleport"), number);
  for (uint64_t attempt = 0; attempt < kTries; ++attempt) {
    Int3 near;
    waypoint_ = 0;
    if (domain_.infinite == 0) {
      waypoint_ = static_cast<int64_t>(64 * key.unit(4 * attempt + 3));
      for (int axis = 0; axis < 3; ++axis) {
        const double edge = double{1} * domain_.maximum[axis] - domain_.minimum[axis];
        near[axis] = saturate(domain_.minimum[axis] +
                              static_cast<int64_t>(edge * key.unit(4 * attempt + static_cast<uint64_t>(axis))));
      }
    } else {
      Metres3 direction{0};
      for (int axis = 0; axis < 3; ++axis)
        direction[axis] = domain_.cut[axis] != 0 ? 2 * key.unit(4 * attempt + static_cast<uint64_t>(axis)) - 1 : 0;
      const double distance = 600 + 4200 * key.unit(4 * attempt + 3);
      near = unitsOf(metresOf(home_) + distance * glm::normalize(direction));
    }
    if (const Result<void> settled = settle(near, 128 * kUnitsPerMetre); !settled) {
      if (grid_->error()) return *grid_->error();
      continue;
    }
    const double away = glm::length(metresOf(grid_->placeOf(node_)) - metresOf(home_));
    if (domain_.infinite != 0 && (away < 500 || away > 5000)) continue;
    pieces_ = hashCombine(number, 1);
    return {};
  }
  return noRoom("there is no distant place with enough room to fly");
}

}  // namespace sgm::cli
