// Tests the distance between levels of detail.

#include "region/level_distance.h"

#include "meshed_world.h"

using namespace sgm;
using namespace sgm::test;

namespace {

LevelDistance distanceOf(const MeshedWorld& world, const IntBox& region, int level) {
  const LevelMesh fine = world.meshed(region, level);
  const LevelMesh coarse = world.meshed(fine.extent, level + 1);
  const Result<LevelDistance> result = levelDistance(fine.mesh, fine.extent, coarse.mesh,
                                                     world.field().cellAt(level + 1), {2, 1e-3, 20'000}, world.jobs());
  INFO((result ? "" : result.error().message));
  REQUIRE(result);
  return *result;
}

}  // namespace

TEST_CASE("levels of a smooth surface come together with the square of the cell", "[costly]") {
  const World world("sgm 1; start A; rule A { torus(20m, 10m); }");
  const MeshedWorld meshed(world, 0.5);
  double before = 0;
  for (int level = 2; level >= 0; --level) {
    const LevelDistance found = distanceOf(meshed, world.program().domain.box, level);
    const double cell = metres(meshed.field().cellAt(level + 1)), far = found.distance->atLeast();
    CAPTURE(level, cell, far, found.distance->atMost(), found.distance->there.mean);
    CHECK(found.distance->atMost() <= kLevelBound * cell);
    // The bound is the sagitta d^2 / (8 r) of a coarse cell, with the diagonal d = sqrt(3) cell and the smallest radius
    // r = 10 m, and a quarter of it for the finer level; cell / 256 is the rounding of positions.
    CHECK(far < 3 * cell * cell / 8 / 10 * 1.25 + cell / 256);
    if (before > 0) {
      CHECK(far < before / 2);
      CHECK(found.distance->there.mean < before / 2);
    }
    before = far;
    CHECK(found.fine_left_out + found.coarse_left_out == 0);
    CHECK(found.fine_triangles > 3 * found.coarse_triangles);
  }
}

TEST_CASE("what lies at the cut is left out, and what does not is all there", "[costly]") {
  const World world(
      "sgm 1; domain infinite; layer l cell 64m reach 30m { start A; } "
      "rule A { at(32m, 32m, 32m) sphere(28m); }");
  const MeshedWorld meshed(world, 0.5);
  // The plane x = 32 m cuts the ball in half, at a border between cells of both levels: 64 fine cells or 32 coarse
  // cells from 0.
  const IntBox half{{0, 0, 0}, {32 * kMetre, 64 * kMetre, 64 * kMetre}};
  const LevelDistance found = distanceOf(meshed, half, 0);
  CHECK(found.fine_left_out > 500);
  CHECK(found.coarse_left_out > 100);
  CHECK(found.fine_left_out < found.fine_triangles / 4);
  CHECK(found.distance->atLeast() < 0.1);
  CHECK(found.distance->atMost() < kLevelBound);
  // The region's faces cut through chunks, and the coarse mesh extends half a chunk beyond them.
  const LevelDistance odd = distanceOf(meshed, {{0, 0, 0}, {16 * kMetre, 16 * kMetre, 64 * kMetre}}, 0);
  CHECK(odd.coarse_left_out > odd.coarse_triangles);
  CHECK(odd.distance->atLeast() < 0.1);
}

TEST_CASE("detail that a level leaves out is found to be missing") {
  const World world("sgm 1; start A; rule A { sphere(10m); detail 1m { at(10m, 0, 0) sphere(2m); } }");
  const MeshedWorld meshed(world, 0.5);
  const LevelDistance same = distanceOf(meshed, world.program().domain.box, 0);
  CHECK(same.distance->atMost() < kLevelBound * 1);
  const LevelDistance found = distanceOf(meshed, world.program().domain.box, 1);
  CHECK(found.distance->there.at_least == Approx(2).margin(0.2));
  CHECK(found.distance->back.at_least < 2);
}

TEST_CASE("a coarse mesh that is off is found, wherever either counts from", "[costly]") {
  const World world("sgm 1; start A; rule A { sphere(10m); }");
  const MeshedWorld meshed(world, 0.5);
  const LevelMesh fine = meshed.meshed(world.program().domain.box, 0);
  LevelMesh coarse = meshed.meshed(fine.extent, 1);
  const auto measured = [&] {
    const Result<LevelDistance> result =
        levelDistance(fine.mesh, fine.extent, coarse.mesh, kMetre, {2, 1e-3, 20'000}, meshed.jobs());
    REQUIRE(result);
    return result->distance.value();
  };
  const double before = measured().atLeast();
  CHECK(before < 0.1);
  // Change the mesh's origin and, by the opposite amount, its positions: the mesh stays at the same place.
  const Int3 origin = coarse.mesh.origin;
  coarse.mesh.origin = {origin.x - 5 * kMetre, origin.y, origin.z + kMetre};
  for (std::array<double, 3>& p : coarse.mesh.positions) p = {p[0] + 5, p[1], p[2] - 1};
  CHECK(measured().atLeast() == Approx(before).epsilon(1e-6));
  coarse.mesh.origin.y += kMetre / 2;
  const measure::Hausdorff moved = measured();
  CHECK(moved.there.at_least > 0.5 - before);
  CHECK(moved.back.at_least < 0.5 + before);
  // Remove all triangles of the coarse mesh.
  coarse.mesh.indices.clear();
  const Result<LevelDistance> vanished = levelDistance(fine.mesh, fine.extent, coarse.mesh, kMetre, {}, meshed.jobs());
  REQUIRE(vanished);
  CHECK_FALSE(vanished->distance);
  CHECK(vanished->fine_triangles > 0);
}
