// Tests texel densities of surfaces.

#include "measure/texel_density.h"

#include "../catch.h"
#include "../rounds.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

using Coordinates = std::vector<std::array<float, 2>>;

/// A square plate of n by n quadrangles, perpendicular to z.
Mesh plate(uint32_t n, double edge) {
  Mesh mesh;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) mesh.points.push_back({edge * x / n, edge * y / n, 0});
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = x + y * (n + 1), b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

template <class Map>
Coordinates mapped(const Mesh& mesh, Map&& map) {
  Coordinates coordinates;
  for (const Point p : mesh.points) {
    const auto [u, v] = map(p);
    coordinates.push_back({static_cast<float>(u), static_cast<float>(v)});
  }
  return coordinates;
}

TexelDensities densitiesOf(const Mesh& mesh, const Coordinates& coordinates, double resolution) {
  return texelDensities(mesh, coordinates, mesh.triangles, resolution);
}

}  // namespace

TEST_CASE("an even texture has one density, however it is turned and placed") {
  const uint32_t seed = 3;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(20); ++round) {
    const Mesh flat = plate(8, 2);
    const double scale = between(random, 0.1, 4), turn = between(random, 0, 6);
    const Coordinates coordinates = mapped(flat, [&](Point p) {
      return std::pair{scale * (std::cos(turn) * p.x - std::sin(turn) * p.y),
                       scale * (std::sin(turn) * p.x + std::cos(turn) * p.y)};
    });
    const TexelDensities d = densitiesOf(placed(flat, random, 1, 10), coordinates, 512);
    CHECK(d.triangles == flat.triangles.size());
    CHECK(d.unmapped + d.without_area == 0);
    CHECK(d.median == Approx(512 * scale).epsilon(1e-4));
    CHECK(d.ratio() < 1.001);
    CHECK(d.ratio() >= 1);
  }
}

TEST_CASE("quantiles are of the area, and the ratio is of the worst triangles") {
  // Half of the plate is twice as dense along u: it has sqrt(2) times as many texels per length.
  const Mesh flat = plate(8, 2);
  const Coordinates bent = mapped(flat, [](Point p) { return std::pair{p.x < 1 ? p.x : 2 * p.x - 1, p.y}; });
  const TexelDensities d = densitiesOf(flat, bent, 100);
  CHECK(d.least == Approx(100));
  CHECK(d.p5 == Approx(100));
  CHECK(d.p95 == Approx(100 * std::sqrt(2)));
  CHECK(d.most == Approx(100 * std::sqrt(2)));
  CHECK(d.ratio() == Approx(std::sqrt(2)));
  // Adds a small second plate: it has a hundredth of the area and ten times the texel density. The median must not
  // change.
  Mesh two = plate(1, 10);
  two.add(plate(1, 1).at({20, 0, 0}));
  const Coordinates dense = mapped(two, [](Point p) {
    return p.x < 15 ? std::pair{p.x, p.y} : std::pair{10 * p.x, 10 * p.y};
  });
  const TexelDensities uneven = densitiesOf(two, dense, 1);
  CHECK(uneven.median == Approx(1));
  CHECK(uneven.p95 == Approx(1));
  CHECK(uneven.most == Approx(10).epsilon(1e-3));
}

TEST_CASE("what has no area, here or there, is counted and left out") {
  Mesh flat = plate(2, 1);
  Coordinates coordinates = mapped(flat, [](Point p) { return std::pair{p.x, p.y}; });
  std::vector<Triangle> corners = flat.triangles;
  flat.triangles.push_back({0, 1, 1});
  corners.push_back({0, 1, 4});
  flat.triangles.push_back(flat.triangles[0]);
  corners.push_back({0, 0, 4});
  coordinates.push_back({std::nanf(""), 0});
  flat.triangles.push_back(flat.triangles[1]);
  corners.push_back({0, 1, static_cast<uint32_t>(coordinates.size() - 1)});
  const TexelDensities d = texelDensities(flat, coordinates, corners, 64);
  CHECK(d.triangles == 8);
  CHECK(d.without_area == 1);
  CHECK(d.unmapped == 2);
  CHECK(d.least == Approx(64));
  CHECK(d.ratio() == Approx(1));
  const TexelDensities none = texelDensities({}, {}, {}, 64);
  CHECK(none.triangles == 0);
  CHECK(none.ratio() == 0);
}

}  // namespace sgm::measure
