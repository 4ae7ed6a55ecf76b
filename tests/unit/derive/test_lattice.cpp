#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "catch.h"
#include "derive/lattice.h"

using namespace sgm;

namespace {

/// Number of connected components of a graph: its nodes are the grammar cells of a block, its edges the links between
/// these cells.
int components(const Lattice& lattice, Int3 corner, Int3 extent, int tree, double extra) {
  const auto index = [&](Int3 c) {
    return static_cast<size_t>(((c.z - corner.z) * extent.y + (c.y - corner.y)) * extent.x + (c.x - corner.x));
  };
  std::vector<size_t> set(static_cast<size_t>(extent.x * extent.y * extent.z));
  std::iota(set.begin(), set.end(), size_t{0});
  const auto find = [&](size_t i) {
    while (set[i] != i) i = set[i] = set[set[i]];
    return i;
  };
  for (int z = 0; z < extent.z; ++z) {
    for (int y = 0; y < extent.y; ++y) {
      for (int x = 0; x < extent.x; ++x) {
        const Int3 cell{corner.x + x, corner.y + y, corner.z + z};
        for (const FaceId& face : lattice.links(cell, tree, extra)) {
          const Int3 up = face.upper();
          if (up.x - corner.x >= extent.x || up.y - corner.y >= extent.y || up.z - corner.z >= extent.z) continue;
          set[find(index(cell))] = find(index(up));
        }
      }
    }
  }
  int count = 0;
  for (size_t i = 0; i < set.size(); ++i) count += find(i) == i ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("links keep every aligned block of cells in one piece") {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const Lattice lattice{mix64(seed), {1024, 1024, 1024}};
    const int at = static_cast<int>(seed % 5) - 2;
    REQUIRE(components(lattice, {8 * at, -8, 16}, {8, 8, 8}, 3, 0.0) == 1);
    if (seed % 10 == 0) {
      REQUIRE(components(lattice, {-16, 0, 16}, {16, 16, 16}, 4, 0.0) == 1);
      REQUIRE(components(lattice, {-8, -8, 0}, {16, 16, 8}, 3, 0.1) == 1);
      REQUIRE(components(lattice, {-4, 0, 0}, {8, 4, 4}, 2, 0.0) == 1);
      REQUIRE(components(lattice, {3, -5, 1}, {4, 4, 4}, 0, 0.0) == 1);
    }
  }
}

TEST_CASE("links of a lattice without a vertical axis stay in its plane") {
  const Lattice lattice{99, {512, 0, 512}};
  REQUIRE(components(lattice, {-8, 0, 8}, {16, 1, 16}, 3, 0.0) == 1);
  for (const FaceId& face : lattice.links({1, 0, 2}, 3, 1.0)) REQUIRE(face.axis != 1);
}

TEST_CASE("a block has no more compulsory links than a tree needs") {
  const Lattice lattice{7, {1024, 1024, 1024}};
  int inside = 0;
  for (int i = 0; i < 512; ++i) {
    const Int3 cell{i % 8, (i / 8) % 8, i / 64};
    for (const FaceId& face : lattice.links(cell, 3, 0.0)) {
      const Int3 up = face.upper();
      inside += up.x < 8 && up.y < 8 && up.z < 8 ? 1 : 0;
    }
  }
  REQUIRE(inside == 511);
}

TEST_CASE("the share of extra links is the one asked for") {
  const Lattice lattice{8, {1024, 1024, 1024}};
  int open = 0, all = 0;
  for (int i = 0; i < 8000; ++i) {
    for (const FaceId& face : lattice.ownedFaces({i % 20, (i / 20) % 20, i / 400})) {
      ++all;
      if (!lattice.linked(face, 3, 0.0) && lattice.linked(face, 3, 0.25)) ++open;
    }
  }
  // Without extra links (a share of 0), about a third of the faces between cells are linked. With a share of 0.25, a
  // quarter of the other faces are linked, too.
  CHECK(open > all * 0.25 * 0.60);
  CHECK(open < all * 0.25 * 0.72);
}

TEST_CASE("both cells of a face see the same points and keys") {
  const Lattice lattice{12345, {196608, 1000, 7}};
  for (int i = -20; i < 20; ++i) {
    const Int3 a{i, 3 * i, -i}, b{i + 1, 3 * i, -i};
    const Int3 from_a = lattice.point(a, b, 0.7), from_b = lattice.point(b, b, 0.7);
    REQUIRE(from_a.x - lattice.size.x == from_b.x);
    REQUIRE(from_a.y == from_b.y);
    REQUIRE(from_a.z == from_b.z);
    const FaceId face{a, 0};
    const Int3 point_a = lattice.facePoint(a, face, 1), point_b = lattice.facePoint(b, face, 1);
    REQUIRE(point_a.x == lattice.size.x);
    REQUIRE(point_b.x == 0);
    REQUIRE(point_a.y == point_b.y);
    for (int axis = 0; axis < 3; ++axis) {
      REQUIRE(from_b[axis] >= 0);
      REQUIRE(from_b[axis] < lattice.size[axis]);
    }
  }
  REQUIRE(lattice.point({}, {}, 0) == Int3{98304, 500, 3});
}

TEST_CASE("keys of cells and faces are all different") {
  const Lattice lattice{5, {1, 1, 1}};
  std::set<uint64_t> keys;
  for (int i = 0; i < 1000; ++i) {
    const Int3 cell{i % 10 - 5, (i / 10) % 10 - 5, i / 100 - 5};
    keys.insert(lattice.cellKey(cell).value);
    for (int axis = 0; axis < 3; ++axis) keys.insert(lattice.faceKey({cell, axis}).value);
  }
  REQUIRE(keys.size() == 4000);
}

TEST_CASE("cell noise is smooth and stays within 0..1") {
  const Lattice lattice{5, {900 * 1024, 0, 900 * 1024}};
  double low = 1, high = 0;
  for (int x = -50; x < 50; ++x) {
    for (int z = -50; z < 50; ++z) {
      const double v = lattice.noise({x, 0, z}, 6000 * 1024, 3), w = lattice.noise({x + 1, 0, z}, 6000 * 1024, 3);
      REQUIRE(std::abs(v - w) < 0.45);
      low = std::min(low, v), high = std::max(high, v);
    }
  }
  CHECK(low >= 0);
  CHECK(high <= 1);
  CHECK(high - low > 0.5);
}
