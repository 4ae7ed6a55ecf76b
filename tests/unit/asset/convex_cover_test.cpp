// Tests the division of polyhedra into convex pieces: every point inside the solid lies strictly inside a piece, and no
// point outside the solid does.

#include "asset/convex_cover.h"

#include <algorithm>
#include <random>

#include "asset/fit.h"
#include "bodies.h"
#include "catch.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

/// Minimum, over the pieces, of the greatest signed distance from a piece's planes: negative if the point is strictly
/// inside a piece.
double fieldAt(const std::vector<ConvexPiece>& pieces, Point p) {
  double least = 1e9;
  for (const ConvexPiece& piece : pieces) {
    double most = -1e9;
    for (const PieceSide& side : piece) most = std::max(most, side.plane.distance(p));
    least = std::min(least, most);
  }
  return least;
}

/// Tests points inside the cells of a BSP, on the faces and edges that cells share, and at the corners of cells. Pieces
/// that touch without overlapping would leave gaps at these points.
void checkCover(const Polyhedron& solid, std::mt19937& random) {
  const auto cells = cutIntoCells(solid);
  REQUIRE(cells);
  const auto pieces = coverWithPieces(solid);
  REQUIRE(pieces);
  double volume = 0;
  for (const BspCell& cell : cells->cells)
    if (cell.solid) volume += cell.body.volume();
  CHECK(volume <= Approx(solid.volume()).epsilon(1e-5));
  const auto solidAround = [&](Point p) {
    int solid_cells = 0, void_cells = 0;
    for (const BspCell& cell : cells->cells) {
      double most = -1e9;
      for (const ConvexCell::Facet& facet : cell.body.facets) most = std::max(most, facet.plane.distance(p));
      if (most <= 2 * cells->tolerance) ++(cell.solid ? solid_cells : void_cells);
    }
    return void_cells == 0 ? 1 : solid_cells == 0 ? -1 : 0;
  };
  for (const BspCell& cell : cells->cells)
    for (const ConvexCell::Facet& facet : cell.body.facets)
      for (size_t i = 0; i < facet.loop.size(); ++i) {
        const Point corner = facet.loop[i], next = facet.loop[(i + 1) % facet.loop.size()];
        const double t = static_cast<double>(1 + random() % 99) / 100;
        for (const Point p :
             {corner, corner + t * (next - corner), middleOf(facet.loop) + t * (corner - middleOf(facet.loop)),
              cell.middle + t * (corner - cell.middle)}) {
          const int where = solidAround(p);
          const double field = fieldAt(*pieces, p);
          if (where > 0 && !(field < 0)) FAIL("a point inside is not covered");
          if (where < 0 && !(field > 0)) FAIL("a point outside is covered");
          if (where == 0 && std::fabs(field) > 1e-3 * solid.longestEdge())
            FAIL("a point of the surface is not near it");
        }
      }
}

}  // namespace

TEST_CASE("pieces are as few as walls and windows need", "[asset][cover]") {
  CHECK(coverWithPieces(solidOf(gabledHouse()))->size() == 1);
  CHECK(coverWithPieces(solidOf(windowedWall(1, 1)))->size() == 4);
  CHECK(coverWithPieces(solidOf(windowedWall(6, 5)))->size() == 13);
}

TEST_CASE("a face's material is on its piece's side", "[asset][cover]") {
  const auto pieces = coverWithPieces(solidOf(gabledHouse()));
  REQUIRE(pieces);
  for (const PieceSide& side : pieces->front()) {
    const bool slope = side.plane.normal.y > 0.1;
    CHECK(side.material == (slope ? 1u : 0u));
  }
}

TEST_CASE("nothing inside a polyhedron is left out, and nothing outside taken in", "[asset][cover]") {
  std::mt19937 random(3);
  checkCover(solidOf(windowedWall(3, 2)), random);
  checkCover(solidOf(archedBay(12)), random);
  MeshMaker parts;  // solids that touch, overlap and cross each other
  parts.box({0, 0, 0}, {3, 1, 1});
  parts.box({3, 0, 0}, {4, 2, 1});
  parts.box({1, -1, 0.3}, {2, 3, 0.7});
  parts.prism({{0.5, 0.5}, {2.5, 0.2}, {1.8, 1.7}}, -0.5, 1.5);
  checkCover(solidOf(parts.mesh), random);
}

TEST_CASE("fitted assets are covered in any size", "[asset][cover]") {
  for (unsigned seed = 0; seed < rounds(60); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 10001) / 10000;
    };
    const Polyhedron asset = solidOf(seed % 2 == 0 ? archedBay(3 + random() % 8) : windowedWall(1 + random() % 4, 2));
    std::vector<FitZone> zones;
    if (random() % 2 == 0) zones.push_back({0, true, 0.2, asset.high.x - 0.2});
    const auto body = fitInto(asset, {between(3, 14), between(3, 9), between(0.5, 3)}, zones);
    if (body) checkCover(*body, random);
  }
}

TEST_CASE("what runs through itself is refused", "[asset][cover]") {
  // The inverted (inside-out) box cuts a hole into the outer box, but it also extends beyond the outer box, where it
  // would enclose void. So the surface intersects itself.
  MeshMaker maker;
  maker.box({0, 0, 0}, {4, 4, 4});
  MeshMaker hole;
  hole.box({3, 1, 1}, {6, 2, 2});
  for (auto& t : hole.mesh.triangles) {
    std::swap(t[1], t[2]);
    for (uint32_t& corner : t) corner += static_cast<uint32_t>(maker.mesh.points.size());
  }
  maker.mesh.points.insert(maker.mesh.points.end(), hole.mesh.points.begin(), hole.mesh.points.end());
  maker.mesh.triangles.insert(maker.mesh.triangles.end(), hole.mesh.triangles.begin(), hole.mesh.triangles.end());
  maker.mesh.materials.resize(maker.mesh.triangles.size(), kNoMaterial);
  const auto pieces = coverWithPieces(solidOf(maker.mesh));
  REQUIRE_FALSE(pieces);
  CHECK(pieces.error().message == "it intersects itself");
}

TEST_CASE("what is too intricate is refused", "[asset][cover]") {
  const Polyhedron wall = solidOf(windowedWall(3, 2));
  CHECK(coverWithPieces(wall, {.cells = 5}).error().message == "it falls into more than 5 convex parts");
  CHECK(coverWithPieces(wall, {.pieces = 2}).error().message == "it falls into more than 2 convex pieces");
  CHECK(coverWithPieces(wall, {.features = 2}).error().message == "it falls into more than 4096 convex pieces");
}
