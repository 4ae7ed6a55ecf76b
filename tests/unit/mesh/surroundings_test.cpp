// Tests the grid squares around a side of a surface loop in a face of the chunk: their corners, and whether the surface
// passes through them.

#include "mesh/surroundings.h"

#include <cstdio>
#include <random>

#include "catch.h"
#include "rounds.h"

using namespace sgm;

namespace {

using Square = Surroundings::Place;

constexpr int32_t kSquareUnits = 64;
constexpr std::array<Square, 5> kSquares{Square::own, Square::beside, Square::low, Square::high, Square::opposite};

int oneOf(std::mt19937& random, int count) { return static_cast<int>(random() % static_cast<uint32_t>(count)); }

/// A random value for each corner of the grid; it is solid with a probability of `solid` tenths.
int32_t fieldAt(const Int3& p, uint32_t seed, int solid) {
  const auto part = [](int32_t v) { return static_cast<uint32_t>(v / kSquareUnits + 1000); };
  const uint32_t mixed = (part(p.x) * 73856093U ^ part(p.y) * 19349663U ^ part(p.z) * 83492791U ^ seed) * 2654435761U;
  const auto size = static_cast<int32_t>(mixed >> 12) + 1;
  return static_cast<int>(mixed >> 4 & 1023) * 10 < solid * 1024 ? -size : size;
}

/// A side of a loop in a face of a chunk, with a face vertex in the adjacent square.
SharpSide sideBeside(std::mt19937& random, int across, int by, int height) {
  SharpSide side;
  side.axis = oneOf(random, 3);
  across = (side.axis + 1 + across) % 3;
  side.at_border = true;
  for (int k = 0; k < 3; ++k) side.corner[k] = (k == side.axis ? 0 : 4 + oneOf(random, 24)) * kSquareUnits;
  Int3 place;
  place[across] = by < 0 ? -height : kSubcell + height;
  place[3 - side.axis - across] = 1 + oneOf(random, kSubcell - 1);
  side.places = FacePlaces(place);
  return side;
}

void sample(Surroundings& around, uint32_t seed, int solid) {
  std::vector<FieldSample> samples;
  for (size_t i = 0; i < Surroundings::kCorners; ++i)
    if (const std::optional<Int3> corner = around.corner(i)) samples.emplace_back().q = fieldAt(*corner, seed, solid);
  around.take(samples);
}

}  // namespace

TEST_CASE("cells around a side have the field's values at their corners", "[mesh][sharpen]") {
  size_t seen = 0;
  for (unsigned seed = 1; seed <= rounds(2000); ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const SharpSide side = sideBeside(random, oneOf(random, 2), random() % 2 == 0 ? -1 : 1, kSubcell / 2);
    Surroundings around(side, kSquareUnits);
    REQUIRE(around.leavesPart());
    const int solid = 1 + oneOf(random, 9);
    sample(around, seed, solid);
    for (const Square place : kSquares) {
      for (const bool above : {false, true}) {
        const std::optional<std::array<int32_t, 8>> q = around.ofCell(above, place);
        REQUIRE(q);
        bool passes = false, first = false;
        for (size_t c = 0; c < 8; ++c) {
          Int3 corner = side.corner;
          const Int3 step = around.stepTo(place);
          for (int k = 0; k < 3; ++k) corner[k] += (step[k] + static_cast<int32_t>(c >> k & 1)) * kSquareUnits;
          if (!above) corner[side.axis] -= kSquareUnits;
          CHECK((*q)[c] == fieldAt(corner, seed, solid));
          if (corner[side.axis] != side.corner[side.axis]) continue;
          const bool is_first = (c & ~(size_t{1} << side.axis)) == 0, is_solid = (*q)[c] < 0;
          if (is_first) first = is_solid;
          passes = passes || is_solid != first;
        }
        CHECK(around.passes(place) == passes);
        ++seen;
      }
    }
  }
  CHECK(seen == rounds(2000) * 10);
}

TEST_CASE("squares around a side lie beside the square of its face vertex", "[mesh][sharpen]") {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const int across = oneOf(random, 2), by = random() % 2 == 0 ? -1 : 1;
    const SharpSide side = sideBeside(random, across, by, kSubcell / 2);
    const int axis = (side.axis + 1 + across) % 3, along = 3 - side.axis - axis;
    const Surroundings around(side, kSquareUnits);
    Int3 beside, low, high, opposite;
    beside[axis] = low[axis] = high[axis] = by;
    low[along] = -1;
    high[along] = 1;
    opposite[axis] = 2 * by;
    CHECK(around.stepTo(Square::own) == Int3{});
    CHECK(around.stepTo(Square::beside) == beside);
    CHECK(around.stepTo(Square::low) == low);
    CHECK(around.stepTo(Square::high) == high);
    CHECK(around.stepTo(Square::opposite) == opposite);
  }
}

TEST_CASE("a face vertex leaves its part where another edge is nearer", "[mesh][sharpen]") {
  SharpSide side;
  side.axis = 2;
  side.corner = {5 * kSquareUnits, 5 * kSquareUnits, 0};
  const auto at = [&](const Int3& place) {
    side.places = FacePlaces(place);
    return Surroundings(side, kSquareUnits);
  };
  CHECK_FALSE(at({100, 100, 0}).leavesPart());
  CHECK_FALSE(at({100, -99, 0}).leavesPart());
  CHECK(at({100, -100, 0}).leavesPart());
  CHECK(at({200, kSubcell + 56, 0}).leavesPart());
  CHECK_FALSE(at({200, kSubcell + 55, 0}).leavesPart());
  CHECK(at({128, -128, 0}).leavesPart());
  side.places = FacePlaces({100, -20, 0}, {-20, 100, 0});
  CHECK_FALSE(Surroundings(side, kSquareUnits).areTogether());
  side.places = FacePlaces({100, -20, 0}, {120, -20, 0});
  CHECK(Surroundings(side, kSquareUnits).areTogether());
}

TEST_CASE("squares beyond the face of the chunk do not matter", "[mesh][sharpen]") {
  SharpSide side;
  side.axis = 0;
  side.corner = {0, (kChunkCells - 2) * kSquareUnits, 0};
  side.places = FacePlaces({0, kSubcell + 130, 60});
  Surroundings around(side, kSquareUnits);
  sample(around, 7, 5);
  // The square that contains the face vertex is the last one of its row and the lowest one of its column.
  CHECK(around.ofCell(true, Square::beside));
  CHECK(around.ofCell(true, Square::high));
  for (const Square place : {Square::opposite, Square::low}) {
    CHECK_FALSE(around.passes(place));
    CHECK_FALSE(around.ofCell(true, place));
  }
}
