#include "catch.h"
#include "derive/bounds.h"
#include "derive/chunk_ops.h"
#include "field_reference.h"
#include "random_chunk.h"

using namespace sgm;

TEST_CASE("translation moves bounds, and the hash tells it; back again is the same chunk") {
  for (uint32_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    RandomChunk random(seed);
    const uint32_t root = random.tree(3);
    GrammarChunk& chunk = random.chunk;
    Anchor anchor;
    anchor.frame.origin = {1, 2, 3};
    chunk.anchors.push_back(anchor);
    const IntBox before = levelBounds(chunk, root, 0);
    if (!isBounded(before)) continue;  // derivation never emits an unbounded group, so skip such groups
    chunk.groups.push_back({root, false, before, PathKey{seed}});
    const uint64_t hash = hashChunk(chunk);
    const Int3 far{2000000000, -1999990000, 123456789};
    translate(chunk, far);
    CHECK(hashChunk(chunk) != hash);
    CHECK(chunk.anchors[0].frame.origin == Int3{2000000001, -1999989998, 123456792});
    const IntBox after = levelBounds(chunk, root, 0);
    CHECK(after.empty() == before.empty());
    if (!before.empty()) {
      CHECK(chunk.groups[0].bounds.lo == saturatingAdd(before.lo, far));
      CHECK(after == chunk.groups[0].bounds);
    }
    translate(chunk, {-far.x, -far.y, -far.z});
    CHECK(hashChunk(chunk) == hash);
  }
}

TEST_CASE("translation moves sweeps, coordinates and noise, but not the corners of a prism") {
  GrammarChunk chunk;
  chunk.points = {{1, 0, 1}, {2, 0, 2}, {5, 5, 5}, {6, 6, 6}};
  Shape prism;
  prism.kind = ShapeKind::prism;
  prism.point_count = 2;
  chunk.shapes.push_back(prism);
  Expr sweep;
  sweep.op = ExprOp::sweep;
  sweep.first_point = 2;
  sweep.point_count = 2;
  chunk.exprs.push_back(sweep);
  Expr height;
  height.op = ExprOp::coordinate;
  chunk.exprs.push_back(height);
  chunk.noises.push_back({});
  translate(chunk, {10, 20, 30});
  CHECK(chunk.points[0] == Int3{1, 0, 1});
  CHECK(chunk.points[2] == Int3{15, 25, 35});
  CHECK(chunk.exprs[0].anchor == Int3{});
  CHECK(chunk.exprs[1].anchor == Int3{10, 20, 30});
  CHECK(chunk.noises[0].origin == Int3{10, 20, 30});
}

TEST_CASE("the hash sees every field") {
  RandomChunk random(4);
  const uint32_t root = random.tree(2);
  GrammarChunk& chunk = random.chunk;
  chunk.groups.push_back({root, false, levelBounds(chunk, root, 0), PathKey{1}});
  const uint64_t hash = hashChunk(chunk);
  const auto changed = [&](auto& field, auto value) {
    const auto old = field;
    field = value;
    const bool differs = hashChunk(chunk) != hash;
    field = old;
    return differs && hashChunk(chunk) == hash;
  };
  CHECK(changed(chunk.shapes[0].material, uint16_t{7}));
  CHECK(changed(chunk.shapes[0].tag, uint16_t{7}));
  CHECK(changed(chunk.shapes[0].size[2], 1e9f));
  CHECK(changed(chunk.shapes[0].frame.rows[4], 0.25f));
  CHECK(changed(chunk.shapes[0].detail, 5));
  CHECK(changed(chunk.shapes[0].coarsest, 5));
  CHECK(changed(chunk.exprs[0].value, 0.5f));
  CHECK(changed(chunk.noises[0].octaves, 9u));
  CHECK(changed(chunk.groups[0].cut, true));
  CHECK(changed(chunk.groups[0].key, PathKey{2}));
  CHECK(changed(chunk.cell, Int3{1, 0, 0}));
}
