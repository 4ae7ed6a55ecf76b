// Tests floor plans: areas and shapes of the rooms, and that every room can be reached.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "derive/layout/floor_plan.h"
#include "derive_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

double aspectOf(const PlanRect& r) {
  const double x = r.width(), z = r.depth();
  return std::max(x / z, z / x);
}

double areaOf(const PlanRect& r) { return static_cast<double>(r.width()) * r.depth(); }

bool touch(const PlanRect& a, const PlanRect& b) {
  return std::max(a.x0, b.x0) < std::min(a.x1, b.x1) && std::max(a.z0, b.z0) < std::min(a.z1, b.z1);
}

/// A random floor plan, with the sizes from which it was made.
struct Drawn {
  FloorPlanSizes sizes;
  std::vector<double> areas;
  std::vector<RoomLink> links;
  FloorPlan plan;
};

Drawn drawnPlan(std::mt19937& random, size_t max_rooms = 10) {
  std::uniform_real_distribution<double> unit(0, 1);
  Drawn out;
  out.sizes = {static_cast<int32_t>(1024 * (9 + 15 * unit(random))),
               static_cast<int32_t>(1024 * (8 + 12 * unit(random))), 256, 920, 1332};
  const size_t rooms = 1 + random() % max_rooms;
  for (size_t i = 0; i < rooms; ++i) out.areas.push_back(6 + 34 * unit(random));
  for (size_t i = 0; i < random() % 3 && rooms > 1; ++i) {
    const size_t a = random() % rooms;
    out.links.push_back({a, (a + 1 + random() % (rooms - 1)) % rooms, 1024});
  }
  out.plan = layOutFloor(out.sizes, out.areas, out.links);
  return out;
}

/// Returns the open parts of a plan (rooms, corridors and doors) as rectangles. Each rectangle has the index of its
/// room; corridors and doors have SIZE_MAX.
std::vector<std::pair<PlanRect, size_t>> openOf(const FloorPlan& plan) {
  std::vector<std::pair<PlanRect, size_t>> out;
  for (size_t room = 0; room < plan.rooms.size(); ++room)
    for (const PlanRect& r : plan.rooms[room].clear) out.emplace_back(r, room);
  for (const PlanRect& r : plan.corridor) out.emplace_back(r, SIZE_MAX);
  for (const PlanDoor& door : plan.doors) out.emplace_back(door.hole, SIZE_MAX);
  return out;
}

}  // namespace

TEST_CASE("the example of the paper on squarified treemaps comes out as in its figure", "[treemap]") {
  // Bruls et al. 2000, figure 4: a rectangle of 6 by 4, areas 6 6 4 3 2 2 1. In steps of 1/4200, all results are whole
  // numbers.
  constexpr int32_t k = 4200;
  const std::vector<double> areas{6, 6, 4, 3, 2, 2, 1};
  const auto parts = squarifiedTreemap({0, 0, 6 * k, 4 * k}, areas, 1);
  CHECK(parts[0] == PlanRect{0, 0, 3 * k, 2 * k});
  CHECK(parts[1] == PlanRect{0, 2 * k, 3 * k, 4 * k});
  // The areas 4 and 3 form a row along the shorter side of the remaining rectangle, which is 3 by 4.
  CHECK(parts[2] == PlanRect{3 * k, 0, 3 * k + 12 * k / 7, 7 * k / 3});
  CHECK(parts[3] == PlanRect{3 * k + 12 * k / 7, 0, 6 * k, 7 * k / 3});
  for (size_t i = 4; i < 7; ++i) {
    CHECK(areaOf(parts[i]) == Approx(areas[i] * k * k).epsilon(0.001));
    CHECK(aspectOf(parts[i]) < 2.8);
  }
}

