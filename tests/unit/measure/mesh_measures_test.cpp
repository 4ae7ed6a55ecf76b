// Tests mesh measures: valid meshes pass, and every kind of defect is found in each of a hundred meshes.

#include "measure/mesh_measures.h"

#include <algorithm>
#include <memory>

#include "../catch.h"
#include "../rounds.h"
#include "defects.h"

namespace sgm::measure {
namespace {

MeshMeasures measured(const Mesh& mesh, const MeshSettings& settings = {}) {
  const auto jobs = std::move(*makeThreadPool(2));
  return *measureMesh(mesh, settings, *jobs);
}

size_t placesOf(const MeshMeasures& m, DefectKind kind) {
  return static_cast<size_t>(
      std::count_if(m.places.begin(), m.places.end(), [&](const DefectPlace& p) { return p.kind == kind; }));
}

/// Checks that every counted kind of defect has places, and that each place lies at the triangle that it names.
void checkPlaces(const Mesh& mesh, const MeshMeasures& m) {
  const auto shown = [&](DefectKind kind, uint64_t count) {
    CAPTURE(nameOf(kind));
    CHECK(placesOf(m, kind) == std::min<uint64_t>(count, kMaxExamples));
  };
  shown(DefectKind::open_edge, m.identity.open_edges - m.cut_edges);
  shown(DefectKind::nonmanifold_edge, m.identity.non_manifold_edges);
  if (m.identity.non_manifold_edges == 0) {
    shown(DefectKind::turned_edge, m.identity.unmatched_edges - m.identity.open_edges);
    if (m.identity.unmatched_edges == m.identity.open_edges)
      shown(DefectKind::pinched_vertex, m.identity.pinched_vertices);
  }
  shown(DefectKind::degenerate, m.identity.degenerate_triangles);
  shown(DefectKind::flat, m.flat_triangles);
  shown(DefectKind::duplicate, m.identity.duplicate_triangles);
  shown(DefectKind::inside_out, m.nesting.inside_out);
  shown(DefectKind::nested, m.nesting.nested);
  shown(DefectKind::folded, m.self_intersections->folded);
  shown(DefectKind::self_intersection, m.self_intersections->cuts());
  for (const DefectPlace& place : m.places) {
    const Triangle& t = mesh.triangles[place.triangle];
    Point low = mesh.points[t[0]], high = low;
    for (const uint32_t v : t) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], mesh.points[v][axis]);
        high[axis] = std::max(high[axis], mesh.points[v][axis]);
      }
    }
    const double rounding = 1e-12 * (length(low) + length(high));
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(place.at[axis] >= low[axis] - rounding);
      CHECK(place.at[axis] <= high[axis] + rounding);
    }
  }
}

}  // namespace

TEST_CASE("a thousand good meshes raise no alarm", "[measures]") {
  for (unsigned seed = 0; seed < rounds(1000); ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = goodMesh(random);
    const MeshMeasures found = measured(mesh);
    CAPTURE(seed, mesh.triangles.size(), describe(found.identity), found.self_intersections->pairs,
            found.nesting.inside_out);
    CHECK(found.watertight());
    CHECK(found.valid());
    CHECK(found.withoutArea() == 0);
    CHECK(found.genus().has_value());
    CHECK(found.sums.volume > 0);
    CHECK(found.welded_points == 0);
  }
}

TEST_CASE("each kind of damage is found in each of a hundred meshes", "[measures]") {
  for (const Defect& defect : defects()) {
    unsigned missed = 0;
    for (unsigned seed = 0; seed < rounds(100); ++seed) {
      std::mt19937 random(seed);
      Mesh mesh = goodMesh(random);
      defect.make(mesh, random);
      const MeshMeasures found = measured(mesh);
      const bool told = defect.found(found) && !found.valid();
      CAPTURE(defect.name, seed, mesh.triangles.size(), describe(found.identity));
      CHECK(told);
      missed += !told;
      checkPlaces(mesh, found);
    }
    CHECK(missed == 0);
  }
}

