#include <set>

#include "catch.h"
#include "derive/bounds.h"
#include "field_reference.h"
#include "random_chunk.h"
#include "rounds.h"

using namespace sgm;

namespace {

/// Returns how many random points have a field value of at most `a`, and checks that all of these lie in the box.
int checkLevel(RandomChunk& random, uint32_t root, double a, const IntBox& box) {
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const Int3 p{random.whole(-9000, 9000), random.whole(-9000, 9000), random.whole(-9000, 9000)};
    if (reference::fieldAt(random.chunk, root, p) > a) continue;
    ++inside;
    CAPTURE(p.x, p.y, p.z, a);
    REQUIRE(box.contains(p));
  }
  if (box.empty() || !isBounded(box)) return inside;
  for (int i = 0; i < 200; ++i) {  // points just outside of a face
    Int3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.whole(box.lo[axis] - 40, box.hi[axis] + 40);
    const int axis = random.whole(0, 2);
    const int32_t away = random.whole(1, i % 2 == 0 ? 2 : 300);
    p[axis] = random.whole(0, 1) == 0 ? box.lo[axis] - away : box.hi[axis] + away;
    CAPTURE(p.x, p.y, p.z, a);
    REQUIRE(reference::fieldAt(random.chunk, root, p) > a);
  }
  return inside;
}

}  // namespace

TEST_CASE("bounds hold every point of the level set, for every kind of shape") {
  std::set<ShapeKind> seen;
  int inside = 0;
  for (uint32_t seed = 1; seed <= rounds(3000); ++seed) {
    CAPTURE(seed);
    RandomChunk random(seed);
    const uint32_t root = random.tree(static_cast<int>(seed % 4));
    for (const Shape& s : random.chunk.shapes) seen.insert(s.kind);
    for (double a : {0.0, random.real(-300, 600)}) {
      inside += checkLevel(random, root, a, levelBounds(random.chunk, root, a));
    }
  }
  CHECK(inside > static_cast<int>(3 * rounds(3000)));
  CHECK(seen.size() == 21);  // all shape kinds except the half-space
}

TEST_CASE("bounds of leaves are tight") {
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    RandomChunk random(seed);
    const uint32_t root = random.tree(0);
    const Shape& s = random.chunk.shapes[root];
    if (s.kind == ShapeKind::morph_power) continue;
    const IntBox box = levelBounds(random.chunk, root, 0);
    // Compares extents instead of testing random points, because these rarely lie near the bounds: a rotated box
    // touches its bounds only at corners, and a ball only at six points.
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = static_cast<double>(box.hi[axis]) - box.lo[axis];
      double most = 0;
      for (float v : s.size) most = std::max(most, static_cast<double>(std::abs(v)));
      if (s.kind == ShapeKind::prism) most = std::max(most, 2000.0);
      CHECK(extent <= 2 * 3.0 * most + 2 * 2000 + 8);
    }
  }
}

TEST_CASE("exact boxes: a sphere, an upright box, a half-space in a meet") {
  GrammarChunk chunk;
  Shape ball;
  ball.size[0] = 1000;
  ball.frame.origin = {10, 20, 30};
  chunk.shapes.push_back(ball);
  const IntBox box = levelBounds(chunk, 0, 0);
  CHECK(box.lo.x <= -990);
  CHECK(box.lo.x >= -993);
  CHECK(box.hi.y >= 1020);
  CHECK(box.hi.y <= 1023);
  CHECK(levelBounds(chunk, 0, -1001.5).empty());

  Shape half;
  half.kind = ShapeKind::halfspace;
  chunk.shapes.push_back(half);
  CHECK_FALSE(isBounded(levelBounds(chunk, 1, 0)));
  Shape meet;
  meet.kind = ShapeKind::meet;
  meet.child_count = 2;
  chunk.children = {0, 1};
  chunk.shapes.push_back(meet);
  const IntBox met = levelBounds(chunk, 2, 0);
  CHECK(isBounded(met));
  CHECK(met.hi.y <= 2);

  chunk.shapes[1].detail = 100;  // levels that omit the half-space omit the whole intersection (`meet`)
  CHECK(levelBounds(chunk, 2, 0) == met);
}

TEST_CASE("a displacement without an amplitude has no bound") {
  GrammarChunk chunk;
  Shape ball;
  ball.size[0] = 1000;
  chunk.shapes.push_back(ball);
  Expr y;
  y.op = ExprOp::coordinate;
  y.row = {0, 1, 0};
  chunk.exprs.push_back(y);
  Shape node;
  node.kind = ShapeKind::displace;
  node.expr = 0;
  node.child_count = 1;
  chunk.children = {0};
  chunk.shapes.push_back(node);
  CHECK_FALSE(isBounded(levelBounds(chunk, 1, 0)));
}

TEST_CASE("ranges hold the values of random expressions") {
  for (uint32_t seed = 1; seed <= rounds(500); ++seed) {
    CAPTURE(seed);
    RandomChunk random(seed);
    const IntBox box{{-3000, -3000, -3000}, {3000, 3000, 3000}};
    for (int i = 0; i < 3; ++i) {
      Expr e;
      e.op = i < 2 ? ExprOp::coordinate : ExprOp::constant;
      for (float& v : e.row) v = static_cast<float>(random.real(-2, 2));
      e.anchor = {random.whole(-500, 500), 0, random.whole(-500, 500)};
      e.value = static_cast<float>(random.real(-2, 2));
      random.chunk.exprs.push_back(e);
    }
    for (int i = 0; i < 12; ++i) {
      Expr e;
      e.op = static_cast<ExprOp>(random.whole(static_cast<int>(ExprOp::negate), static_cast<int>(ExprOp::less)));
      const int32_t count = static_cast<int32_t>(random.chunk.exprs.size());
      e.a = static_cast<uint32_t>(random.whole(0, count - 1));
      e.b = static_cast<uint32_t>(random.whole(0, count - 1));
      if (random.whole(0, 4) == 0) {
        e.op = ExprOp::mix;
        e.c = static_cast<uint32_t>(random.whole(0, count - 1));
      }
      random.chunk.exprs.push_back(e);
    }
    const std::vector<Range> ranges = exprRanges(random.chunk.exprs, &box);
    for (int i = 0; i < 40; ++i) {
      const Int3 p{random.whole(-3000, 3000), random.whole(-3000, 3000), random.whole(-3000, 3000)};
      for (uint32_t k = 0; k < ranges.size(); ++k) {
        const double v = reference::exprAt(random.chunk, k, p);
        if (std::isnan(v)) continue;
        CAPTURE(k, static_cast<int>(random.chunk.exprs[k].op), v);
        REQUIRE(v >= ranges[k].lo);
        REQUIRE(v <= ranges[k].hi);
      }
    }
  }
}