TEST_CASE("rooms share a floor in proportion, without gaps, and are nearer to squares than slices", "[treemap]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  double squarified = 0, sliced = 0, parts_seen = 0;
  for (unsigned round = 0; round < rounds(300); ++round) {
    const PlanRect whole{-4000, 200, -4000 + 2 * static_cast<int32_t>(2000 + 8000 * unit(random)),
                         200 + 2 * static_cast<int32_t>(2000 + 8000 * unit(random))};
    std::vector<double> weights(1 + random() % 20);
    for (double& w : weights) w = 1 + 9 * unit(random);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto parts = squarifiedTreemap(whole, weights, 2);
    REQUIRE(parts.size() == weights.size());
    double covered = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
      const PlanRect& r = parts[i];
      REQUIRE(r.x0 >= whole.x0);
      REQUIRE(r.z0 >= whole.z0);
      REQUIRE(r.x1 <= whole.x1);
      REQUIRE(r.z1 <= whole.z1);
      REQUIRE((r.x0 - whole.x0) % 2 == 0);
      REQUIRE((r.z0 - whole.z0) % 2 == 0);
      // Areas are exact, except that the position of each dividing line is rounded to a multiple of two units.
      const double wanted = weights[i] / total * areaOf(whole);
      REQUIRE(std::fabs(areaOf(r) - wanted) <= 4.0 * (r.width() + r.depth()) + 16);
      covered += areaOf(r);
      for (size_t j = 0; j < i; ++j) REQUIRE(!touch(r, parts[j]));
      squarified += aspectOf(r);
      const double slice = weights[i] / total * whole.width() / whole.depth();
      sliced += std::max(slice, 1 / slice);
      ++parts_seen;
    }
    REQUIRE(covered == areaOf(whole));
  }
  CAPTURE(squarified / parts_seen, sliced / parts_seen);
  CHECK(squarified / parts_seen < 1.6);
  CHECK(squarified < 0.4 * sliced);
}

TEST_CASE("every room of a thousand floors can be reached from outside, through doors alone", "[treemap]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(1000); ++round) {
    const Drawn drawn = drawnPlan(random);
    const FloorPlan& plan = drawn.plan;
    CAPTURE(round, drawn.sizes.x, drawn.sizes.z, drawn.areas, drawn.links.size());
    REQUIRE(plan.fits);
    REQUIRE(plan.closed.empty());
    REQUIRE(!plan.doors.empty());
    REQUIRE(plan.doors[0].from == PlanDoor::kOutside);
    // Floods the open space from the opening of the entrance: openings, corridors and rooms that touch are connected.
    const auto open = openOf(plan);
    std::vector<bool> seen(open.size(), false), reached(plan.rooms.size(), false);
    std::vector<size_t> next;
    for (size_t i = 0; i < open.size(); ++i)
      if (open[i].first == plan.doors[0].hole) next.push_back(i);
    REQUIRE(next.size() == 1);
    while (!next.empty()) {
      const size_t at = next.back();
      next.pop_back();
      if (seen[at]) continue;
      seen[at] = true;
      if (open[at].second != SIZE_MAX) reached[open[at].second] = true;
      for (size_t i = 0; i < open.size(); ++i)
        if (touch(open[at].first, open[i].first)) next.push_back(i);
    }
    REQUIRE(std::count(seen.begin(), seen.end(), false) == 0);
    REQUIRE(std::count(reached.begin(), reached.end(), false) == 0);
    // Check the walls: there is one between any two rooms, and one between each room and the corridor.
    const PlanRect& entrance = plan.doors[0].hole;
    const int32_t x = drawn.sizes.x / 2, z = drawn.sizes.z / 2;
    CHECK((entrance.x0 < -x || entrance.x1 > x || entrance.z0 < -z || entrance.z1 > z));
    const size_t holes = open.size() - plan.doors.size();
    for (size_t i = 0; i < holes; ++i)
      for (size_t j = 0; j < i; ++j) {
        if (open[i].second == open[j].second) continue;
        const PlanRect& r = open[i].first;
        const int32_t wall = drawn.sizes.wall;
        REQUIRE(!touch({r.x0 - wall, r.z0 - wall, r.x1 + wall, r.z1 + wall}, open[j].first));
      }
    for (const PlanDoor& door : plan.doors) {
      const int32_t width = door.link == PlanDoor::kNoLink ? drawn.sizes.door : drawn.links[door.link].width;
      REQUIRE(std::min(door.hole.width(), door.hole.depth()) == std::min(width, drawn.sizes.wall + 32));
      REQUIRE(std::max(door.hole.width(), door.hole.depth()) == std::max(width, drawn.sizes.wall + 32));
    }
  }
}

