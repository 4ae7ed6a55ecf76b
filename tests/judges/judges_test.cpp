// Compares our measures with those of CGAL and of Manifold, which share no code with this project.

#include <cstdlib>
#include <map>
#include <memory>

#include "../unit/catch.h"
#include "../unit/measure/defects.h"
#include "../unit/rounds.h"
#include "asset/read/mesh_file.h"
#include "measure/hausdorff.h"
#include "measure/self_intersection.h"
#include "measure/weld_points.h"
#include "meshes.h"

namespace sgm::measure {
namespace {

std::string setting(const char* name) {
  const char* const value = std::getenv(name);
  CAPTURE(name);
  REQUIRE(value != nullptr);
  return value;
}

std::vector<CgalVerdict> cgalOf(JudgedMeshes& meshes) {
  return meshes.judge<CgalVerdict>("'" + setting("SGM_JUDGE_CGAL") + "'");
}
std::vector<ManifoldVerdict> manifoldOf(JudgedMeshes& meshes) {
  return meshes.judge<ManifoldVerdict>("node '" + setting("SGM_JUDGE_MANIFOLD") + "' '" + setting("SGM_NODE_MODULES") +
                                       "'");
}

MeshMeasures measured(const Triangles& mesh) {
  const auto jobs = std::move(*makeThreadPool(2));
  return *measureMesh(mesh, {}, *jobs);
}

SelfIntersections crossings(const Triangles& mesh) {
  const auto jobs = std::move(*makeThreadPool(2));
  return selfIntersections(mesh, Bvh(mesh, *jobs), uint64_t{1} << 40, *jobs);
}

/// Closes a mesh that ends at the border of its region: each border loop gets a cone whose tip is the loop's first
/// point, moved outward. The closed mesh may intersect itself, which does not affect area and volume.
void closeBorders(Mesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (const Triangle& t : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      ++sides[{t[k], t[(k + 1) % 3]}];
      --sides[{t[(k + 1) % 3], t[k]}];
    }
  }
  std::map<uint32_t, uint32_t> next;
  for (const auto& [side, more] : sides)
    if (more > 0) REQUIRE(next.insert(side).second);
  while (!next.empty()) {
    const auto tip = static_cast<uint32_t>(mesh.points.size());
    uint32_t at = next.begin()->first;
    mesh.points.push_back(mesh.points[at] + Point{-8, -16, -4});
    while (next.contains(at)) {
      const uint32_t to = next.extract(at).mapped();
      mesh.triangles.push_back({to, at, tip});
      at = to;
    }
  }
}

Mesh cave(double cell) {
  const TemporaryFolder folder;
  const std::string file = (folder.path / "cave.glb").string();
  const std::string command = "'" + setting("SGM_COMMAND") + "' mesh '" + setting("SGM_CAVE") +
                              "' --region 64,64,64:128,128,128 --cell " + std::to_string(cell) + " --out '" + file +
                              "' >'" + file + ".txt'";
  REQUIRE(std::system(command.c_str()) == 0);
  const std::string bytes = contentOf(file);
  const Result<asset::TriangleMesh> read = asset::readMesh(std::as_bytes(std::span(bytes)), asset::MeshFileKind::glb);
  REQUIRE(read);
  const WeldedPoints welded = weldPoints({read->points, read->triangles});
  Mesh mesh{{welded.points.begin(), welded.points.end()}, {welded.triangles.begin(), welded.triangles.end()}};
  closeBorders(mesh);
  return mesh;
}

struct Named {
  std::string name;
  Mesh mesh;
};

/// Returns five shapes, each at five densities of triangles.
const std::vector<Named>& shapes() {
  static const std::vector<Named> all = [] {
    std::vector<Named> made;
    for (int density = 0; density < 5; ++density) {
      const auto n = uint32_t{1} << density;
      const auto add = [&](const char* name, const Mesh& mesh) {
        made.push_back({name + std::string(" ") + std::to_string(density), inFloats(mesh)});
      };
      std::mt19937 random(n);
      add("sphere", ball(1 + density));
      add("torus", torus(8 * n));
      add("box", box({1, 2, 3}, n));
      add("random field", randomSurface(random, 6 + 4 * static_cast<uint32_t>(density), 0.4));
      add("cave", cave(4.0 / n));
    }
    return made;
  }();
  return all;
}

bool near(double ours, double theirs) { return std::fabs(ours - theirs) <= 1e-5 * std::fabs(theirs); }

/// Makes random triangles with corners on a lattice of few points, so that corners on edges, common planes and common
/// corners are frequent.
Mesh latticeSoup(std::mt19937& random, uint32_t places, uint32_t triangles) {
  Mesh mesh;
  for (uint32_t i = 0; i < triangles; ++i) {
    Triangle t{};
    for (uint32_t& v : t) {
      if (!mesh.points.empty() && random() % 3 == 0) {
        v = any(random, mesh.points.size());
      } else {
        v = static_cast<uint32_t>(mesh.points.size());
        const auto place = [&] { return static_cast<double>(random() % places) / 3; };
        mesh.points.push_back({place(), place(), place()});
      }
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Makes random triangles at arbitrary positions, large and small.
Mesh soup(std::mt19937& random, uint32_t triangles) {
  Mesh mesh;
  const auto place = [&](double reach) {
    return Point{between(random, -reach, reach), between(random, -reach, reach), between(random, -reach, reach)};
  };
  for (uint32_t i = 0; i < triangles; ++i) {
    const Point at = place(10);
    for (int k = 0; k < 3; ++k) mesh.points.push_back(at + place(random() % 10 == 0 ? 10 : 1.5));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

}  // namespace

TEST_CASE("five shapes at five densities have CGAL's area and volume", "[cgal]") {
  JudgedMeshes meshes;
  for (const Named& shape : shapes()) meshes.add(shape.mesh);
  const std::vector<CgalVerdict> verdicts = cgalOf(meshes);
  for (size_t i = 0; i < shapes().size(); ++i) {
    const MeshMeasures ours = measured(shapes()[i].mesh);
    const CgalVerdict& theirs = verdicts[i];
    CAPTURE(shapes()[i].name, ours.triangles, ours.sums.area, theirs.area, ours.sums.volume, theirs.volume);
    CHECK(theirs.closed);
    CHECK(near(ours.sums.area, theirs.area));
    CHECK(near(ours.sums.volume, theirs.volume));
    CHECK(ours.parts.shells.size() == theirs.components);
    CHECK(ours.self_intersections->pairs == theirs.pairs);
    CHECK(ours.flat_triangles == theirs.flat);
    // Closing the border of a mesh with a cone can make the mesh intersect itself. So some of these meshes are invalid,
    // and both judges must say so.
    CHECK(ours.valid() == theirs.valid());
  }
}

TEST_CASE("five shapes at five densities have Manifold's area, volume and genus", "[manifold]") {
  JudgedMeshes meshes;
  for (const Named& shape : shapes()) meshes.add(shape.mesh);
  const std::vector<ManifoldVerdict> verdicts = manifoldOf(meshes);
  for (size_t i = 0; i < shapes().size(); ++i) {
    const MeshMeasures ours = measured(shapes()[i].mesh);
    const ManifoldVerdict& theirs = verdicts[i];
    CAPTURE(shapes()[i].name, ours.triangles, ours.sums.area, theirs.area, ours.sums.volume, theirs.volume);
    CHECK(theirs.status == "NoError");
    CHECK(near(ours.sums.area, theirs.area));
    CHECK(near(ours.sums.volume, theirs.volume));
    CHECK(ours.parts.shells.size() == theirs.parts);
    CHECK(static_cast<int64_t>(ours.genus().value_or(uint64_t{1} << 40)) == theirs.genus);
  }
}

// Differences between the counts of CGAL 5.5 and the rules of triangle_pair.h:
//  - Triangles without area: CGAL lists each as intersecting itself, and does not examine it further. By our rules such
//    a triangle intersects nothing, so the judge removes it from CGAL's list.
//  - A triangle and its reverse, joined along their edges (a closed surface of two triangles): CGAL examines one common
//    edge, and reports a fold. By our rules they are duplicates, which checkTriangles() counts; the judge follows them.
//  - CGAL before 6.0 cannot count intersections in soups or in surfaces with three triangles at an edge. The judge
//    therefore applies CGAL's predicates to all pairs, according to the number of point indices that the pair shares.
// CGAL's rules and ours agree on points with equal positions but different indices: these are different points, so
// triangles that touch there intersect.
TEST_CASE("CGAL counts as many pairs that meet in soups, on a lattice and off it", "[cgal]") {
  JudgedMeshes meshes;
  std::vector<uint64_t> ours;
  uint64_t all = 0, shared = 0;
  for (unsigned seed = 0; seed < rounds(300); ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = seed % 3 == 0 ? soup(random, 100 + any(random, 200))
                                    : latticeSoup(random, 2 + any(random, 6), 20 + any(random, 100));
    meshes.add(mesh, kSoup);
    ours.push_back(crossings(mesh).pairs);
    all += ours.back();
    shared += mesh.points.size() < 3 * mesh.triangles.size();
  }
  const std::vector<CgalVerdict> verdicts = cgalOf(meshes);
  for (unsigned seed = 0; seed < verdicts.size(); ++seed) {
    CAPTURE(seed);
    CHECK(ours[seed] == verdicts[seed].soup_pairs);
  }
  CHECK(all > 30 * verdicts.size());
  CHECK(shared > verdicts.size() / 2);
}

TEST_CASE("CGAL counts as many pairs that meet in damaged surfaces", "[cgal]") {
  JudgedMeshes meshes;
  std::vector<SelfIntersections> ours;
  std::vector<uint64_t> flat;
  for (unsigned seed = 0; seed < rounds(100); ++seed) {
    std::mt19937 random(seed);
    Mesh mesh = goodMesh(random);
    const double edge = length(mesh.points[mesh.triangles[0][0]] - mesh.points[mesh.triangles[0][1]]);
    switch (seed % 3) {
      case 0:
        // Move some points to random positions.
        for (uint32_t i = 0; i < 1 + any(random, 20); ++i) {
          Point& p = mesh.points[any(random, mesh.points.size())];
          p = p + (5 * edge) * Point{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
        }
        break;
      case 1:
        // Move all points a little, so that neighbouring triangles intersect each other.
        for (Point& p : mesh.points)
          p = p + (0.5 * edge) * Point{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
        break;
      default:
        // Snap all points to a coarse lattice: points coincide, triangles overlap in a plane, and many have no area.
        mesh = mesh.moved([&](Point p) {
          return Point{edge * std::round(p.x / edge), edge * std::round(p.y / edge), edge * std::round(p.z / edge)};
        });
        break;
    }
    // Add the mesh without welding equal points, so that its topology stays that of a surface.
    meshes.add(mesh, kSoup);
    ours.push_back(crossings(mesh));
    flat.push_back(measured(mesh).flat_triangles);
  }
  const std::vector<CgalVerdict> verdicts = cgalOf(meshes);
  uint64_t all = 0, flat_found = 0;
  for (unsigned seed = 0; seed < verdicts.size(); ++seed) {
    CAPTURE(seed);
    CHECK(verdicts[seed].manifold);
    CHECK(verdicts[seed].pairs == verdicts[seed].soup_pairs);
    CHECK(ours[seed].complete);
    CHECK(ours[seed].pairs == verdicts[seed].pairs);
    all += ours[seed].pairs;
    flat_found += verdicts[seed].flat;
  }
  CHECK(all > 10 * verdicts.size());
  CHECK(flat_found > verdicts.size());
}

TEST_CASE("CGAL finds the same good meshes good, and the same damaged ones bad", "[cgal]") {
  struct Case {
    std::string name;
    unsigned seed;
    bool valid;
    MeshMeasures measures;
  };
  JudgedMeshes meshes;
  std::vector<Case> cases;
  const auto add = [&](const char* name, unsigned seed, const Mesh& mesh) {
    meshes.add(mesh);
    const MeshMeasures ours = measured(mesh);
    cases.push_back({name, seed, ours.valid(), ours});
  };
  // The long run tests a hundred meshes with each kind of defect, and a thousand without.
  for (unsigned seed = 0; seed < rounds(100); ++seed) {
    std::mt19937 random(seed);
    add("good", seed, goodMesh(random));
  }
  for (const Defect& defect : defects()) {
    for (unsigned seed = 0; seed < rounds(10); ++seed) {
      std::mt19937 random(seed);
      Mesh mesh = goodMesh(random);
      defect.make(mesh, random);
      add(defect.name, seed, mesh);
    }
  }
  const std::vector<CgalVerdict> verdicts = cgalOf(meshes);
  unsigned good = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Case& here = cases[i];
    const CgalVerdict& theirs = verdicts[i];
    CAPTURE(here.name, here.seed, describe(here.measures.identity), theirs.finite, theirs.manifold, theirs.closed,
            theirs.flat, theirs.pairs, theirs.outward, theirs.bounds);
    CHECK(here.valid == theirs.valid());
    CHECK(theirs.valid() == (here.name == "good"));
    CHECK(here.measures.identity.manifold() == (theirs.manifold || !theirs.finite));
    if (theirs.manifold) {
      CHECK(here.measures.watertight() == theirs.closed);
      CHECK(here.measures.self_intersections->pairs == theirs.pairs);
      CHECK(here.measures.parts.shells.size() == theirs.components);
      CHECK(near(here.measures.sums.area, theirs.area));
    }
    good += theirs.valid();
  }
  CHECK(good == rounds(100));
}

TEST_CASE("CGAL finds the same nests of shells good and bad", "[cgal]") {
  JudgedMeshes meshes;
  std::vector<bool> ours;
  size_t good = 0;
  for (unsigned seed = 0; seed < rounds(100); ++seed) {
    std::mt19937 random(seed);
    Mesh mesh;
    // Make two stacks of up to four nested shells. Most shells are oriented as their nesting requires, some are not.
    for (uint32_t pile = 0; pile < 2; ++pile) {
      const uint32_t shells = 1 + any(random, 4);
      for (uint32_t i = 0; i < shells; ++i) {
        const double size = 8 >> i;
        Mesh shell = random() % 2 == 0 ? ball(1) : box({1, 1, 1}, 2).at({-0.5, -0.5, -0.5});
        if ((i % 2 == 1) != (random() % 8 == 0)) shell.invert();
        mesh.add(shell.moved([&](Point p) { return Point{20.0 * pile, 0, 0} + size * p; }));
      }
    }
    mesh = placed(mesh, random, 1, 10);
    meshes.add(mesh);
    ours.push_back(measured(mesh).valid());
    good += ours.back();
  }
  const std::vector<CgalVerdict> verdicts = cgalOf(meshes);
  for (unsigned seed = 0; seed < verdicts.size(); ++seed) {
    CAPTURE(seed, verdicts[seed].outward, verdicts[seed].bounds, verdicts[seed].pairs);
    CHECK(ours[seed] == verdicts[seed].valid());
  }
  CHECK(good > ours.size() / 4);
  CHECK(good < ours.size() * 3 / 4);
}

TEST_CASE("CGAL's distances lie between our bounds", "[cgal]") {
  constexpr double kError = 1e-3;
  const uint32_t seed = 11;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::vector<std::pair<Mesh, Mesh>> pairs{{ball(2), ball(3)},
                                           {ball(2), ball(2).moved([](Point p) { return 1.2 * p; })},
                                           {torus(16), torus(24).at({0.1, 0.05, 0})},
                                           {box({1, 2, 3}, 3), box({1.1, 2, 3}, 2)},
                                           {box({1, 1, 1}, 2), box({1, 1, 1}, 2).at({5, 0, 0})},
                                           {cave(2), cave(4)}};
  for (unsigned round = 0; round < rounds(100); ++round) {
    const Mesh first = goodMesh(random);
    const double size = between(random, 0.01, 0.3);
    const Mesh second = round % 2 == 0 ? goodMesh(random) : first.moved([&](Point p) {
      return p + size * Point{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
    });
    pairs.emplace_back(first, second);
  }
  JudgedMeshes meshes;
  std::vector<double> sizes;
  for (auto& [first, second] : pairs) {
    // Scale each pair of meshes to size 1, so that the judge's absolute error bound is relative to the size.
    double size = 0;
    for (const Point p : first.points) size = std::max(size, length(p - first.points[0]));
    for (Mesh* mesh : {&first, &second}) {
      const Point from = first.points[0];
      const Mesh moved = mesh->moved([&](Point p) { return 1 / size * (p - from); });
      if (mesh == &first) sizes.push_back(size);
      meshes.add(moved);
    }
  }
  const std::vector<CgalDistance> judged =
      meshes.judge<CgalDistance>("'" + setting("SGM_JUDGE_DISTANCE") + "' " + std::to_string(kError));
  const auto jobs = std::move(*makeThreadPool(2));
  for (size_t i = 0; i < pairs.size(); ++i) {
    const double size = sizes[i];
    HausdorffSettings settings;
    settings.tolerance = kError * size;
    settings.refinements = uint64_t{1} << 18;
    const Result<Hausdorff> ours = hausdorff(pairs[i].first, pairs[i].second, settings, *jobs);
    REQUIRE(ours);
    for (const auto& [mine, theirs] :
         {std::pair{ours->there, judged[2 * i].distance}, {ours->back, judged[2 * i + 1].distance}}) {
      CAPTURE(i, size, mine.at_least / size, mine.at_most / size, theirs);
      CHECK(theirs >= mine.at_least / size - kError);
      CHECK(theirs <= mine.at_most / size + kError);
      CHECK(mine.at_most - mine.at_least < 20 * settings.tolerance);
    }
  }
}

TEST_CASE("where CGAL's count of pairs is another", "[cgal]") {
  Mesh pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  // In this tetrahedron, one corner lies on the line through two other corners. So one of the four triangles has no
  // area, and touches the others along that line.
  Mesh flat{{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  JudgedMeshes meshes;
  meshes.add(pillow, kSoup);
  meshes.add(flat, kSoup);
  const std::vector<CgalVerdict> verdicts = cgalOf(meshes);
  CHECK(verdicts[0].pairs == 1);
  CHECK(verdicts[0].soup_pairs == 0);
  CHECK(crossings(pillow).pairs == 0);
  CHECK(measured(pillow).identity.duplicate_triangles == 1);
  CHECK(verdicts[1].flat == 1);
  CHECK(verdicts[1].pairs == crossings(flat).pairs);
  for (const Mesh& mesh : {pillow, flat}) CHECK_FALSE(measured(mesh).valid());
  for (const CgalVerdict& verdict : verdicts) CHECK_FALSE(verdict.valid());
}

}  // namespace sgm::measure
