// Tests shells, objects, borders and genus: of known meshes, and of random meshes, by comparison with the lattices from
// which they were made.

#include "measure/shells.h"

#include "../catch.h"
#include "../rounds.h"
#include "measure/nesting.h"
#include "mesh/check.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

Shells shellsIn(const Mesh& mesh) { return shellsOf(mesh, Edges(mesh), Point{}); }

MeshReport identityOf(const Mesh& mesh) {
  std::vector<uint32_t> indices;
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  return checkTriangles(indices, mesh.points.size());
}

}  // namespace

TEST_CASE("balls, rings, boxes and what is cut from them", "[shells]") {
  SECTION("one of each") {
    Mesh mesh = ball(2);
    mesh.add(torus(12).at({10, 0, 0}));
    mesh.add(box({1, 1, 1}, 2).at({20, 0, 0}));
    const Shells found = shellsIn(mesh);
    REQUIRE(found.shells.size() == 3);
    CHECK(found.objects == 3);
    CHECK(found.shells[0].triangles == 320);
    CHECK(found.shells[0].euler() == 2);
    CHECK(found.shells[0].genus() == 0u);
    CHECK(found.shells[1].euler() == 0);
    CHECK(found.shells[1].genus() == 1u);
    CHECK(found.shells[2].genus() == 0u);
    for (const Shell& shell : found.shells) CHECK(shell.closed());
  }
  SECTION("a ring without one triangle, and without two that touch in a corner") {
    Mesh mesh = torus(12);
    mesh.triangles.erase(mesh.triangles.begin() + 100);
    Shell shell = shellsIn(mesh).shells.at(0);
    CHECK(shell.border_edges == 3);
    CHECK(shell.borders == 1);
    CHECK(shell.manifold);
    CHECK(shell.genus() == 1u);
    // Removes the first and the fourth of the 6 triangles around a vertex, so that the vertex has two fans.
    Mesh pinched = torus(12);
    std::vector<size_t> around;
    for (size_t i = 0; i < pinched.triangles.size(); ++i)
      for (const uint32_t v : pinched.triangles[i])
        if (v == 50) around.push_back(i);
    REQUIRE(around.size() == 6);
    const auto shares = [&](size_t a, size_t b) {
      int common = 0;
      for (const uint32_t v : pinched.triangles[a])
        for (const uint32_t w : pinched.triangles[b]) common += v == w;
      return common > 1;
    };
    size_t other = 0;
    for (const size_t i : around)
      if (i != around[0] && !shares(around[0], i)) other = i;
    pinched.triangles.erase(pinched.triangles.begin() + static_cast<std::ptrdiff_t>(other));
    pinched.triangles.erase(pinched.triangles.begin() + static_cast<std::ptrdiff_t>(around[0]));
    shell = shellsIn(pinched).shells.at(0);
    CHECK_FALSE(shell.manifold);
    CHECK(shell.genus() == std::nullopt);
    CHECK(shell.border_edges == 6);
  }
  SECTION("a tube has two borders") {
    Mesh mesh = box({1, 1, 1}, 3);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return mesh.points[v].z == 0; }) ||
             std::all_of(t.begin(), t.end(), [&](uint32_t v) { return mesh.points[v].z == 1; });
    });
    const Shell shell = shellsIn(mesh).shells.at(0);
    CHECK(shell.borders == 2);
    CHECK(shell.euler() == 0);
    CHECK(shell.genus() == 0u);
  }
  SECTION("two boxes that share a corner are one object and two shells; those that share an edge one shell") {
    Mesh corner = box({1, 1, 1});
    Mesh other = box({1, 1, 1}).at({1, 1, 1});
    corner.add(other);
    const auto weld = [](Mesh mesh) {
      for (Triangle& t : mesh.triangles)
        for (uint32_t& v : t)
          for (uint32_t w = 0; w < v; ++w)
            if (mesh.points[w] == mesh.points[v]) v = w;
      return mesh;
    };
    Shells found = shellsIn(weld(corner));
    CHECK(found.objects == 1);
    CHECK(found.shells.size() == 2);
    CHECK_FALSE(found.shells[0].manifold);
    CHECK_FALSE(found.shells[1].manifold);
    CHECK(found.shells[0].euler() == 2);

    Mesh edge = box({1, 1, 1});
    edge.add(box({1, 1, 1}).at({1, 1, 0}));
    found = shellsIn(weld(edge));
    CHECK(found.shells.size() == 1);
    CHECK_FALSE(found.shells[0].manifold);
  }
  SECTION("triangles with a corner twice connect objects, and are in no shell") {
    Mesh mesh = ball(1);
    const auto first = static_cast<uint32_t>(mesh.points.size());
    mesh.add(ball(1).at({5, 0, 0}));
    mesh.triangles.push_back({0, first, first});
    const Shells found = shellsIn(mesh);
    CHECK(found.objects == 1);
    CHECK(found.shells.size() == 2);
    CHECK(found.of_triangle.back() == kNoShell);
    CHECK(found.shells[0].genus() == 0u);
  }
  SECTION("a strip turned by half a turn has one side, and no genus") {
    Mesh mesh;
    constexpr uint32_t kSteps = 12;
    for (uint32_t i = 0; i < kSteps; ++i) {
      const double u = 2 * std::numbers::pi * i / kSteps;
      for (const double side : {-0.3, 0.3}) {
        const double r = 1 + side * std::cos(u / 2);
        mesh.points.push_back({r * std::cos(u), r * std::sin(u), side * std::sin(u / 2)});
      }
    }
    for (uint32_t i = 0; i < kSteps; ++i) {
      const uint32_t a = 2 * i, b = 2 * i + 1, c = i + 1 < kSteps ? 2 * i + 2 : 1, d = i + 1 < kSteps ? 2 * i + 3 : 0;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
    const Shell shell = shellsIn(mesh).shells.at(0);
    CHECK_FALSE(shell.manifold);
    CHECK(shell.borders == 1);
    CHECK(shell.euler() == 0);
  }
  SECTION("nothing") {
    CHECK(shellsIn({}).shells.empty());
    CHECK(shellsIn({}).objects == 0);
  }
}

