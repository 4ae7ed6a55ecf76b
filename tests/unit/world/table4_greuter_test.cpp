// Tests the claims of the row Greuter in the paper's Table 4, with samples/grammars/table4/greuter.sgm: an endless city
// whose buildings are merged from random polygons, extruded and roofed. After a flight of any distance, the same
// buildings are found again, with a cache of bounded size.

#include <algorithm>
#include <cmath>
#include <random>

#include "base/math.h"
#include "edits_support.h"
#include "field/evaluate.h"
#include "mesh/check.h"
#include "rounds.h"
#include "seed.h"
#include "stream/plan/frame.h"
#include "world_support.h"

using namespace sgm;

namespace {

WorldField city(uint64_t seed, size_t cache_bytes = size_t{64} << 20) {
  WorldFieldSettings s = settingsOf(sample("table4/greuter.sgm"), 512, seed);
  s.cache_bytes = cache_bytes;
  return {std::move(s), std::pmr::get_default_resource()};
}

std::vector<ChunkRequest> blocksAround(Int3 chunk) {
  std::vector<ChunkRequest> requests;
  for (int32_t z = 0; z < 4; ++z)
    for (int32_t y = -1; y < 4; ++y)
      for (int32_t x = 0; x < 4; ++x) requests.emplace_back().key = {0, saturatingAdd(chunk, {x, y, z})};
  return requests;
}

ContentHash cityHash(const WorldField& world, Int3 chunk) {
  std::vector<PlacedPart> parts;
  const auto chunks = meshAll(world, blocksAround(chunk), 2);
  for (const PlacedChunk& one : chunks) appendParts(one, parts);
  REQUIRE(parts.size() > 20);
  return hashParts(parts);
}

std::vector<int32_t> samplesAt(const WorldField& world, const std::vector<Int3>& at) {
  std::array<std::vector<int32_t>, 3> axes;
  IntBox box;
  for (const Int3& p : at) {
    box = box.joined({p, p});
    for (int i = 0; i < 3; ++i) axes[static_cast<size_t>(i)].push_back(p[i]);
  }
  const auto program = world.compile(box, 0);
  REQUIRE(program);
  std::vector<int32_t> q(at.size());
  EvalScratch scratch;
  scalarKernels().samples((*program)->view(), {axes[0].data(), axes[1].data(), axes[2].data(), q.size()}, scratch,
                          q.data());
  return q;
}

/// For each place, the height up to which the world is solid, exact to a unit. The world must be solid below and void
/// above it, and at most 64 m high.
std::vector<Int3> topsOf(const WorldField& world, std::vector<Int3> places) {
  for (Int3& p : places) p.y = 1;
  for (int32_t step = 1 << 15; step > 0; step /= 2) {
    std::vector<Int3> higher = places;
    for (Int3& p : higher) p.y += step;
    const std::vector<int32_t> q = samplesAt(world, higher);
    for (size_t i = 0; i < places.size(); ++i)
      if (q[i] < 0) places[i].y = higher[i].y;
  }
  return places;
}

/// For each place, the slope of the field along an axis. A distance field has the slope 1 in the direction of its
/// gradient.
std::vector<double> slopesAlong(const WorldField& world, const std::vector<Int3>& places, int axis) {
  constexpr int32_t kStep = 24;
  std::vector<Int3> at = places;
  for (Int3& p : at) p[axis] += kStep;
  const std::vector<int32_t> more = samplesAt(world, at);
  for (Int3& p : at) p[axis] -= 2 * kStep;
  const std::vector<int32_t> less = samplesAt(world, at);
  std::vector<double> out;
  for (size_t i = 0; i < at.size(); ++i)
    out.push_back((more[i] - less[i]) * (world.cellAt(0) / 1024.0) / (2.0 * kStep));
  return out;
}

WorldField roofOf(const std::string& roof) {
  const std::string text = "sgm 1; units m; domain finite box(64m, 120m, 64m) empty; start Main; rule Main { ";
  return {settingsOf(text + roof + " }", 256), std::pmr::get_default_resource()};
}

}  // namespace

