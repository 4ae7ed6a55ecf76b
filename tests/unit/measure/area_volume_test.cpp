// Tests areas and volumes against values that are known from geometry, and that the order of summation does not change
// them.

#include "measure/area_volume.h"

#include <memory>

#include "../catch.h"
#include "../rounds.h"
#include "measure/cube_volume.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

std::unique_ptr<JobSystem> threads(unsigned n) { return std::move(*makeThreadPool(n)); }

}  // namespace

TEST_CASE("a box has its area and volume, wherever it stands", "[area_volume]") {
  const auto jobs = threads(2);
  for (const double far : {0.0, 1.0, 1e3, 1e6}) {
    CAPTURE(far);
    const Mesh mesh = box({2, 3, 5}, 4).at({far, -far, far});
    const AreaVolume found = areaVolume(mesh, *jobs);
    CHECK(found.area == Approx(62).epsilon(1e-9));
    CHECK(found.volume == Approx(30).epsilon(1e-9));
    CHECK(length(found.area_vector) < 1e-9 * found.area);
    CHECK(found.low == Point{far, -far, far});
    CHECK(found.high == Point{far + 2, 3 - far, far + 5});
  }
}

TEST_CASE("area and volume of balls and rings converge with order 2", "[area_volume]") {
  constexpr double kPi = std::numbers::pi;
  const auto jobs = threads(2);
  const auto errors = [&](const Mesh& mesh, double area, double volume) {
    const AreaVolume found = areaVolume(mesh, *jobs);
    return std::array<double, 2>{found.area / area - 1, found.volume / volume - 1};
  };
  for (const bool ring : {false, true}) {
    std::array<double, 2> before{};
    for (int density = 1; density <= 5; ++density) {
      CAPTURE(ring, density);
      const std::array<double, 2> now = ring ? errors(torus(8u << density), 8 * kPi * kPi, 4 * kPi * kPi)
                                             : errors(ball(density), 4 * kPi, 4 * kPi / 3);
      for (size_t k = 0; density > 1 && k < 2; ++k) {
        CHECK(orderOf(before[k], now[k]) > 1.9);
        CHECK(orderOf(before[k], now[k]) < 2.1);
      }
      before = now;
    }
  }
}

TEST_CASE("a mesh inside out has the volume below 0; an open one knows it about any origin", "[area_volume]") {
  const auto jobs = threads(2);
  Mesh mesh = ball(2);
  const double volume = areaVolume(mesh, *jobs).volume;
  mesh.invert();
  CHECK(areaVolume(mesh, *jobs).volume == Approx(-volume));
  mesh.invert();

  for (unsigned seed = 0; seed < rounds(30); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    // Divides the mesh into two parts at random: the parts' volumes about one origin add up to that of the whole mesh.
    const Mesh whole = placed(ball(2), random, between(random, 0.1, 10), 100);
    Mesh parts[2] = {{whole.points, {}}, {whole.points, {}}};
    for (const Triangle& t : whole.triangles) parts[random() % 2].triangles.push_back(t);
    const Point origin{between(random, -100, 100), between(random, -100, 100), between(random, -100, 100)};
    const AreaVolume all = areaVolume(whole, *jobs);
    const AreaVolume one = areaVolume(parts[0], *jobs), two = areaVolume(parts[1], *jobs);
    CHECK(one.area + two.area == Approx(all.area).epsilon(1e-12));
    CHECK(one.volumeAbout(origin) + two.volumeAbout(origin) ==
          Approx(all.volume).epsilon(1e-9).margin(1e-10 * all.area * 200));
    CHECK(length(all.area_vector) < 1e-12 * all.area);
    if (!parts[0].triangles.empty() && !parts[1].triangles.empty()) CHECK(length(one.area_vector) > 1e-6 * all.area);
  }
}

TEST_CASE("sums have the same bits for any number of threads", "[area_volume]") {
  std::mt19937 random(7);
  const Mesh mesh = placed(torus(128), random, 3, 1000);
  const AreaVolume one = areaVolume(mesh, *threads(1));
  for (const unsigned n : {2u, 3u, 8u}) {
    const AreaVolume other = areaVolume(mesh, *threads(n));
    CHECK(other.area == one.area);
    CHECK(other.volume == one.volume);
    CHECK(other.area_vector == one.area_vector);
  }
  CHECK(areaVolume(Triangles{}, *threads(1)).area == 0);
}

TEST_CASE("cubes counted by the three rules", "[cube_volume]") {
  SECTION("a box on the grid has all of its cubes, by centres; corners on faces belong to one side") {
    const Mesh mesh = box({2, 3, 4});
    const CubeVolumes found = *cubeVolumes(mesh, {0, 0, 0}, {2, 3, 4}, 0.25);
    CHECK(found.centre == 8u * 12 * 16);
    // Samples on the box's low faces count as inside, samples on its high faces do not.
    CHECK(found.all == 7u * 11 * 15);
    CHECK(found.any == 9u * 13 * 17);
  }
  SECTION("of a ball the corner rules bracket the volume, and close in with order 1") {
    constexpr double kVolume = 4 * std::numbers::pi / 3;
    const Mesh mesh = ball(6);
    double before = 0;
    for (const int n : {16, 32, 64, 128}) {
      CAPTURE(n);
      const CubeVolumes found = *cubeVolumes(mesh, {-1, -1, -1}, {1, 1, 1}, 2.0 / n);
      CHECK(found.volumeOf(found.all) < kVolume);
      CHECK(found.volumeOf(found.any) > kVolume);
      CHECK(found.volumeOf(found.centre) == Approx(kVolume).epsilon(0.5 / n));
      const double width = found.volumeOf(found.any) - found.volumeOf(found.all);
      if (before > 0) CHECK(orderOf(before, width) == Approx(1).margin(0.1));
      before = width;
    }
  }
  SECTION("inside is where the winding number says") {
    for (unsigned seed = 0; seed < rounds(10); ++seed) {
      CAPTURE(seed);
      std::mt19937 random(seed);
      // For even seeds, the samples are half an edge of the lattice apart, so some of their coordinates equal those of
      // vertices.
      const Mesh mesh = randomSurface(random, 6);
      const double edge = seed % 2 == 0 ? 0.5 : between(random, 0.3, 0.7);
      const CubeVolumes found = *cubeVolumes(mesh, {0, 0, 0}, {5, 5, 5}, edge);
      uint64_t centres = 0, unsure = 0;
      const int n = static_cast<int>(std::floor(5 / edge)) + 3;
      for (int i = 0; i < n * n * n; ++i) {
        const Point at = edge * Point{i % n - 0.5, i / n % n - 0.5, i / n / n - 0.5};
        const double winding = windingNumber(mesh, at);
        centres += winding > 0.75;
        unsure += winding >= 0.25 && winding <= 0.75;
      }
      CHECK(found.centre >= centres);
      CHECK(found.centre <= centres + unsure);
    }
  }
  SECTION("what cannot be counted") {
    const Mesh mesh = box({2, 3, 4});
    CHECK(cubeVolumes(mesh, {0, 0, 0}, {2, 3, 4}, 0).error().message ==
          "the edge of the cubes that are counted must be more than 0");
    CHECK(cubeVolumes(mesh, {0, 0, 0}, {2, 3, 4}, 1e-6).error().message ==
          "the mesh's box holds more than 2^30 cubes: choose larger ones");
  }
}

}  // namespace sgm::measure
