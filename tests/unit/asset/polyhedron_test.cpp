// Tests making polyhedra from triangles: which meshes are closed, which points are merged, which meshes are rejected,
// and the places that the errors report.

#include "asset/polyhedron.h"

#include "asset/weld_triangles.h"
#include "bodies.h"
#include "catch.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

std::string complaint(const TriangleMesh& mesh) {
  const auto solid = makePolyhedron(mesh);
  return solid ? "" : solid.error().message;
}

TriangleMesh boxMesh(Point low, Point high) {
  MeshMaker maker;
  maker.box(low, high);
  return maker.mesh;
}

}  // namespace

TEST_CASE("triangles that lie in one plane and hang together are one face", "[asset][polyhedron]") {
  const auto box = makePolyhedron(boxMesh({1, 2, 3}, {2, 4, 6}));
  REQUIRE(box);
  CHECK(box->points.size() == 8);
  CHECK(box->faces.size() == 6);
  CHECK(box->low == Point{1, 2, 3});
  CHECK(box->high == Point{2, 4, 6});
  CHECK(box->volume() == Approx(6));
  const auto wall = makePolyhedron(windowedWall(3, 2));
  REQUIRE(wall);
  CHECK(wall->faces.size() == 6 + 4 * 6);
  // Coplanar triangles form one face, unless their materials differ.
  const auto house = makePolyhedron(gabledHouse());
  REQUIRE(house);
  CHECK(house->faces.size() == 7);
  MeshMaker two;
  two.box({0, 0, 0}, {1, 1, 1}, 0);
  for (size_t t = 0; t < 2; ++t) two.mesh.materials[t == 0 ? 8 : 9] = 1;
  two.mesh.material_names = {"a", "b"};
  CHECK(makePolyhedron(two.mesh)->faces.size() >= 6);
}

TEST_CASE("edges that corners of others lie on are no gaps", "[asset][polyhedron]") {
  // The top of the box is divided into two rectangles. The two corners that these rectangles share lie in the middle of
  // edges of the side faces, which have no corner there (T-junctions).
  MeshMaker maker;
  maker.box({0, 0, 0}, {2, 1, 2});
  auto& t = maker.mesh.triangles;
  std::erase_if(t, [&](const auto& corners) {
    return maker.mesh.points[corners[0]].y == 1 && maker.mesh.points[corners[1]].y == 1 &&
           maker.mesh.points[corners[2]].y == 1;
  });
  maker.mesh.materials.resize(t.size());
  CHECK(complaint(maker.mesh) ==
        "it is open at the edge from (2, 1, 0) to (2, 1, 2), which has no triangle on its other side");
  maker.quad({0, 1, 0}, {0, 1, 2}, {0.7, 1, 2}, {0.7, 1, 0});
  maker.quad({0.7, 1, 0}, {0.7, 1, 2}, {2, 1, 2}, {2, 1, 0});
  const auto closed = makePolyhedron(maker.mesh);
  REQUIRE(closed);
  CHECK(closed->volume() == Approx(4));
  CHECK(closed->faces.size() == 6);
}

TEST_CASE("parts may touch and overlap", "[asset][polyhedron]") {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1});
  maker.box({1, 0, 0}, {2, 1, 1});
  maker.box({0.5, 0.5, 0.5}, {1.5, 2, 0.8});
  REQUIRE(makePolyhedron(maker.mesh));
}

TEST_CASE("what is no solid is refused", "[asset][polyhedron]") {
  TriangleMesh open = boxMesh({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  open.materials.pop_back();
  CHECK_THAT(complaint(open), Catch::Matchers::StartsWith("it is open at the edge from ("));
  TriangleMesh turned = boxMesh({0, 0, 0}, {1, 1, 1});
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  CHECK_THAT(complaint(turned), Catch::Matchers::StartsWith("two triangles go the same way along the edge from (") &&
                                    Catch::Matchers::EndsWith(": one of them is turned inside out"));
  TriangleMesh inside_out = boxMesh({0, 0, 0}, {1, 1, 1});
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  CHECK(complaint(inside_out) == "it is turned inside out: its faces point inwards");
  MeshMaker flat;
  flat.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  CHECK(complaint(flat.mesh) == "it is flat: thinner than a millimetre");
}

TEST_CASE("what is too large is refused with how large it may be", "[asset][polyhedron]") {
  const auto many = makePolyhedron(windowedWall(20, 20));
  REQUIRE_FALSE(many);
  CHECK(many.error().code == Code::limit);
  CHECK(many.error().message ==
        "it has " + std::to_string(windowedWall(20, 20).triangles.size()) + " triangles, and `fit` takes at most 4096");
  CHECK(complaint(windowedWall(9, 7)) == "it has 258 plane faces, and `fit` takes at most 256");
}
