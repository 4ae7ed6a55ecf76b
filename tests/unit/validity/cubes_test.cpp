// Tests that a cube at any angle stays crisp: its sharp surface differs from the cube's by at most 1/20 of a cell.

#include <cstdio>

#include "measure/hausdorff.h"
#include "random_solids.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

constexpr double kFarthestOff = 0.05;  // in cells: maximum distance between the two surfaces
constexpr double kLookedFor = 0.01;    // in cells: error bound of the computed maximum distance

using Axes = std::array<measure::Point, 3>;

/// The axes after rotations about y, x and z in degrees; the rotation about z is applied first, as in the grammar
/// language.
Axes turned(const std::array<double, 3>& degrees) {
  Axes axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto rotate = [](int about, double angle, measure::Point p) {
    const double s = std::sin(angle * 3.14159265358979323846 / 180), c = std::cos(angle * 3.14159265358979323846 / 180);
    const int u = (about + 1) % 3, v = (about + 2) % 3;
    measure::Point q = p;
    q[u] = c * p[u] - s * p[v];
    q[v] = s * p[u] + c * p[v];
    return q;
  };
  for (measure::Point& axis : axes) axis = rotate(1, degrees[0], rotate(0, degrees[1], rotate(2, degrees[2], axis)));
  return axes;
}

asset::TriangleMesh cube(measure::Point centre, const Axes& axes, const std::array<double, 3>& sides) {
  asset::TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    measure::Point p = centre;
    for (size_t k = 0; k < 3; ++k) p = p + ((corner >> k & 1) != 0 ? 0.5 : -0.5) * sides[k] * axes[k];
    mesh.points.push_back(p);
  }
  for (const std::array<uint32_t, 4>& s : std::array<std::array<uint32_t, 4>, 6>{
           {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}}) {
    mesh.triangles.push_back({s[0], s[1], s[2]});
    mesh.triangles.push_back({s[0], s[2], s[3]});
  }
  return mesh;
}

struct TurnedCube {
  std::array<double, 3> degrees{}, sides{}, centre{};
  std::string text;

  explicit TurnedCube(unsigned seed) {
    std::mt19937 random(seed);
    for (size_t k = 0; k < 3; ++k) {
      degrees[k] = between(random, 0, 360);
      sides[k] = between(random, 4, 7);
      // Positions are rounded to whole units, as positions of shapes are.
      centre[k] = std::round(between(random, -1, 1) * kUnitsPerMetre) / kUnitsPerMetre;
    }
    char grammar[512];
    std::snprintf(
        grammar, sizeof grammar,
        "sgm 1; units m; domain finite box(32m, 32m, 32m) empty; start B; rule B { at(%.10fm, %.10fm, %.10fm) "
        "rot(y, %.10fdeg) rot(x, %.10fdeg) rot(z, %.10fdeg) box(%.10fm, %.10fm, %.10fm); }",
        centre[0], centre[1], centre[2], degrees[0], degrees[1], degrees[2], sides[0], sides[1], sides[2]);
    text = grammar;
  }

  asset::TriangleMesh truth() const { return cube({centre[0], centre[1], centre[2]}, turned(degrees), sides); }
};

asset::TriangleMesh sharpMesh(const TurnedCube& turned_cube, double cell, const ReportContext& shop) {
  const WorldField world(worldOf(compiled(turned_cube.text), cell, 1), std::pmr::get_default_resource());
  const int32_t most = 8 * kUnitsPerMetre;
  return meshedRegion(world, shop, {{-most, -most, -most}, {most, most, most}}, true).mesh;
}

}  // namespace

TEST_CASE("cubes at any angle deviate by a twentieth of a cell", "[validity][cubes][costly]") {
  const ReportContext shop;
  double farthest = 0;
  size_t seen = 0;
  for (unsigned seed = 1; seed <= rounds(15); ++seed) {
    const TurnedCube turned_cube(seed);
    const asset::TriangleMesh truth = turned_cube.truth();
    for (const double cell : kSolidCells) {
      const asset::TriangleMesh mesh = sharpMesh(turned_cube, cell, shop);
      measure::HausdorffSettings settings;
      settings.tolerance = kLookedFor * cell;
      const Result<measure::Hausdorff> found =
          measure::hausdorff({mesh.points, mesh.triangles}, {truth.points, truth.triangles}, settings, *shop.jobs);
      REQUIRE(found);
      CAPTURE(seed, cell, turned_cube.text, found->there.at_least / cell, found->back.at_least / cell);
      const measure::Point& at = (found->there.at_least < found->back.at_least ? found->back : found->there).farthest;
      CAPTURE(at.x, at.y, at.z);
      CHECK(found->atLeast() <= kFarthestOff * cell);
      ++seen;
      farthest = std::max(farthest, found->atLeast() / cell);
    }
  }
  std::printf("cubes: %zu, the farthest place is %.4f cells off\n", seen, farthest);
}

TEST_CASE("wedges whose edges touch samples are valid", "[validity][cubes][sharp][costly]") {
  // A sample that touches the edge of a wedge often becomes a tiny solid component of its own, 1/256 of a cell wide.
  // The sharp edge of the wedge must not enclose this component. In an earlier version it did, for the first two seeds.
  constexpr unsigned kFirst = 241;
  const ReportContext shop;
  for (unsigned seed = kFirst; seed < kFirst + rounds(60); ++seed) {
    TurnedCube wedge(seed);
    std::mt19937 random(seed);
    const double cell = kSolidCells[seed % 2], sample = std::floor(cell * kUnitsPerMetre) / kUnitsPerMetre;
    const Axes axes = turned(wedge.degrees);
    // The edge of the wedge runs along y. The wedge is placed so that a sample lies 0 to 3 units inside of this edge.
    const double within = between(random, 0, 3) / kUnitsPerMetre, half = between(random, 0.5, 2.5);
    measure::Point at = -within * axes[0] + between(random, -2, 2) * axes[1];
    for (int k = 0; k < 3; ++k) at[k] += sample * static_cast<double>(random() % 5);
    char grammar[512];
    std::snprintf(grammar, sizeof grammar,
                  "sgm 1; units m; domain finite box(32m, 32m, 32m) empty; start W; rule W { at(%.10fm, %.10fm, "
                  "%.10fm) rot(y, %.10fdeg) rot(x, %.10fdeg) rot(z, %.10fdeg) prism(6m, (0m, 0m), (4m, %.4fm), (4m, "
                  "%.4fm)); }",
                  at.x, at.y, at.z, wedge.degrees[0], wedge.degrees[1], wedge.degrees[2], -half, half);
    wedge.text = grammar;
    const Faults faults = faultsOf(sharpMesh(wedge, cell, shop), nullptr, *shop.jobs);
    CAPTURE(seed, cell, wedge.text);
    INFO(faults);
    CHECK(faults.valid);
  }
}

TEST_CASE("a cube at any angle is valid", "[validity][cubes][sharp][costly]") {
  const ReportContext shop;
  size_t seen = 0, valid = 0;
  for (unsigned seed = 1; seed <= rounds(100); ++seed) {
    const TurnedCube turned_cube(seed);
    for (const double cell : kSolidCells) {
      const Faults faults = faultsOf(sharpMesh(turned_cube, cell, shop), nullptr, *shop.jobs);
      CAPTURE(seed, cell, turned_cube.text);
      INFO(faults);
      CHECK(faults.valid);
      ++seen;
      valid += faults.valid;
    }
  }
  std::printf("cubes: %zu of %zu valid\n", valid, seen);
}
