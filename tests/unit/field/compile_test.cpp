// Tests compiling derived cells to programs: which groups are found, and that neither the order of the cells nor the
// omission of groups changes the result.

#include <algorithm>
#include <cstring>
#include <random>

#include "catch.h"
#include "field/compile.h"
#include "random_programs.h"
#include "seed.h"

using namespace sgm;

namespace {

int32_t within(std::mt19937& random, int32_t extent) {
  return static_cast<int32_t>(random() % static_cast<uint32_t>(2 * extent)) - extent;
}

// A derived cell of spheres, each in a group of its own with tight bounds.
GrammarChunk cellOf(std::mt19937& random, Int3 cell, uint32_t layers, uint32_t most, int32_t extent) {
  GrammarChunk chunk;
  chunk.layer = static_cast<uint32_t>(random() % layers);
  chunk.cell = cell;
  const auto groups = static_cast<uint32_t>(random() % (most + 1));
  for (uint32_t i = 0; i < groups; ++i) {
    const Int3 centre{within(random, extent), within(random, extent), within(random, extent)};
    const auto radius = static_cast<int32_t>(1 + random() % (i % 9 == 0 ? static_cast<uint32_t>(extent) : 900u));
    Shape shape;
    shape.size[0] = static_cast<float>(radius);
    shape.frame.origin = centre;
    shape.material = static_cast<uint16_t>(random() % 5);
    chunk.shapes.push_back(shape);
    Group group;
    group.root = i;
    group.cut = random() % 3 == 0;
    group.bounds = IntBox{centre, centre}.grown(radius);
    // There are few different keys, so that groups often have equal keys: then the cell and the group's number decide
    // their order.
    group.key.value = random() % 8;
    chunk.groups.push_back(group);
  }
  return chunk;
}

// A derived cell whose only group is a sum of balls, displaced by up to `shift` metres.
GrammarChunk sumOf(std::mt19937& random, uint32_t balls, int32_t extent, int32_t shift) {
  GrammarChunk chunk;
  for (uint32_t i = 0; i < balls; ++i) {
    Shape ball;
    ball.size[0] = ball.inner_radius = static_cast<float>(1 + random() % 3000);
    ball.frame.origin = {within(random, extent), within(random, extent), within(random, extent)};
    chunk.children.push_back(i);
    chunk.shapes.push_back(ball);
  }
  Shape sum;
  sum.kind = ShapeKind::sum;
  sum.child_count = balls;
  chunk.shapes.push_back(sum);
  Group group;
  group.root = balls;
  if (shift > 0) {
    for (int axis = 0; axis < 3; ++axis) {
      Expr constant;
      constant.op = ExprOp::constant;
      constant.value = static_cast<float>(within(random, shift));
      chunk.exprs.push_back(constant);
    }
    Shape warp;
    warp.kind = ShapeKind::warp;
    warp.first_child = balls;
    warp.child_count = 1;
    warp.expr = 0;
    chunk.children.push_back(balls);
    chunk.shapes.push_back(warp);
    ++group.root;
  }
  group.bounds = IntBox::everything();
  chunk.groups.push_back(group);
  return chunk;
}

bool same(const FieldProgram& a, const FieldProgram& b) {
  auto bytes = [](const auto& u, const auto& v) {
    return u.size() == v.size() && (u.empty() || std::memcmp(u.data(), v.data(), u.size() * sizeof u[0]) == 0);
  };
  if (a.groups.size() != b.groups.size()) return false;
  for (size_t i = 0; i < a.groups.size(); ++i) {
    const ProgramGroup &g = a.groups[i], &h = b.groups[i];
    if (g.influence != h.influence || g.first != h.first || g.count != h.count || g.layer != h.layer ||
        g.result != h.result || g.cut != h.cut || g.guarded != h.guarded) {
      return false;
    }
  }
  return bytes(a.instrs, b.instrs) && bytes(a.params, b.params);
}

}  // namespace