TEST_CASE("open edges in the faces of the box that a mesh was cut from are no holes", "[measures]") {
  for (unsigned seed = 0; seed < rounds(100); ++seed) {
    std::mt19937 random(seed);
    Mesh mesh = box({4, 4, 4}, 4);
    // Removes the box's top, so that the box is open only at y = 4.
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return mesh.points[v].y == 4; });
    });
    MeshSettings settings;
    settings.cut = Cut{{-10, -10, -10}, {10, 4, 10}};
    MeshMeasures found = measured(mesh, settings);
    CHECK(found.identity.open_edges == 16);
    CHECK(found.cut_edges == 16);
    CHECK(found.validButForCut());
    CHECK_FALSE(found.valid());
    CHECK(found.places.empty());
    CHECK_FALSE(measured(mesh).validButForCut());
    // A hole that is not in the faces of the cut still counts as a hole.
    const Triangle lost = mesh.triangles[random() % mesh.triangles.size()];
    std::erase(mesh.triangles, lost);
    const uint64_t at_top = static_cast<uint64_t>(
        std::count_if(lost.begin(), lost.end(), [&](uint32_t v) { return mesh.points[v].y == 4; }));
    found = measured(mesh, settings);
    CAPTURE(seed, at_top);
    CHECK_FALSE(found.validButForCut());
    CHECK(found.identity.open_edges - found.cut_edges == (at_top >= 2 ? 2u : 3u));
    checkPlaces(mesh, found);
  }
}

TEST_CASE("shells that face inward are cavities within a solid, and inside out elsewhere", "[measures]") {
  Mesh mesh = ball(3).moved([](Point p) { return 3.0 * p; });
  Mesh hollow = ball(2).at({1, 0, 0});
  hollow.invert();
  mesh.add(hollow);
  MeshMeasures found = measured(mesh);
  CHECK(found.nesting.cavities == 1);
  CHECK(found.nesting.inside_out == 0);
  CHECK(found.valid());
  CHECK(found.parts.objects == 2);

  mesh.add(hollow.at({10, 0, 0}));
  found = measured(mesh);
  CHECK(found.nesting.cavities == 1);
  CHECK(found.nesting.inside_out == 1);
  CHECK_FALSE(found.valid());
}

TEST_CASE("shells beside a cut stand in the solid that the open shells bound", "[measures]") {
  for (unsigned seed = 0; seed < rounds(50); ++seed) {
    std::mt19937 random(seed);
    const int axis = static_cast<int>(random() % 3);
    const double face = random() % 2 == 0 ? 0 : 4;
    CAPTURE(seed, axis, face);
    // The surface of a box, without the face that lies in the cutting plane.
    Mesh cut_box = box({4, 4, 4}, 4);
    std::erase_if(cut_box.triangles, [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return cut_box.points[v][axis] == face; });
    });
    MeshSettings settings;
    settings.cut = Cut{{-20, -20, -20}, {20, 20, 20}};
    (face == 0 ? settings.cut->low : settings.cut->high)[axis] = face;
    const Mesh small = ball(1).moved([](Point p) { return 0.25 * p; });
    const Point within{between(random, 1, 3), between(random, 1, 3), between(random, 1, 3)};
    Point outside = within;
    const int off = (axis + 1 + static_cast<int>(random() % 2)) % 3;
    outside[off] += random() % 2 == 0 ? 4 : -4;
    const auto nestingWith = [&](Point at, bool inward) {
      Mesh mesh = cut_box, other = small.at(at);
      if (inward) other.invert();
      mesh.add(other);
      const MeshMeasures found = measured(mesh, settings);
      CHECK(found.cut_edges == 16);
      CHECK(found.identity.open_edges == 16);
      CHECK(found.validButForCut() == (found.nesting.inside_out + found.nesting.nested == 0));
      return std::array<uint64_t, 3>{found.nesting.cavities, found.nesting.inside_out, found.nesting.nested};
    };
    CHECK(nestingWith(within, true) == std::array<uint64_t, 3>{1, 0, 0});
    CHECK(nestingWith(within, false) == std::array<uint64_t, 3>{0, 0, 1});
    CHECK(nestingWith(outside, false) == std::array<uint64_t, 3>{0, 0, 0});
    CHECK(nestingWith(outside, true) == std::array<uint64_t, 3>{0, 1, 0});

    // A solid ball inside a cavity is valid: its surface faces outward again. A hollow in this ball counts as a second
    // cavity.
    Mesh nested = cut_box, cavity = small.at(within), core = small.moved([](Point p) { return 0.5 * p; }).at(within);
    cavity.invert();
    nested.add(cavity);
    nested.add(core);
    CHECK(measured(nested, settings).validButForCut());
    core.invert();
    nested.add(core.moved([&](Point p) { return within + 0.5 * (p - within); }));
    CHECK(measured(nested, settings).nesting.cavities == 2);
    CHECK(measured(nested, settings).validButForCut());
    // If no shell is open, an inverted ball counts as a cavity in a solid that extends beyond the cut. With a second
    // ball that faces outward, there is void around both balls, so the inverted ball is inside out.
    Mesh alone = cavity;
    CHECK(measured(alone, settings).nesting.cavities == 1);
    alone.add(small.at(outside));
    CHECK(measured(alone, settings).nesting.inside_out == 1);
    // Without settings.cut, the open shell encloses nothing, so the inverted ball is inside out.
    Mesh uncut = cut_box;
    uncut.add(cavity);
    CHECK(measured(uncut, settings).nesting.cavities == 1);
    settings.cut.reset();
    CHECK(measured(uncut, settings).nesting.inside_out == 1);
  }
}

