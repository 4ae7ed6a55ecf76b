// Tests the volume of the solid in a region: it must equal the volume within the solid's closed surface, wherever the
// region's border cuts the solid.

#include "region/solid_volume.h"

#include <cmath>
#include <random>

#include "metrics_fixture.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;
using namespace sgm::test;

namespace {

constexpr WantedMeasures kVolume{false, false, true};

/// A box of `count` chunks on each axis from chunk `first` on, with grid cells of `cell` metres.
IntBox chunksAt(Int3 first, Int3 count, double cell) {
  const auto edge = static_cast<int32_t>(cell * kUnitsPerMetre) * kChunkCells;
  const Int3 last{first.x + count.x, first.y + count.y, first.z + count.z};
  return {{first.x * edge, first.y * edge, first.z * edge}, {last.x * edge, last.y * edge, last.z * edge}};
}

double volumeOf(const World& world, double cell, const IntBox& region) {
  return world.measured(cell, region, kVolume).volume;
}

std::string metresText(double v) { return std::to_string(v) + "m"; }

/// Balls, boxes and slabs around the origin that intersect each other.
std::string randomShapes(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-6, 6), size(0.3, 5);
  std::string out;
  for (int i = 0; i < 6; ++i) {
    out +=
        "at(" + metresText(place(random)) + ", " + metresText(place(random)) + ", " + metresText(place(random)) + ") ";
    if (i % 2 == 0)
      out += "rot(y, " + std::to_string(static_cast<int>(random() % 90)) + "deg) box(" + metresText(size(random)) +
             ", " + metresText(2 * size(random)) + ", " + metresText(size(random)) + "); ";
    else
      out += "sphere(" + metresText(size(random)) + "); ";
  }
  return out;
}

}  // namespace

TEST_CASE("thin and bulky boxes have their volume", "[metrics]") {
  const World slab("sgm 1; start A; rule A { box(10m, 1m, 10m); }");
  for (const double cell : {0.5, 0.25, 0.1, 0.05}) {
    INFO("cells of " << cell << " m");
    // Marching cubes cuts off at most a triangle of half a cell's face along each edge; a face that coincides with
    // samples is off by 1/256 of a cell.
    const double edges = 4 * (10 + 1 + 10) * cell * cell / 2, faces = (2 * 100 + 4 * 10) * cell / kSubcell;
    CHECK(std::fabs(volumeOf(slab, cell, slab.program().domain.box) - 100) < edges + faces);
  }
  CHECK(volumeOf(slab, 0.1, slab.program().domain.box) == Approx(100).epsilon(0.01));
  const World turned("sgm 1; start A; rule A { rot(x, 33deg) rot(z, 20deg) box(10m, 1m, 10m); }");
  CHECK(volumeOf(turned, 0.1, turned.program().domain.box) == Approx(100).epsilon(0.01));
}

TEST_CASE("half a ball is left of one that a face of the border cuts, each of the six", "[metrics]") {
  const double whole = 4 * 3.14159265358979323846 * 27 / 3;
  for (int face = 0; face < 6; ++face) {
    // The region is a cube from -4 m to 4 m on each axis. The ball's centre is the centre of one of the cube's faces.
    const std::array<double, 3> at = [&] {
      std::array<double, 3> p{};
      p[static_cast<size_t>(face / 2)] = face % 2 == 0 ? -4 : 4;
      return p;
    }();
    const std::string place = "at(" + metresText(at[0]) + ", " + metresText(at[1]) + ", " + metresText(at[2]) + ") ";
    const std::string domain = "sgm 1; domain finite box(40m, 40m, 40m)";
    const World ball(domain + "; start A; rule A { " + place + "sphere(3m); }");
    const World hole(domain + " solid; start A; rule A { cut { " + place + "sphere(3m); } }");
    INFO("face " << face);
    const IntBox region = chunksAt({-1, -1, -1}, {2, 2, 2}, 0.125);
    CHECK(volumeOf(ball, 0.125, region) == Approx(whole / 2).epsilon(0.005));
    CHECK(volumeOf(hole, 0.125, region) == Approx(8 * 8 * 8 - whole / 2).epsilon(0.005));
  }
}