TEST_CASE("the index finds exactly the groups that a scan finds") {
  size_t found_in_all = 0;
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    GrammarChunk chunk = cellOf(random, {}, 1, seed % 7 == 0 ? 9u : 400u, 60'000);
    // Some groups have equal bounds, and one has bounds that contain the whole world.
    for (size_t i = 0; i < chunk.groups.size() && seed % 3 == 0; i += 2)
      chunk.groups[i].bounds = chunk.groups[0].bounds;
    if (!chunk.groups.empty() && seed % 4 == 0) chunk.groups.back().bounds = IntBox::everything();
    const GroupIndex index(chunk);
    for (int i = 0; i < 40; ++i) {
      const Int3 at{within(random, 80'000), within(random, 80'000), within(random, 80'000)};
      const IntBox box = i == 0 ? IntBox::everything() : IntBox{at, at}.grown(1 << random() % 16);
      std::pmr::vector<uint32_t> expected, found{77};  // query() must keep the element that `found` already has
      for (uint32_t g = 0; g < chunk.groups.size(); ++g) {
        if (chunk.groups[g].bounds.meets(box)) expected.push_back(g);
      }
      index.query(box, found);
      REQUIRE(found[0] == 77);
      found.erase(found.begin());
      INFO("seed " << seed << ", query " << i);
      CHECK(found == expected);
      found_in_all += found.size();
    }
  }
  CHECK(found_in_all > 1000);
}

TEST_CASE("cells may come in any order") {
  for (uint32_t seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::vector<GrammarChunk> chunks;
    for (int i = 0; i < 7; ++i) {
      chunks.push_back(cellOf(random, {i % 2, i / 2, -i}, 3, 30, 20'000));
    }
    std::vector<GroupIndex> indices;
    for (const GrammarChunk& c : chunks) indices.emplace_back(c);
    std::vector<IndexedCell> cells;
    for (size_t i = 0; i < chunks.size(); ++i) cells.push_back({&chunks[i], &indices[i]});
    const Int3 at{within(random, 20'000), within(random, 20'000), within(random, 20'000)};
    const IntBox box = IntBox{at, at}.grown(8'000);
    const Result<FieldProgram> expected = compileField(cells, box, {});
    REQUIRE(expected);
    for (int round = 0; round < 5; ++round) {
      for (size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[random() % i]);
      const Result<FieldProgram> shuffled = compileField(cells, box, {});
      REQUIRE(shuffled);
      INFO("seed " << seed << ", round " << round << ", " << expected->groups.size() << " groups");
      CHECK(same(*expected, *shuffled));
    }
    // Groups are ordered by layer, and within a layer, adds come before cuts.
    for (size_t i = 1; i < expected->groups.size(); ++i) {
      const ProgramGroup &before = expected->groups[i - 1], &after = expected->groups[i];
      INFO("seed " << seed);
      CHECK((before.layer < after.layer || (before.layer == after.layer && before.cut <= after.cut)));
    }
  }
}

TEST_CASE("balls of a sum that weigh nothing where a field is read change no bit of it") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t left_out = 0, shown = 0;
  for (int round = 0; round < 60; ++round) {
    constexpr int32_t kExtent = 16 * 1024;
    const int32_t shift = round % 3 == 0 ? 20 : 0;
    const GrammarChunk chunk = sumOf(random, 60, kExtent, shift);
    const GroupIndex index(chunk);
    const IndexedCell cells[] = {{&chunk, &index}};
    const Int3 at{within(random, kExtent), within(random, kExtent), within(random, kExtent)};
    const int32_t half = 1 << (9 + random() % 5);
    const Result<FieldProgram> near = compileField(cells, IntBox{at, at}.grown(half), {});
    const Result<FieldProgram> whole = compileField(cells, IntBox::everything(), {});
    REQUIRE(near);
    REQUIRE(whole);
    REQUIRE(near->instrs.size() <= whole->instrs.size());
    // A warp evaluates its operand at displaced positions, so pruning for this box must not remove the operand.
    if (shift > 0) CHECK(near->instrs.size() == whole->instrs.size());
    left_out += whole->instrs.size() - near->instrs.size();
    const PointSet points = randomPoints(random, at, half, 500);
    const Evaluated expected = evaluate(scalarKernels(), whole->view(), points.points());
    shown += shows(expected);
    INFO("round " << round);
    CHECK(differentBits(expected, evaluate(scalarKernels(), near->view(), points.points())) == 0);
  }
  CHECK(left_out > 1000);
  CHECK(shown > 20);
}