TEST_CASE("most floors have a corridor, and most rooms that are linked meet", "[treemap]") {
  // Every run and build tests the same floors: with random or fewer floors, a share could be out of its bounds by
  // chance.
  std::mt19937 random(1);
  const int floors = static_cast<int>(std::max(rounds(1000), 1000u));
  int corridors = 0, through = 0, links = 0, lost = 0;
  for (int floor = 0; floor < floors; ++floor) {
    const Drawn drawn = drawnPlan(random);
    const FloorPlan& plan = drawn.plan;
    corridors += !plan.corridor.empty();
    lost += static_cast<int>(plan.unmet.size());
    links += static_cast<int>(drawn.links.size());
    for (const PlanDoor& door : plan.doors) {
      if (door.link == PlanDoor::kNoLink && door.to < PlanDoor::kCorridor && door.from != plan.doors[0].to &&
          door.from != PlanDoor::kOutside)
        ++through;
    }
  }
  CAPTURE(corridors, through, links, lost);
  CHECK(corridors > floors / 4);
  // Except for the room at the entrance, two rooms without a link get a door between them only if no corridor from the
  // entrance fits.
  CHECK(through <= floors / 8);
  CHECK(lost <= links / 6);
}

TEST_CASE("rooms that are linked come to lie beside each other, in the shapes of the treemap", "[treemap]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  size_t links_seen = 0, plain_met = 0, met = 0;
  // Every build tests at least 100 floors, enough for the share of links checked below.
  for (unsigned round = 0; round < std::max(rounds(200), 100u); ++round) {
    const PlanRect whole{-4000, 200, -4000 + 2 * static_cast<int32_t>(4000 + 6000 * unit(random)),
                         200 + 2 * static_cast<int32_t>(4000 + 6000 * unit(random))};
    std::vector<double> areas(3 + random() % 10);
    for (double& area : areas) area = 6 + 34 * unit(random);
    std::vector<RoomLink> links(1 + random() % 3);
    for (RoomLink& link : links) {
      link.a = random() % areas.size();
      link.b = (link.a + 1 + random() % (areas.size() - 1)) % areas.size();
      link.width = 920;
    }
    CAPTURE(round, areas, links.size());
    const auto plain = squarifiedTreemap(whole, areas, 2);
    PlanWork work;
    const auto rooms = linkedRooms(whole, areas, links, 256, 2, work);
    double covered = 0;
    for (size_t i = 0; i < rooms.size(); ++i) {
      // Rooms have the same sizes as in the plain treemap, up to the rounding of wall positions.
      REQUIRE(std::abs(rooms[i].width() - plain[i].width()) <= 4);
      REQUIRE(std::abs(rooms[i].depth() - plain[i].depth()) <= 4);
      REQUIRE(rooms[i].x0 >= whole.x0);
      REQUIRE(rooms[i].z0 >= whole.z0);
      REQUIRE(rooms[i].x1 <= whole.x1);
      REQUIRE(rooms[i].z1 <= whole.z1);
      for (size_t j = 0; j < i; ++j) REQUIRE(!touch(rooms[i], rooms[j]));
      covered += areaOf(rooms[i]);
    }
    REQUIRE(covered == areaOf(whole));
    const auto metIn = [&](const std::vector<PlanRect>& in) {
      size_t count = 0;
      for (const RoomLink& link : links) {
        const PlanRect &a = in[link.a], &b = in[link.b];
        const auto shared = [&](int32_t x0, int32_t x1, int32_t z0, int32_t z1, int32_t end, int32_t begin) {
          return end == begin && std::min(x1, z1) - std::max(x0, z0) >= link.width + 256;
        };
        count += shared(a.z0, a.z1, b.z0, b.z1, a.x1, b.x0) || shared(a.z0, a.z1, b.z0, b.z1, b.x1, a.x0) ||
                 shared(a.x0, a.x1, b.x0, b.x1, a.z1, b.z0) || shared(a.x0, a.x1, b.x0, b.x1, b.z1, a.z0);
      }
      return count;
    };
    REQUIRE(metIn(rooms) >= metIn(plain));
    if (metIn(plain) == links.size()) REQUIRE(rooms == plain);
    links_seen += links.size();
    plain_met += metIn(plain);
    met += metIn(rooms);
  }
  CAPTURE(links_seen, plain_met, met);
  CHECK(10 * (links_seen - met) < 6 * (links_seen - plain_met));
}

