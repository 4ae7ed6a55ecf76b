#include "catch.h"
#include "derive/draft.h"
#include "field_reference.h"

using namespace sgm;

TEST_CASE("constants fold and leave no expression behind") {
  Draft draft(std::pmr::get_default_resource());
  CHECK(draft.binary(ExprOp::add, {2}, {3}).value == 5);
  CHECK(draft.mix({2}, {4}, {0.5}).value == 3);
  CHECK(draft.smoothstep(0, 2, {1}).value == 0.5);
  CHECK(draft.smoothstep(2, 0, {1.5}).value == Approx(0.15625));
  CHECK(draft.clamp({5}, {0}, {1}).value == 1);
  CHECK(draft.unary(ExprOp::square_root, {-4}).value == 0);
  CHECK(draft.chunk().exprs.empty());
}

TEST_CASE("equal expressions are one, and neutral operands vanish") {
  Draft draft(std::pmr::get_default_resource());
  const Num y = draft.coordinate({}, {0, 1, 0});
  CHECK(draft.coordinate({}, {0, 1, 0}).node == y.node);
  CHECK(draft.coordinate({0, 1, 0}, {0, 1, 0}).node != y.node);
  CHECK(draft.binary(ExprOp::multiply, y, {1}).node == y.node);
  CHECK(draft.binary(ExprOp::add, {0}, y).node == y.node);
  CHECK(draft.binary(ExprOp::multiply, {0}, y).constant());
  const Num half = draft.binary(ExprOp::divide, y, {2});
  CHECK(draft.binary(ExprOp::multiply, y, {0.5}).node == half.node);
}

TEST_CASE("finish keeps what the groups reach, in order, and nothing else") {
  Draft draft(std::pmr::get_default_resource());
  const Origin origin{PathKey{1}, 0, {}};
  const Num y = draft.coordinate({}, {0, 1, 0});
  const Num unused = draft.binary(ExprOp::add, y, {7});
  NoiseSpec spec;
  spec.seed = 9;
  const Num noise = draft.noise(spec);
  const uint32_t line = draft.addPolyline({{1, 2, 3}, {4, 5, 6}});
  const uint32_t orphan = draft.addShape(Shape{}, origin);
  Shape ball;
  ball.size[0] = 100;
  const uint32_t child = draft.addShape(ball, origin);
  Shape warp;
  warp.kind = ShapeKind::warp;
  warp.expr = draft.triple({noise, draft.sweep(line), Num{0.25}});
  const std::vector<uint32_t> children{child};
  const uint32_t root = draft.addShape(warp, origin, children);
  REQUIRE_FALSE(unused.constant());
  REQUIRE(orphan == 0);

  GrammarChunk out;
  const std::vector<Group> groups{{root, false, {}, PathKey{1}}};
  DraftCopier(draft.chunk()).copy(groups, out);
  REQUIRE(out.shapes.size() == 2);
  CHECK(out.groups[0].root == 1);
  CHECK(out.children[out.shapes[1].first_child] == 0);
  CHECK(out.exprs.size() == 6);
  CHECK(out.noises.size() == 1);
  CHECK(out.points.size() == 2);
  CHECK(reference::exprAt(out, out.shapes[1].expr, {}) == reference::noiseAt(9, {}));
  CHECK(reference::exprAt(out, out.shapes[1].expr + 1, {}) == 0.5);
  CHECK(reference::exprAt(out, out.shapes[1].expr + 2, {}) == 0.25);
}
