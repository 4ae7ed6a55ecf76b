// Tests that sample caves are walkable, by a navigation mesh as games use it, and that the cross-sections of their
// passages vary.
//
//   SGM_WALK_SEEDS=100 test_walk   tests 100 seeds, from SGM_WALK_FIRST on; SGM_WALK_ONLY=cave: only samples
//                                  with "cave" in their names

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <set>

#include "../unit/validity/measured_surface.h"
#include "backend/cpu/instruction_sets.h"
#include "navmesh.h"
#include "region/places.h"

using namespace sgm;
using namespace sgm::test;

namespace {

using Point = std::array<double, 3>;

constexpr double kCell = 0.2;  // edge of the mesh's grid cells and of Recast's voxels, in metres

/// A sample cave whose halls are all connected within a block of `cells` grammar cells, as its `expect components(air)`
/// states.
struct Walk {
  const char* grammar;
  int32_t cells;  ///< number of grammar cells along an edge of the block: a power of two, so that a tree of links
                  ///< connects all halls in it
  double far;     ///< halls nearer to each other than this many metres may be neighbours
  double hall;    ///< within this many metres of a hall's anchor, a passage may still be part of the hall
  /// Tag of halls that an agent cannot reach, because they lie beyond a shaft or a sump; "" if there are none.
  const char* beyond;
};

const Walk kWalks[] = {
    {"cave", 4, 110, 18, ""},
    {"lake", 4, 110, 18, ""},
    {"branchwork", 2, 200, 18, ""},
};

uint64_t numberOr(const char* variable, uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}
uint64_t firstSeed() { return numberOr("SGM_WALK_FIRST", 1); }
uint64_t seedsWanted() { return numberOr("SGM_WALK_SEEDS", std::getenv("SGM_LONG") != nullptr ? 100 : 1); }

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

IntBox unitsOf(const Point& low, const Point& high) {
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = static_cast<int32_t>(std::floor(low[static_cast<size_t>(axis)] * kUnitsPerMetre));
    box.hi[axis] = static_cast<int32_t>(std::ceil(high[static_cast<size_t>(axis)] * kUnitsPerMetre));
  }
  return box;
}

std::string placeText(const Point& p) {
  std::ostringstream out;
  out << p[0] << ',' << p[1] << ',' << p[2];
  return out.str();
}

/// Returns positions around a hall's anchor where an agent may be able to stand.
std::vector<Point> placesAround(const Point& anchor) {
  std::vector<Point> places{anchor};
  for (const double far : {2.0, 4.0}) {
    for (int i = 0; i < 6; ++i) {
      const double angle = 1.0471975512 * i + far;
      places.push_back({anchor[0] + far * std::cos(angle), anchor[1], anchor[2] + far * std::sin(angle)});
    }
  }
  return places;
}

/// Returns points along a path, one metre apart.
std::vector<Point> eachMetre(const std::vector<Point>& corners) {
  std::vector<Point> points;
  double left = 0;
  for (size_t i = 1; i < corners.size(); ++i) {
    const double length = distance(corners[i - 1], corners[i]);
    double at = left;
    for (; at < length; at += 1) {
      Point p{};
      for (size_t axis = 0; axis < 3; ++axis)
        p[axis] = corners[i - 1][axis] + (corners[i][axis] - corners[i - 1][axis]) * at / length;
      points.push_back(p);
    }
    left = at - length;
  }
  return points;
}

/// Measures areas of cross-sections of the void in square metres. A section lies in the vertical plane across a path:
/// it is the connected part of the void around a place, within kFar steps of the place on each axis of the plane.
class CrossSections {
 public:
  explicit CrossSections(const WorldField& world) : world_(world) {}