TEST_CASE("what a floor costs is known, and a search that may cost less ends in time", "[treemap]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (unsigned round = 0; round < rounds(4); ++round) {
    const FloorPlanSizes sizes{40 * 1024, 30 * 1024, 256, 920, 1332};
    std::vector<double> areas(24 + random() % 9);
    for (double& area : areas) area = 6 + 34 * unit(random);
    std::vector<RoomLink> links(random() % 40);
    for (RoomLink& link : links) {
      link.a = random() % areas.size();
      link.b = (link.a + 1 + random() % (areas.size() - 1)) % areas.size();
      link.width = 1024;
    }
    const FloorPlan whole = layOutFloor(sizes, areas, links);
    CAPTURE(round, areas.size(), links.size(), whole.work);
    CHECK(whole.work >= areas.size() * areas.size());
    CHECK(layOutFloor(sizes, areas, links, whole.work).doors.size() == whole.doors.size());
    const uint64_t most = random() % whole.work;
    const uint64_t cut = layOutFloor(sizes, areas, links, most).work;
    CHECK(cut > most);
    // The work exceeds the limit by the cost of one step at most.
    CHECK(cut <= most + 40000);
  }
}

TEST_CASE("floors that are alike are laid out once, and others end with the cell's budget", "[treemap]") {
  const auto tower = [](const std::string& width, const DeriveLimits& limits) {
    std::string rooms;
    for (int i = 0; i < 32; ++i) rooms += "r" + std::to_string(i) + " " + std::to_string(6 + 7 * i % 11) + ": { } ";
    for (int i = 0; i < 16; ++i) rooms += "link r" + std::to_string(i) + " r" + std::to_string(i + 16) + " by door; ";
    const auto program = compiled(
        "sgm 1; domain infinite; layer main cell 256m reach 256m { start Main; }\nrule Main { for i in 0..80 { at(y "
        "3m*i) size(" +
        width + ", 3m, 30m) treemap { " + rooms + "} } }");
    return deriveCell(*program, {}, 7, 0, {}, Ceiling(0), limits);
  };
  CHECK(tower("40m", {}));
  const auto unlike = tower("40m + 10cm*i", {});
  REQUIRE_FALSE(unlike);
  CHECK(unlike.error().message ==
        "deriving one cell takes more than 4000000 steps (derive less, or make the cells smaller), in "
        "main(0, 0, 0)/Main");
}

