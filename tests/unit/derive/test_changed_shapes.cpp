// Tests that every change of a member of a derived cell is noticed: it changes the cell's hash, and changedShapes()
// reports changed shapes.

#include "catch.h"
#include "derive/changed_shapes.h"
#include "derive/chunk_ops.h"

using namespace sgm;

namespace {

/// A cell with all kinds of members: a warped union of a prism and of voxels, expressions with every kind of reference,
/// and an anchor.
GrammarChunk everything() {
  GrammarChunk chunk;
  chunk.points = {{0, 0, 0}, {9, 0, 0}, {0, 0, 9}, {5, 5, 5}};
  chunk.noises = {{{1, 2, 3}, 1024, 2, 7}};
  chunk.blocks = {{{1, 2, 3}, 16, {0, 0, 0}, {2, 2, 2}, 0}};
  chunk.voxels = {0x5A};
  Expr constant, noise, sum;
  constant.value = 0.25f;
  noise.op = ExprOp::noise;
  noise.noise = 0;
  sum.op = ExprOp::add;
  sum.a = 0;
  sum.b = 1;
  sum.first_point = 1;
  sum.point_count = 1;
  chunk.exprs = {constant, noise, sum, constant, noise};
  Shape prism, voxels, both;
  prism.kind = ShapeKind::prism;
  prism.material = 1;
  prism.tag = 1;
  prism.point_count = 3;
  prism.size[0] = 4;
  voxels.kind = ShapeKind::voxels;
  voxels.block = 0;
  both.kind = ShapeKind::warp;
  both.child_count = 1;
  both.expr = 0;
  Shape unite;
  unite.kind = ShapeKind::unite;
  unite.first_child = 1;
  unite.child_count = 2;
  chunk.shapes = {prism, voxels, unite, both};
  chunk.children = {2, 0, 1, 0};
  chunk.groups = {{3, false, {{0, 0, 0}, {9, 9, 9}}, PathKey{1}}};
  Anchor anchor;
  anchor.kind = anchor.name = anchor.tag = 1;
  anchor.key = {2};
  chunk.anchors = {anchor};
  return chunk;
}

}  // namespace

TEST_CASE("both hashes see every member of shapes, expressions and anchors", "[changes]") {
  Program program(std::pmr::get_default_resource());
  for (auto* table : {&program.materials, &program.tags, &program.names})
    for (const char* text : {"", "a", "b"}) table->emplace_back(text);
  const GrammarChunk before = everything();
  CHECK(changedShapes({program, &before}, {program, &before}).empty());
  const auto notices = [&](const auto& change) {
    GrammarChunk after = everything();
    change(after);
    return hashChunk(before) != hashChunk(after) && !changedShapes({program, &before}, {program, &after}).empty();
  };
  const auto noticesShape = [&](size_t shape, const auto& change) {
    return notices([&](GrammarChunk& chunk) { change(chunk.shapes[shape]); });
  };
  CHECK(noticesShape(0, [](Shape& s) { s.kind = ShapeKind::box; }));
  CHECK(noticesShape(0, [](Shape& s) { s.material = 2; }));
  CHECK(noticesShape(0, [](Shape& s) { s.tag = 2; }));
  CHECK(noticesShape(2, [](Shape& s) { s.first_child = 2; }));
  CHECK(noticesShape(2, [](Shape& s) { s.child_count = 1; }));
  CHECK(noticesShape(3, [](Shape& s) { s.expr = 1; }));
  CHECK(noticesShape(0, [](Shape& s) { s.first_point = 1; }));
  CHECK(noticesShape(0, [](Shape& s) { s.point_count = 2; }));
  CHECK(noticesShape(1, [](Shape& s) { s.block = kNone; }));
  CHECK(noticesShape(0, [](Shape& s) { s.detail = 5; }));
  CHECK(noticesShape(0, [](Shape& s) { s.coarsest = 5; }));
  CHECK(noticesShape(0, [](Shape& s) { s.amount = 5; }));
  CHECK(noticesShape(0, [](Shape& s) { s.inner_radius = 5; }));
  for (size_t i = 0; i < 6; ++i) CHECK(noticesShape(0, [i](Shape& s) { s.size[i] += 1; }));
  CHECK(noticesShape(0, [](Shape& s) { s.frame.origin.y = 5; }));
  for (size_t i = 0; i < 9; ++i) CHECK(noticesShape(0, [i](Shape& s) { s.frame.rows[i] += 0.5f; }));

  const auto noticesExpr = [&](size_t expr, const auto& change) {
    return notices([&](GrammarChunk& chunk) { change(chunk.exprs[expr]); });
  };
  CHECK(noticesExpr(2, [](Expr& e) { e.op = ExprOp::subtract; }));
  CHECK(noticesExpr(2, [](Expr& e) { e.a = 1; }));
  CHECK(noticesExpr(2, [](Expr& e) { e.b = 0; }));
  CHECK(noticesExpr(2, [](Expr& e) { e.c = 0; }));
  CHECK(noticesExpr(0, [](Expr& e) { e.value = 1; }));
  CHECK(noticesExpr(0, [](Expr& e) { e.anchor.z = 1; }));
  for (size_t i = 0; i < 3; ++i) CHECK(noticesExpr(0, [i](Expr& e) { e.row[i] = 1; }));
  CHECK(noticesExpr(0, [](Expr& e) { e.noise = 0; }));
  CHECK(noticesExpr(2, [](Expr& e) { e.first_point = 2; }));
  CHECK(noticesExpr(2, [](Expr& e) { e.point_count = 2; }));

  CHECK(notices([](GrammarChunk& chunk) { chunk.noises[0].origin.x = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.noises[0].period = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.noises[0].octaves = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.noises[0].seed = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.blocks[0].anchor.x = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.blocks[0].edge = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.blocks[0].first.x = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.blocks[0].count.x = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.voxels[0] = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.points[1].x = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.groups[0].cut = true; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.groups[0].key = {3}; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.anchors[0].frame.origin.x = 5; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.anchors[0].kind = 2; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.anchors[0].name = 2; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.anchors[0].tag = 2; }));
  CHECK(notices([](GrammarChunk& chunk) { chunk.anchors[0].key = {3}; }));
}
