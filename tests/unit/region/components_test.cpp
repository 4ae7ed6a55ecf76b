// Tests counting connected pieces of solid and air, plane by plane.

#include "region/components.h"

#include <random>

#include "brute_force.h"
#include "catch.h"

using namespace sgm;
using namespace sgm::test;

namespace {

using Solid = std::function<bool(int, int, int)>;

Pieces pieced(int nx, int ny, int nz, const Solid& solid) {
  const auto columns = static_cast<size_t>(nx), rows = static_cast<size_t>(ny);
  const size_t words = ComponentCounter::rowWords(columns);
  ComponentCounter counter(columns, rows);
  for (int z = 0; z < nz; ++z) {
    // Some bits after the end of a row are set, to test that they have no effect.
    std::vector<uint64_t> plane(words * rows, 0);
    for (size_t y = 0; y < rows; ++y) {
      for (size_t x = 0; x < words * 64; ++x) {
        const bool set = x < columns ? solid(static_cast<int>(x), static_cast<int>(y), z) : (x + y) % 3 == 0;
        plane[y * words + x / 64] |= uint64_t{set} << (x % 64);
      }
    }
    counter.addPlane(plane);
  }
  return counter.pieces();
}

Components counted(int nx, int ny, int nz, const Solid& solid) { return pieced(nx, ny, nz, solid).above(0); }

}  // namespace

TEST_CASE("solid joins along the axes, air also across the diagonals of faces", "[metrics]") {
  const auto only = [](std::vector<std::array<int, 3>> set, bool value) {
    return [=](int x, int y, int z) {
      return (std::find(set.begin(), set.end(), std::array{x, y, z}) != set.end()) == value;
    };
  };
  for (const auto& [a, b] : std::vector<std::array<std::array<int, 3>, 2>>{{{{1, 1, 1}, {2, 2, 1}}},
                                                                           {{{1, 1, 1}, {2, 1, 2}}},
                                                                           {{{2, 1, 1}, {1, 1, 2}}},
                                                                           {{{1, 1, 1}, {1, 2, 2}}},
                                                                           {{{1, 2, 1}, {1, 1, 2}}}}) {
    CHECK(counted(4, 4, 4, only({a, b}, true)) == Components{2, 1});
    CHECK(counted(4, 4, 4, only({a, b}, false)) == Components{1, 1});
  }
  // Solid corners of a cell that are diagonally opposite are not connected.
  CHECK(counted(4, 4, 4, only({{1, 1, 1}, {2, 2, 2}}, true)) == Components{2, 1});
  CHECK(counted(4, 4, 4, only({{1, 1, 1}, {2, 2, 2}}, false)) == Components{1, 2});
  CHECK(counted(4, 4, 4, only({{1, 1, 1}, {1, 1, 2}}, true)) == Components{1, 1});
}

TEST_CASE("a block of one sign, a single sample, a single row", "[metrics]") {
  CHECK(counted(1, 1, 1, [](int, int, int) { return true; }) == Components{1, 0});
  CHECK(counted(64, 3, 2, [](int, int, int) { return false; }) == Components{0, 1});
  CHECK(counted(129, 1, 1, [](int x, int, int) { return x % 2 == 0; }) == Components{65, 64});
  CHECK(counted(65, 5, 7, [](int, int, int z) { return z % 2 == 0; }) == Components{4, 3});
}

TEST_CASE("random blocks have the pieces that a flood fill over the mesh's rule finds", "[metrics]") {
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    const auto size = [&](int most) { return std::uniform_int_distribution<int>(2, most)(random); };
    const int nx = size(seed % 3 == 0 ? 140 : 20), ny = size(14), nz = size(14);
    const double density = std::uniform_real_distribution<double>(0.05, 0.95)(random);
    std::vector<bool> signs(static_cast<size_t>(nx) * static_cast<size_t>(ny) * static_cast<size_t>(nz));
    for (size_t i = 0; i < signs.size(); ++i) signs[i] = std::bernoulli_distribution(density)(random);
    const Solid solid = [&](int x, int y, int z) { return signs[static_cast<size_t>(x + nx * (y + ny * z))]; };
    INFO("seed " << seed << ": " << nx << " x " << ny << " x " << nz << ", density " << density);
    const Pieces found = pieced(nx, ny, nz, solid), wanted = bruteForce(nx, ny, nz, solid);
    CHECK(found.solid == wanted.solid);
    CHECK(found.air == wanted.air);
    for (const uint64_t least : {uint64_t{0}, uint64_t{1}, uint64_t{5}, uint64_t{100}}) {
      const auto larger = [least](const Piece& piece) { return piece.samples > least; };
      CHECK(found.above(static_cast<double>(least)).solid ==
            static_cast<uint64_t>(std::count_if(wanted.solid.begin(), wanted.solid.end(), larger)));
    }
  }
}