TEST_CASE("links are doors where rooms share a wall", "[treemap]") {
  // Three rooms in a row from left to right, so that only the second can lead to the third.
  const std::vector<double> areas{4, 2, 2};
  const FloorPlanSizes sizes{8 * 1024, 4 * 1024, 256, 920, 1332};
  const auto doors = [&](const std::vector<RoomLink>& links) {
    std::vector<std::pair<size_t, size_t>> out;
    for (const PlanDoor& door : layOutFloor(sizes, areas, links).doors) {
      UNSCOPED_INFO(door.from << " to " << door.to);
      if (door.from != PlanDoor::kOutside) out.emplace_back(door.from, door.to);
    }
    return out;
  };
  using Doors = std::vector<std::pair<size_t, size_t>>;
  CHECK(doors({}) == Doors{{0, 1}, {1, 2}});
  CHECK(doors({{1, 2, 920}, {0, 1, 920}}) == Doors{{1, 2}, {0, 1}});
  // A door wider than the wall is left out, and the rooms are connected in another way.
  CHECK(doors({{1, 2, 5 * 1024}}) == Doors{{0, 1}, {1, 2}});
  const std::vector<RoomLink> some{{1, 2, 5 * 1024}, {0, 1, 920}, {0, 2, 920}};
  CHECK(layOutFloor(sizes, areas, some).unmet == std::vector<size_t>{0, 2});
}

TEST_CASE("walls without windows, rooms without doors and floors without room are known", "[treemap]") {
  const FloorPlanSizes sizes{8 * 1024, 6 * 1024, 256, 920, 1332};
  const std::vector<double> two{1, 1}, many(30, 1);
  const FloorPlan plan = layOutFloor(sizes, two, {});
  REQUIRE(plan.fits);
  // There are six outer walls, and the entrance divides one of them.
  CHECK(plan.facades.size() == 7);
  for (const PlanFacade& f : plan.facades) CHECK(f.high > f.low);
  CHECK(!layOutFloor({500, 6 * 1024, 256, 920, 1332}, two, {}).fits);
  CHECK(!layOutFloor({1200, 1200, 256, 920, 1332}, many, {}).fits);
  const FloorPlan wide = layOutFloor({8 * 1024, 6 * 1024, 256, 7 * 1024, 7 * 1024}, two, {});
  REQUIRE(wide.fits);
  CHECK(wide.closed == std::vector<size_t>{1});
}

TEST_CASE("rooms are scopes with their names as tags, and draw by them, however large they are", "[treemap]") {
  const auto rooms = [](const std::string& inside) {
    return derivedRules("rule Main { at(20m, 20m, 20m) size(12m, 3m, 9m) treemap { " + inside +
                        " } }\nrule Room { anchor room; box(rand(0.2m, 1m)); }");
  };
  const GrammarChunk chunk = rooms("hall 8: Room; living 20: { tag \"large\"; anchor room; } bath 4: Room;");
  CHECK(chunk.notes.empty());
  REQUIRE(chunk.anchors.size() == 3);
  CHECK(chunk.anchors[0].tag != chunk.anchors[1].tag);
  for (const Anchor& anchor : chunk.anchors) {
    CHECK(anchor.tag != 0);
    CHECK(std::abs(anchor.frame.origin.x - 20 * 1024) < 6 * 1024);
    CHECK(std::abs(anchor.frame.origin.z - 20 * 1024) < 4608);
  }
  const auto cubes = [](const GrammarChunk& from) {
    std::vector<float> sizes;
    for (const Shape& s : from.shapes)
      if (s.kind == ShapeKind::box && s.size[0] == s.size[1] && s.size[1] == s.size[2]) sizes.push_back(s.size[0]);
    std::sort(sizes.begin(), sizes.end());
    return sizes;
  };
  const auto plain = cubes(chunk);
  REQUIRE(plain.size() == 2);
  CHECK(plain[0] != plain[1]);
  CHECK(plain == cubes(rooms("hall 12: Room; living 3: { tag \"large\"; anchor room; } bath 9: Room;")));
  CHECK(plain != cubes(rooms("lobby 8: Room; living 20: { tag \"large\"; anchor room; } bath 4: Room;")));
}