TEST_CASE("the two ways to count agree on random surfaces, whole and damaged", "[shells]") {
  size_t pinched = 0, open = 0, handles = 0;
  for (unsigned seed = 0; seed < std::max(rounds(150), 60u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Mesh mesh = randomSurface(random, 7, between(random, 0.2, 0.8));
    for (uint32_t n = random() % 4; n > 0 && !mesh.triangles.empty(); --n) {
      const size_t at = random() % mesh.triangles.size();
      switch (random() % 3) {
        case 0:
          mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        case 1:
          std::swap(mesh.triangles[at][0], mesh.triangles[at][1]);
          break;
        case 2:
          mesh.triangles[at][random() % 3] = static_cast<uint32_t>(random() % mesh.points.size());
          break;
      }
    }
    const MeshReport identity = identityOf(mesh);
    const Shells found = shellsIn(mesh);
    uint64_t edges = 0, borders = 0, triangles = 0;
    bool manifold = true;
    for (const Shell& shell : found.shells) {
      edges += shell.edges;
      borders += shell.border_edges;
      triangles += shell.triangles;
      manifold = manifold && shell.manifold;
      handles += shell.genus().value_or(0);
    }
    CHECK(edges == identity.edges);
    CHECK(borders == identity.open_edges);
    CHECK(triangles + identity.degenerate_triangles == identity.triangles);
    CHECK(manifold == (identity.unmatched_edges == identity.open_edges && identity.repeated_edges == 0 &&
                       identity.non_manifold_edges == 0 && identity.pinched_vertices == 0));
    pinched += identity.pinched_vertices > 0;
    open += borders > 0;
  }
  CHECK(pinched > 3);
  CHECK(open > 10);
  CHECK(handles > 20);
}

TEST_CASE("how deep a place lies is what the winding number says", "[shells]") {
  const auto jobs = std::move(*makeThreadPool(2));
  int inside = 0;
  for (unsigned seed = 0; seed < rounds(30); ++seed) {
    std::mt19937 random(seed);
    Mesh mesh = randomSurface(random, 6);
    mesh.add(ball(1).moved([](Point p) { return Point{2.5, 2.5, 2.5} + 2.0 * p; }));
    const Shells parts = shellsIn(mesh);
    const Bvh tree(mesh, *jobs);
    for (int n = 0; n < 50; ++n) {
      // Every second point lies exactly below a corner of the surface.
      Point at{between(random, 0, 5), between(random, 0, 5), between(random, 0, 5)};
      if (n % 2 == 0) {
        const Point corner = mesh.points[random() % mesh.points.size()];
        at = {corner.x, corner.y, at.z};
      }
      const double winding = windingNumber(mesh, at);
      if (std::fabs(winding - std::round(winding)) > 1e-6) continue;  // the point lies on the surface of a shell
      CAPTURE(seed, n, at.x, at.y, at.z);
      CHECK(depthAt(mesh, tree, parts, kNoShell, at, 1u << 20) == static_cast<int>(std::round(winding)));
      CHECK(depthAt(mesh, tree, parts, kNoShell, at, 0) == std::nullopt);
      inside += winding > 0.5;
    }
  }
  CHECK(inside > 20);
}

}  // namespace sgm::measure