TEST_CASE("files repeat points, and have some that nothing uses", "[measures]") {
  Mesh soup;
  for (const Triangle& t : torus(8).triangles) {
    for (const uint32_t v : t) soup.points.push_back(torus(8).points[v]);
    const auto n = static_cast<uint32_t>(soup.points.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  soup.points.push_back({std::nan(""), 0, 0});
  const MeshMeasures found = measured(soup);
  CHECK(found.valid());
  CHECK(found.genus() == 1u);
  CHECK(found.euler() == 0);
  CHECK(found.points == 3 * 128 + 1);
  CHECK(found.unused_points == 1);
  CHECK(found.welded_points == 3 * 128 - 64);
}

TEST_CASE("nothing is measured as nothing", "[measures]") {
  const MeshMeasures found = measured({});
  CHECK(found.watertight());
  CHECK(found.sums.area == 0);
  CHECK(found.parts.objects == 0);
  CHECK(found.genus() == 0u);
  CHECK(found.histogram.edges == 0);
}

namespace {

/// A tetrahedron that is the corner of a cube, oriented outward.
Mesh tetrahedron(double size = 1) {
  return Mesh{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

}  // namespace

TEST_CASE("only closed manifold shells make a place lie in a solid", "[measures]") {
  Mesh mesh = tetrahedron();
  SECTION("two that touch in a corner do not stand in each other") {
    mesh.add(tetrahedron().moved([](Point p) { return -1.0 * p; }));
    for (size_t i = 4; i < 8; ++i) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    const MeshMeasures found = measured(mesh);
    CHECK(found.nesting.nested == 0);
    CHECK(found.identity.pinched_vertices == 1);
    CHECK_FALSE(found.valid());
  }
  SECTION("a roof over a body is no solid") {
    mesh.add(Mesh{{{-5, -5, 9}, {5, -5, 9}, {5, 5, 9}, {-5, 5, 9}}, {{0, 1, 2}, {0, 2, 3}}});
    CHECK(measured(mesh).nesting.nested == 0);
    std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
    std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
    CHECK(measured(mesh).nesting.nested == 0);
  }
  SECTION("a body in a cavity in a body is well") {
    Mesh cavity = ball(2).moved([](Point p) { return 5.0 * p; });
    cavity.invert();
    mesh.add(cavity);
    mesh.add(ball(2).moved([](Point p) { return 8.0 * p; }));
    const MeshMeasures found = measured(mesh);
    CHECK(found.nesting.cavities == 1);
    CHECK(found.nesting.nested == 0);
    CHECK(found.valid());
  }
}

TEST_CASE("no number is too large or too small to be told from a good mesh", "[measures]") {
  for (const double size : {1e-60, 1e-30, 1e-3, 1e10, 1e30, 9e36}) {
    CAPTURE(size);
    Mesh mesh = ball(2).moved([size](Point p) { return size * p; });
    CHECK(measured(mesh).valid());
    mesh.invert();
    CHECK_FALSE(measured(mesh).valid());
  }
  for (const double size : {1.1e37, 1e80, 1e120, 1e300}) {
    CAPTURE(size);
    const MeshMeasures found = measured(tetrahedron(size));
    CHECK(found.non_finite == 4);
    CHECK(found.first_non_finite == 0u);
    CHECK_FALSE(found.valid());
  }
  Mesh part = ball(1);
  part.points.push_back({1e38, 0, 0});
  part.triangles.insert(part.triangles.begin(), {0, 1, static_cast<uint32_t>(part.points.size() - 1)});
  part.add(ball(1).at({0.5, 0, 0}));
  const MeshMeasures found = measured(part);
  CHECK(found.non_finite == 1);
  REQUIRE(found.self_intersections->pairs > 0);
  // Reported triangle numbers refer to the input.
  for (const auto& [a, b] : found.self_intersections->examples) {
    CHECK(a >= 1);
    CHECK(a < 81);
    CHECK(b >= 81);
  }
  CHECK(found.parts.of_triangle.size() == part.triangles.size());
  CHECK(found.parts.of_triangle[0] == kNoShell);
}

TEST_CASE("meshes that were made to take long are measured, or said not to be", "[measures]") {
  SECTION("fans whose triangles all lie around one point") {
    Mesh mesh;
    constexpr uint32_t kSides = 3000;
    mesh.points = {{0, 0, 0}, {0, 0, 1}};
    for (uint32_t i = 0; i < kSides; ++i) {
      const double u = 2 * std::numbers::pi * i / kSides;
      for (const double z : {0.0, 1.0}) mesh.points.push_back({std::cos(u), std::sin(u), z});
    }
    for (uint32_t i = 0; i < kSides; ++i) {
      const uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % kSides);
      mesh.triangles.insert(mesh.triangles.end(), {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
    }
    CHECK(measured(mesh).valid());
  }
  SECTION("many bodies above each other") {
    Mesh mesh;
    for (uint32_t i = 0; i < 2000; ++i) mesh.add(tetrahedron(0.5).at({0, 0, static_cast<double>(i)}));
    MeshSettings settings;
    const MeshMeasures found = measured(mesh, settings);
    CHECK(found.nesting.nested == 0);
    CHECK(found.complete());
    settings.steps_a_triangle = 10;
    const MeshMeasures hasty = measured(mesh, settings);
    CHECK(hasty.nesting.not_judged > 0);
    CHECK_FALSE(hasty.complete());
    CHECK_FALSE(hasty.valid());
  }
  SECTION("one triangle far from many small ones in disorder") {
    std::mt19937 random(1);
    Mesh mesh;
    std::vector<Point> places;
    for (uint32_t i = 0; i < 20000; ++i) places.push_back({between(random, 0, 1), between(random, 0, 1), 0});
    for (const Point& at : places) mesh.add(tetrahedron(0.001).at(at));
    mesh.add(tetrahedron().at({9e5, 0, 0}));
    const MeshMeasures found = measured(mesh);
    CHECK(found.complete());
    CHECK(found.parts.shells.size() == 20001);
  }
  SECTION("a tolerance below the distance from one number to the next") {
    Mesh mesh;
    for (uint32_t i = 0; i < 5000; ++i) mesh.add(tetrahedron().at({2.0 * i, 0, 0}));
    MeshSettings settings;
    settings.weld = 1e-310;
    CHECK(measured(mesh, settings).valid());
  }
  SECTION("more columns of cubes than may be looked at") {
    const Mesh mesh{{{0, 0, 0}, {20000, 0, 0}, {0, 20000, 0}}, {{0, 1, 2}}};
    MeshSettings settings;
    settings.cubes = 1;
    const auto jobs = std::move(*makeThreadPool(1));
    CHECK(measureMesh(mesh, settings, *jobs).error().message ==
          "the mesh's box holds more than 2^30 cubes: choose larger ones");
    settings.cubes = 8;
    Mesh many;
    for (int i = 0; i < 200; ++i) many.add(mesh.at({0, 0, static_cast<double>(i)}));
    CHECK(measureMesh(many, settings, *jobs).error().message ==
          "the mesh's triangles lie over more than 2^27 columns of cubes: choose larger ones");
  }
}

TEST_CASE("sides of triangles with a corner twice are no edges", "[measures]") {
  Mesh mesh = tetrahedron();
  mesh.triangles.push_back({0, 1, 1});
  const MeshMeasures found = measured(mesh);
  CHECK(found.histogram.edges == 12);
  CHECK(found.histogram.left_out == 0);
  CHECK_FALSE(found.watertight());
}

TEST_CASE("measures are the same for any number of threads", "[measures]") {
  std::mt19937 random(5);
  Mesh mesh = torus(60);
  mesh.add(randomSurface(random, 12));
  MeshSettings settings;
  settings.cubes = 0.3;
  const auto with = [&](unsigned n) { return *measureMesh(mesh, settings, **makeThreadPool(n)); };
  const MeshMeasures one = with(1);
  for (const unsigned n : {2u, 4u}) {
    const MeshMeasures other = with(n);
    CHECK(other.sums.area == one.sums.area);
    CHECK(other.sums.volume == one.sums.volume);
    CHECK(other.histogram.shares == one.histogram.shares);
    CHECK(other.self_intersections->pairs == one.self_intersections->pairs);
    CHECK(other.self_intersections->folded == one.self_intersections->folded);
    CHECK(other.self_intersections->examples == one.self_intersections->examples);
    CHECK(other.cubes->centre == one.cubes->centre);
    CHECK(other.cubes->all == one.cubes->all);
    CHECK(other.cubes->any == one.cubes->any);
    CHECK(other.slivers == one.slivers);
    CHECK(other.parts.of_triangle == one.parts.of_triangle);
    CHECK(other.nesting.nested == one.nesting.nested);
    CHECK(other.euler() == one.euler());
  }
  CHECK(one.self_intersections->pairs > 0);
}

}  // namespace sgm::measure
