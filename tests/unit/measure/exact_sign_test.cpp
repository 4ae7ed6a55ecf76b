// Tests signs of determinants against exact integers, in cases where rounding would give a wrong sign.

#include "measure/exact_sign.h"

#include <random>

#include "../catch.h"
#include "../rounds.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

__extension__ using Int128 = __int128;

struct Whole {
  int64_t x, y, z;
  Point scaled(double by) const {
    return {by * static_cast<double>(x), by * static_cast<double>(y), by * static_cast<double>(z)};
  }
};

int sign(Int128 v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

int exactly(Whole a, Whole b, Whole c, Whole d) {
  const Int128 ux = a.x - d.x, uy = a.y - d.y, uz = a.z - d.z, vx = b.x - d.x, vy = b.y - d.y, vz = b.z - d.z,
               wx = c.x - d.x, wy = c.y - d.y, wz = c.z - d.z;
  return sign(ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx));
}

/// A fourth point near the plane through a, b and c: `a` plus a combination of b - a and c - a, off by at most one unit
/// on each axis.
Whole nearPlane(std::mt19937& random, Whole a, Whole b, Whole c) {
  const auto s = static_cast<int64_t>(random() % 7) - 3, t = static_cast<int64_t>(random() % 7) - 3;
  const auto off = [&] { return static_cast<int64_t>(random() % 3) - 1; };
  return {a.x + s * (b.x - a.x) + t * (c.x - a.x) + off(), a.y + s * (b.y - a.y) + t * (c.y - a.y) + off(),
          a.z + s * (b.z - a.z) + t * (c.z - a.z) + off()};
}

}  // namespace

TEST_CASE("the side of a plane is exact", "[exact_sign]") {
  int on = 0, beside = 0;
  for (unsigned seed = 0; seed < std::max(rounds(20000), 20000u); ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    // Coordinates of up to 37 bits: determinants have more than 100 bits, far beyond a double's 53.
    const int64_t reach = int64_t{1} << (3 + random() % 34);
    const auto along = [&] { return static_cast<int64_t>(random() * uint64_t{4294967296} + random()) % reach; };
    const auto whole = [&] { return Whole{along(), along(), along()}; };
    const Whole a = whole(), b = whole(), c = whole();
    const Whole d = random() % 4 == 0 ? whole() : nearPlane(random, a, b, c);
    // The scale is 1e-70 to 1e86; coordinates are up to 1e11 times larger.
    const double scale = std::ldexp(1, static_cast<int>(random() % 520) - 232);
    const int expected = exactly(a, b, c, d);
    CHECK(orientation(a.scaled(scale), b.scaled(scale), c.scaled(scale), d.scaled(scale)) == expected);
    CHECK(orientation(b.scaled(scale), a.scaled(scale), c.scaled(scale), d.scaled(scale)) == -expected);
    on += expected == 0;
    beside += expected != 0;
    const int flat = sign(static_cast<Int128>(a.x - d.x) * (b.y - d.y) - static_cast<Int128>(a.y - d.y) * (b.x - d.x));
    CHECK(orientationAlong(2, a.scaled(scale), b.scaled(scale), d.scaled(scale)) == flat);
  }
  CHECK(on > 200);
  CHECK(beside > 10000);
}

TEST_CASE("the side of a plane does not depend on the order of its points", "[exact_sign]") {
  for (unsigned seed = 0; seed < rounds(2000); ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const auto place = [&] { return Point{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)}; };
    const Point a = place(), b = place(), c = place();
    // The fourth point lies in the plane of the other three, up to rounding.
    const Point d = a + between(random, -2, 2) * (b - a) + between(random, -2, 2) * (c - a);
    const int side = orientation(a, b, c, d);
    CHECK(orientation(b, c, a, d) == side);
    CHECK(orientation(c, b, a, d) == -side);
    CHECK(orientation(d, b, c, a) == -side);
    CHECK(orientation(a, b, d, c) == -side);
  }
}

TEST_CASE("seen from in front of a plane its points go round counter-clockwise", "[exact_sign]") {
  CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}) == 1);
  CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == -1);
  CHECK(orientationAlong(2, {0, 0, 5}, {1, 0, 3}, {0, 1, 2}) == 1);
  CHECK(orientationAlong(0, {9, 0, 0}, {2, 1, 0}, {4, 0, 1}) == 1);
  CHECK(orientationAlong(1, {0, 7, 0}, {0, 1, 1}, {1, 3, 0}) == 1);
}

}  // namespace sgm::measure