  double at(const Point& place, const Point& direction) {
    constexpr int kFar = 40;
    constexpr double kStep = 0.25;
    const double length = std::hypot(direction[0], direction[2]);
    // The section is in a vertical plane, perpendicular to the path's horizontal direction.
    const Point aside{-direction[2] / length, 0, direction[0] / length};
    const double reach = kFar * kStep + 0.5;
    const Result<std::shared_ptr<const FieldProgram>> program =
        world_.compile(unitsOf({place[0] - reach, place[1] - reach, place[2] - reach},
                               {place[0] + reach, place[1] + reach, place[2] + reach}),
                       0);
    REQUIRE(program);
    constexpr int kSide = 2 * kFar + 1;
    std::vector<int32_t> x, y, z;
    for (int v = -kFar; v <= kFar; ++v) {
      for (int u = -kFar; u <= kFar; ++u) {
        x.push_back(static_cast<int32_t>((place[0] + u * kStep * aside[0]) * kUnitsPerMetre));
        y.push_back(static_cast<int32_t>((place[1] + v * kStep) * kUnitsPerMetre));
        z.push_back(static_cast<int32_t>((place[2] + u * kStep * aside[2]) * kUnitsPerMetre));
      }
    }
    std::vector<int32_t> q(x.size());
    bestKernels().samples((*program)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch_, q.data());
    std::vector<bool> seen(q.size());
    std::deque<int> next;
    const auto visit = [&](int at) {
      if (seen[static_cast<size_t>(at)] || q[static_cast<size_t>(at)] < 0) return;
      seen[static_cast<size_t>(at)] = true;
      next.push_back(at);
    };
    visit(kSide * kFar + kFar);
    size_t count = 0;
    while (!next.empty()) {
      const int at = next.front(), u = at % kSide, v = at / kSide;
      next.pop_front();
      ++count;
      if (u > 0) visit(at - 1);
      if (u + 1 < kSide) visit(at + 1);
      if (v > 0) visit(at - kSide);
      if (v + 1 < kSide) visit(at + kSide);
    }
    return static_cast<double>(count) * kStep * kStep;
  }

 private:
  const WorldField& world_;
  EvalScratch scratch_;
};

/// A section of a path, twenty metres long, and the areas of the void's cross-sections in it.
struct Window {
  double variation = 1;       ///< coefficient of variation: standard deviation of the areas divided by their mean
  std::vector<double> areas;  ///< areas of cross-sections, one metre apart, in square metres
};

/// Returns the window of a path between two halls in which the area of the cross-sections varies least. Points of the
/// path that are nearer than `hall` metres to either end are left out.
Window leastVaried(CrossSections& sections, const std::vector<Point>& way, double hall) {
  constexpr ptrdiff_t kWindow = 20;
  const std::vector<Point> points = eachMetre(way);
  std::vector<double> areas;
  for (size_t i = 2; i + 2 < points.size(); ++i) {
    if (distance(points[i], points.front()) < hall || distance(points[i], points.back()) < hall) continue;
    Point along{};
    for (size_t axis = 0; axis < 3; ++axis) along[axis] = points[i + 2][axis] - points[i - 2][axis];
    if (std::hypot(along[0], along[2]) < 1e-6) continue;
    areas.push_back(sections.at({points[i][0], points[i][1] + 1, points[i][2]}, along));
  }
  Window least;
  for (auto from = areas.begin(); areas.end() - from >= kWindow; ++from) {
    double sum = 0, squares = 0;
    for (auto at = from; at != from + kWindow; ++at) {
      sum += *at;
      squares += *at * *at;
    }
    const double mean = sum / kWindow;
    const double variation = std::sqrt(std::max(0.0, squares / kWindow - mean * mean)) / mean;
    if (variation < least.variation) least = {variation, {from, from + kWindow}};
  }
  return least;
}

}  // namespace