TEST_CASE("regions without a surface are full or empty", "[metrics]") {
  const World air("sgm 1; domain finite box(40m, 40m, 40m); start A; rule A { }");
  const World rock("sgm 1; domain finite box(40m, 40m, 40m) solid; start A; rule A { }");
  const World block("sgm 1; domain finite box(90m, 90m, 90m); start A; rule A { box(80m); }");
  const IntBox region = chunksAt({-1, -1, 0}, {2, 1, 1}, 0.25);
  CHECK(volumeOf(air, 0.25, region) == 0);
  CHECK(volumeOf(rock, 0.25, region) == Approx(2 * 8 * 8 * 8).epsilon(1e-12));
  CHECK(volumeOf(block, 0.25, region) == Approx(2 * 8 * 8 * 8).epsilon(1e-12));
}

TEST_CASE("volumes of regions side by side add up, near the origin and far out", "[metrics]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(6); ++round) {
    const bool solid = round % 2 == 1;
    std::string shapes = "at(8m, 8m, 8m) { " + randomShapes(random) + "}";
    if (solid) shapes = "cut { " + shapes + " }";
    const World world("sgm 1; domain infinite" + std::string(solid ? " solid" : "") +
                      "; layer l cell 64m reach 32m { start A; } rule A { " + shapes + " }");
    CAPTURE(round, shapes);
    // At a distance of 32,000 cells from the origin, the same shapes have the same places relative to the grid.
    for (const int32_t away : {0, 32'000 * 8}) {
      const Int3 first{away, -away, away};
      const double all = volumeOf(world, 0.25, chunksAt(first, {2, 2, 2}, 0.25));
      double sum = 0;
      for (int i = 0; i < 8; ++i) {
        const Int3 at{first.x + (i & 1), first.y + (i >> 1 & 1), first.z + (i >> 2)};
        sum += volumeOf(world, 0.25, chunksAt(at, {1, 1, 1}, 0.25));
      }
      CHECK(all > 0);
      CHECK(sum == Approx(all).epsilon(1e-9));
      if (away != 0) CHECK(all == Approx(volumeOf(world, 0.25, chunksAt({}, {2, 2, 2}, 0.25))).epsilon(1e-9));
    }
  }
}

TEST_CASE("the border of a welded mesh says what its seams do", "[metrics]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(12); ++round) {
    const bool solid = round % 2 == 1, sharp = round % 4 >= 2;
    std::string shapes = "at(4m, 4m, 4m) { " + randomShapes(random) + "}";
    if (solid) shapes = "cut { " + shapes + " }";
    const World maker("sgm 1; domain finite box(64m, 64m, 64m)" + std::string(solid ? " solid" : "") +
                      "; start A; rule A { " + shapes + " }");
    WorldFieldSettings settings;
    settings.program = maker.settings().program;
    settings.parameters = maker.settings().parameters;
    settings.finest_cell = static_cast<int32_t>(0.25 * kUnitsPerMetre);
    const WorldField world(settings, std::pmr::get_default_resource());
    const IntBox region = chunksAt({-1, 0, 0}, {2, 1, 1}, 0.25);
    const auto keys = chunksOfRegion(world, region, 0, 64);
    REQUIRE(keys);
    std::vector<ChunkRequest> requests;
    for (const ChunkKey& key : *keys) {
      requests.push_back(ChunkRequest{key});
      requests.back().sharp = sharp;
      requests.back().keys = true;
    }
    const auto chunks = meshChunks(world, maker.backend(), maker.jobs(), requests);
    REQUIRE(chunks);
    std::pmr::vector<PlacedPart> parts;
    for (const PlacedChunk& chunk : *chunks) appendParts(chunk, parts);
    const Result<WorldMesh> mesh = weld(parts, region.lo);
    REQUIRE(mesh);
    const Result<double> by_seams = borderFlux(world, maker.backend(), maker.jobs(), *keys, sharp);
    const Result<double> by_edges = borderFlux(world, region, 0, *mesh);
    REQUIRE(by_seams);
    REQUIRE(by_edges);
    CAPTURE(round, shapes);
    CHECK(*by_edges == Approx(*by_seams).epsilon(1e-9).margin(1e-9));
    // The result does not depend on the origin of positions.
    const Result<WorldMesh> elsewhere = weld(parts, {region.lo.x - 512, region.lo.y + 1024, region.lo.z});
    REQUIRE(elsewhere);
    CHECK(*borderFlux(world, region, 0, *elsewhere) == Approx(*by_seams).epsilon(1e-9).margin(1e-9));
  }
}
