#include <cmath>
#include <random>

#include "catch.h"
#include "derive/sweep.h"
#include "field_reference.h"

using namespace sgm;

namespace {

double distanceToLine(Int3 p, Int3 a, Int3 b) {
  const Vec3 line{static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y), static_cast<double>(b.z - a.z)};
  const Vec3 at{static_cast<double>(p.x - a.x), static_cast<double>(p.y - a.y), static_cast<double>(p.z - a.z)};
  return length(cross(line, at)) / length(line);
}

}  // namespace

TEST_CASE("a bent line leaves the straight one by at most its bend") {
  const uint32_t seed = 71;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int32_t> place(-200000, 200000);
  for (uint64_t i = 0; i < 200; ++i) {
    const Int3 a{place(random), place(random), place(random)}, b{place(random), place(random), place(random)};
    const double bend = 12288;
    const std::vector<Int3> corners = bentLine(a, b, bend, PathKey{i});
    REQUIRE(corners.size() >= 9);
    REQUIRE(corners.size() <= 17);
    REQUIRE(corners.front() == a);
    REQUIRE(corners.back() == b);
    double most = 0;
    for (const Int3& c : corners) most = std::max(most, distanceToLine(c, a, b));
    CHECK(most <= bend + 2);
    CHECK(most >= bend * 0.47);
    REQUIRE(bentLine(a, b, bend, PathKey{i}) == corners);
  }
  CHECK(bentLine({1, 2, 3}, {4, 5, 6}, 0, PathKey{1}).size() == 2);
  CHECK(bentLine({1, 2, 3}, {1, 2, 3}, 10, PathKey{1}).size() == 1);
}

TEST_CASE("a beam holds the tube along the same line, and its frames turn little") {
  const uint32_t seed = 72;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int32_t> place(-60000, 60000);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (uint64_t i = 0; i < 60; ++i) {
    const Int3 a{place(random), place(random), place(random)}, b{place(random), place(random), place(random)};
    const double r = 3000;
    const std::vector<Int3> corners = bentLine(a, b, 9000, PathKey{i});
    const std::vector<BeamPiece> pieces = beamAlong(corners, r, {0, 1, 0});
    REQUIRE(pieces.size() + 1 == corners.size());
    GrammarChunk chunk;
    for (const BeamPiece& piece : pieces) {
      Shape s;
      s.kind = ShapeKind::box;
      s.frame = piece.frame;
      for (size_t k = 0; k < 3; ++k) s.size[k] = piece.half[k];
      chunk.shapes.push_back(s);
      for (size_t row = 0; row < 3; ++row) {
        for (size_t other = 0; other < 3; ++other) {
          double product = 0;
          for (size_t k = 0; k < 3; ++k) {
            product += static_cast<double>(piece.frame.rows[3 * row + k]) *
                       static_cast<double>(piece.frame.rows[3 * other + k]);
          }
          REQUIRE(product == Approx(row == other ? 1.0 : 0.0).margin(1e-6));
        }
      }
    }
    for (size_t k = 0; k + 1 < pieces.size(); ++k) {
      double turn = 0;
      for (size_t j = 3; j < 6; ++j) {
        turn += static_cast<double>(pieces[k].frame.rows[j]) * static_cast<double>(pieces[k + 1].frame.rows[j]);
      }
      REQUIRE(turn > 0.7);
    }
    for (int k = 0; k < 200; ++k) {
      const size_t piece = static_cast<size_t>(random()) % pieces.size();
      const double t = std::abs(unit(random));
      Vec3 d{unit(random), unit(random), unit(random)};
      if (!(length(d) > 0.1)) continue;
      d = (r / length(d)) * d;
      const Int3 from = corners[piece], to = corners[piece + 1];
      const Int3 p{from.x + static_cast<int32_t>(std::lround(t * (to.x - from.x) + d.x)),
                   from.y + static_cast<int32_t>(std::lround(t * (to.y - from.y) + d.y)),
                   from.z + static_cast<int32_t>(std::lround(t * (to.z - from.z) + d.z))};
      REQUIRE(reference::fieldAt(chunk, static_cast<uint32_t>(piece), p) <= 1.0);
    }
  }
}