TEST_CASE("an agent walks from each hall of a cave to each other, through passages that vary", "[walk]") {
  const std::filesystem::path folder(SGM_SAMPLE_GRAMMARS);
  const ReportContext shop;
  const char* const only = std::getenv("SGM_WALK_ONLY");
  for (const Walk& walk : kWalks) {
    if (only != nullptr && std::string(walk.grammar).find(only) == std::string::npos) continue;
    const std::filesystem::path file = folder / (std::string(walk.grammar) + ".sgm");
    std::ifstream in(file);
    REQUIRE(in);
    std::stringstream text;
    text << in.rdbuf();
    const std::shared_ptr<const Program> program = compiled(text.str(), file.parent_path());
    const Result<IntBox> block = blockRegion(*program, walk.cells);
    REQUIRE(block);
    const IntBox box = *block;
    for (uint64_t seed = firstSeed(); seed < firstSeed() + seedsWanted(); ++seed) {
      CAPTURE(walk.grammar, seed);
      const auto begun = std::chrono::steady_clock::now();
      const WorldField world(worldOf(program, kCell, seed), std::pmr::get_default_resource());
      const Result<RegionMesh> region = meshRegion(world, *shop.backend, *shop.jobs, box, 0, uint64_t{1} << 20, false);
      REQUIRE(region);
      const Navmesh floor(region->mesh, {}, static_cast<float>(kCell));

      const Result<std::vector<Anchor>> anchors = world.anchors(box);
      REQUIRE(anchors);
      const Point origin{metres(region->mesh.origin.x), metres(region->mesh.origin.y), metres(region->mesh.origin.z)};
      std::vector<Point> halls;
      for (const Anchor& anchor : *anchors) {
        if (*walk.beyond != '\0' && program->tags[anchor.tag] == walk.beyond) continue;
        Point p{};
        for (int axis = 0; axis < 3; ++axis)
          p[static_cast<size_t>(axis)] = metres(anchor.frame.origin[axis]) - origin[static_cast<size_t>(axis)];
        halls.push_back(p);
      }
      REQUIRE(halls.size() >= 4);
      const auto walked = [&](size_t from, size_t to) {
        return floor.way(placesAround(halls[from]), placesAround(halls[to]));
      };
      CrossSections sections(world);
      double least = 1;
      size_t measured = 0, reached = 1;
      for (size_t i = 1; i < halls.size(); ++i) {
        CAPTURE(halls[0], halls[i]);
        const bool is_reached = !walked(0, i).empty();
        const auto ended = [&](size_t from, size_t to) { return floor.reached(halls[from], halls[to]); };
        INFO("the way there ends at " << placeText(ended(0, i)) << ", the way back at " << placeText(ended(i, 0))
                                      << " m from " << placeText(origin));
        CHECK(is_reached);
        reached += is_reached;
        // Measure only paths that join neighbouring halls and pass through no other hall.
        for (size_t k = 0; k < i; ++k) {
          if (distance(halls[i], halls[k]) > walk.far) continue;
          const std::vector<Point> way = walked(k, i);
          const bool direct = !way.empty() && std::ranges::none_of(eachMetre(way), [&](const Point& p) {
            for (size_t j = 0; j < halls.size(); ++j)
              if (j != i && j != k && distance(p, halls[j]) < walk.hall) return true;
            return false;
          });
          if (!direct) continue;
          std::vector<Point> placed = way;
          for (Point& p : placed)
            for (int axis = 0; axis < 3; ++axis) p[static_cast<size_t>(axis)] += metres(region->mesh.origin[axis]);
          CAPTURE(placed.front(), placed.back());
          const Window window = leastVaried(sections, placed, walk.hall);
          CAPTURE(window.areas);
          CHECK(window.variation >= 0.1);
          least = std::min(least, window.variation);
          ++measured;
        }
      }
      CHECK(measured > 0);
      std::printf("%-10s seed %3u: %zu of %zu halls reached, %d polygons, %zu passages vary by %.3f at least, %.1f s\n",
                  walk.grammar, static_cast<unsigned>(seed), reached, halls.size(), floor.polygons(), measured, least,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
      std::fflush(stdout);
    }
  }
}