TEST_CASE("Greuter: fly any distance, return, and find identical buildings from a bounded cache", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  // The cache holds a few blocks only, so that cells behind the viewer are soon dropped.
  const size_t room = size_t{512} << 10;
  const uint64_t of = random();
  const WorldField world = city(of, room), large = city(of);
  std::vector<Int3> places{{0, 0, 0}};
  for (unsigned i = 0; i < rounds(4); ++i)
    places.push_back({within(random, -30'000, 30'000), 0, within(random, -30'000, 30'000)});
  std::vector<ContentHash> first;
  for (const Int3& place : places) first.push_back(cityHash(world, place));
  CHECK(first[0] != first[1]);
  for (size_t i = places.size(); i-- > 0;) {
    CHECK(cityHash(world, places[i]) == first[i]);
    CHECK(cityHash(large, places[i]) == first[i]);
  }
  const CellCacheStats kept = world.cacheStats();
  CHECK(kept.bytes <= room);
}

TEST_CASE("Greuter: a city without holes, near and far", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  Octree tree(1, 512);
  tree.split({2, {0, 0, 0}});
  tree.split({1, {0, 0, 0}});
  refineToRules(tree);
  for (unsigned round = 0; round < rounds(3); ++round) {
    const auto chunks = meshAll(city(random()), frameRequests(tree), 2);
    std::vector<PlacedPart> placed;
    std::vector<const MeshPart*> parts;
    for (const PlacedChunk& chunk : chunks) appendParts(chunk, placed);
    for (const PlacedPart& part : placed) parts.push_back(part.mesh);
    const MeshReport report = checkParts(parts);
    INFO(describe(report));
    CHECK(report.closed());
    CHECK(report.triangles > 1000);
  }
}

TEST_CASE("Greuter: every point of a roof is as steep as it says, on two sides or on four", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(8); ++round) {
    const int x = within(random, 3, 24), z = within(random, 3, 24), pitch = within(random, 5, 78);
    const bool hip = random() % 2 == 0;
    CAPTURE(x, z, pitch, hip);
    const WorldField world = roofOf("size(" + std::to_string(x) + "m, 0m, " + std::to_string(z) + "m) roof " +
                                    (hip ? "hip(" : "gable(") + std::to_string(pitch) + "deg);");
    std::vector<Int3> places;
    for (int i = 0; i < 400; ++i)
      places.push_back({within(random, -512 * x + 4, 512 * x - 4), 0, within(random, -512 * z + 4, 512 * z - 4)});
    places = topsOf(world, places);
    const double angle = pitch * kPi / 180, slope = std::tan(angle);
    const std::vector<double> up = slopesAlong(world, places, 1), east = slopesAlong(world, places, 0),
                              south = slopesAlong(world, places, 2);
    size_t inside = 0;
    std::array<size_t, 4> sides{};
    for (size_t i = 0; i < places.size(); ++i) {
      const Int3 p = places[i];
      // The distances of the place from the four eaves, from which the roof slopes up.
      std::array<int32_t, 4> eaves{512 * x - p.x, 512 * x + p.x, 512 * z - p.z, 512 * z + p.z};
      if (!hip) std::fill_n(eaves.begin() + (x >= z ? 0 : 2), 2, 1 << 20);
      const size_t nearest = static_cast<size_t>(std::min_element(eaves.begin(), eaves.end()) - eaves.begin());
      CAPTURE(p.x, p.y, p.z);
      REQUIRE(std::fabs(p.y - slope * eaves[nearest]) < 2 + 2 * slope);
      // Away from the roof's edges, the field is the distance from a single slope.
      std::sort(eaves.begin(), eaves.end());
      const int32_t end = std::min(512 * x - std::abs(p.x), 512 * z - std::abs(p.z));
      if (eaves[1] - eaves[0] < 120 || end < 120 || p.y < 200) continue;
      ++inside;
      ++sides[nearest];
      const double along = nearest < 2 ? east[i] : south[i];
      REQUIRE(std::fabs(up[i] - std::cos(angle)) < 0.02);
      REQUIRE(std::fabs((nearest % 2 == 0 ? along : -along) - std::sin(angle)) < 0.02);
    }
    if (pitch > 15) CHECK(inside > 50);
    if (hip && pitch > 15) CHECK(std::count(sides.begin(), sides.end(), 0u) == 0);
  }
}
