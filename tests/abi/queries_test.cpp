// Questions to the field through C: a ball's surface, a floor, and the same from many threads.

#include <cmath>
#include <thread>

#include "fixture.h"

namespace {

sgm_surface_point castDown(sgm_field* field, double x, double y, double z, double metres) {
  sgm_ray_desc desc = SGM_RAY_DESC_INIT;
  desc.from[0] = x;
  desc.from[1] = y;
  desc.from[2] = z;
  desc.length = metres;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_field_ray_cast(field, &desc, &point, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return point;
}

sgm_surface_point nearest(sgm_field* field, double x, double y, double z, double metres) {
  sgm_closest_desc desc = SGM_CLOSEST_DESC_INIT;
  desc.position[0] = x;
  desc.position[1] = y;
  desc.position[2] = z;
  desc.max_distance = metres;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_field_closest_point(field, &desc, &point, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return point;
}

bool empty(const sgm_surface_point& point) {
  return point.found == 0 && point.inside == 0 && point.distance == 0 && point.position[0] == 0 && point.normal[1] == 0;
}

}  // namespace

TEST_CASE("a ray and the nearest point find the ball's surface, in units and metres") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  // 3 m around (4, 4, 4) m.
  const sgm_surface_point top = castDown(field.get(), 4096.5, 9 * 1024, 4096, 5);
  REQUIRE(top.found == 1);
  CHECK(top.inside == 0);
  CHECK(top.distance == Approx(2).margin(2.0 / 1024));
  CHECK(top.position[0] == 4096.5);
  CHECK(top.position[1] == Approx(7 * 1024).margin(2));
  CHECK(top.normal[1] == Approx(1).margin(1e-3));
  CHECK(top.material == 1);
  CHECK(top.tag == 1);
  CHECK(empty(castDown(field.get(), 4096, 9 * 1024, 4096, 1.9)));
  CHECK(empty(castDown(field.get(), 0, 9 * 1024, 0, 100)));
  const sgm_surface_point inside = castDown(field.get(), 4096, 4096, 4096, 5);
  CHECK(inside.found == 1);
  CHECK(inside.inside == 1);
  CHECK(inside.distance == 0);

  const sgm_surface_point side = nearest(field.get(), 4096 + 5 * 1024, 4096, 4096, 10);
  REQUIRE(side.found == 1);
  CHECK(side.distance == Approx(2).margin(2.0 / 1024));
  CHECK(side.normal[0] == Approx(1).margin(1e-3));
  CHECK(empty(nearest(field.get(), 4096 + 5 * 1024, 4096, 4096, 1.9)));
  CHECK(nearest(field.get(), 4096, 4096, 5 * 1024, 10).inside == 1);
}

TEST_CASE("a box is walkable on a floor, and not beside it") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar =
      compile(runtime.get(), "sgm 1;\nunits m;\nstart Main;\nrule Main { at(4m, 0m, 4m) box(6m, 2m, 20m); }\n");
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  sgm_walk_desc desc = SGM_WALK_DESC_INIT;
  for (int32_t& v : desc.maximum) v = 8 * 1024;
  sgm_walkable walkable = SGM_WALKABLE_INIT;
  REQUIRE(sgm_field_is_walkable(field.get(), &desc, &walkable, nullptr) == SGM_OK);
  CHECK(walkable.walkable == 1);
  CHECK(walkable.standing == Approx(6 * 8).epsilon(0.1));
  CHECK(walkable.largest == walkable.standing);
  CHECK(walkable.sides == (1u << SGM_FACE_Z_LOW | 1u << SGM_FACE_Z_HIGH));
  desc.area = 100;
  REQUIRE(sgm_field_is_walkable(field.get(), &desc, &walkable, nullptr) == SGM_OK);
  CHECK(walkable.walkable == 0);
  desc.area = 0;
  desc.minimum[1] = 2 * 1024;
  REQUIRE(sgm_field_is_walkable(field.get(), &desc, &walkable, nullptr) == SGM_OK);
  CHECK(walkable.walkable == 0);
  CHECK(walkable.standing == 0);
  CHECK(walkable.sides == 0);
}

TEST_CASE("many threads ask one field", "[threads]") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  const double expected = castDown(field.get(), 4096, 9 * 1024, 4096, 5).distance;
  const double near = nearest(field.get(), 4096, 9 * 1024, 4096, 5).distance;
  std::array<bool, 4> same{};
  std::vector<std::thread> threads;
  for (bool& ok : same) {
    threads.emplace_back([&] {
      ok = true;
      for (int i = 0; i < 50; ++i) {
        sgm_ray_desc ray = SGM_RAY_DESC_INIT;
        sgm_closest_desc closest = SGM_CLOSEST_DESC_INIT;
        ray.from[0] = ray.from[2] = closest.position[0] = closest.position[2] = 4096;
        ray.from[1] = closest.position[1] = 9 * 1024;
        ray.length = closest.max_distance = 5;
        sgm_surface_point a = SGM_SURFACE_POINT_INIT, b = SGM_SURFACE_POINT_INIT;
        ok = ok && sgm_field_ray_cast(field.get(), &ray, &a, nullptr) == SGM_OK && a.distance == expected &&
             sgm_field_closest_point(field.get(), &closest, &b, nullptr) == SGM_OK && b.distance == near;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const bool ok : same) CHECK(ok);
}
