// Tests queries of a field through the C interface: of a ball's surface and a floor, also from many threads.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <thread>

#include "fixture.h"

namespace {

/// Calls the query `call(point, error)`, which must succeed, and returns the point that it writes.
template <class Call>
sgm_surface_point answered(const Call& call) {
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = call(&point, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return point;
}

sgm_surface_point castDown(sgm_field* field, double x, double y, double z, double metres) {
  sgm_ray_desc desc = SGM_RAY_DESC_INIT;
  std::ranges::copy(std::array{x, y, z}, desc.from);
  desc.length = metres;
  return answered([&](auto* point, auto* error) { return sgm_field_ray_cast(field, &desc, point, error); });
}

sgm_surface_point nearest(sgm_field* field, double x, double y, double z, double metres) {
  sgm_closest_desc desc = SGM_CLOSEST_DESC_INIT;
  std::ranges::copy(std::array{x, y, z}, desc.position);
  desc.max_distance = metres;
  return answered([&](auto* point, auto* error) { return sgm_field_closest_point(field, &desc, point, error); });
}

bool empty(const sgm_surface_point& point) {
  return point.found == 0 && point.inside == 0 && point.distance == 0 && point.position[0] == 0 && point.normal[1] == 0;
}

}  // namespace

TEST_CASE("a ray and the nearest point find the ball's surface, in units and metres") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  // The ball has a radius of 3 m around (4, 4, 4) m.
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

TEST_CASE(
    "a way leads round the ball, as wide as there is room in the region, and its places come in the caller's array") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  // Search a path from one side of the ball (radius 3 m around (4, 4, 4) m) to the other, in cells of 0.25 m.
  sgm_way_desc desc = SGM_WAY_DESC_INIT;
  for (int32_t& v : desc.maximum) v = 8 * 1024;
  desc.from[0] = 0.25 * 1024;
  desc.to[0] = 7.75 * 1024;
  desc.from[1] = desc.from[2] = desc.to[1] = desc.to[2] = 4 * 1024;
  std::vector<int32_t> places(3 * 4096, 77);
  desc.places = places.data();
  desc.place_room = places.size() / 3;
  desc.flags = SGM_WAY_WIDEST;
  sgm_way way = SGM_WAY_INIT;
  REQUIRE(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
  CHECK(way.verdict == SGM_WAY_FOUND);
  CHECK(way.length > 7.5);
  CHECK(way.length < 16);
  CHECK(way.from_clearance == Approx(0.75).margin(0.26));
  // the widest agent is limited by the clearance at an end of the path, not by a narrow place within the path
  CHECK(way.widest == way.from_clearance);
  CHECK(way.void_count == 1);
  CHECK(way.sealed_count == 0);
  CHECK(way.from_volume == way.largest_volume);
  CHECK(way.largest_volume == Approx(8.25 * 8.25 * 8.25 - 4.0 / 3 * 3.14159 * 27).epsilon(0.05));
  REQUIRE(way.place_count > 30);
  CHECK((places[0] == 256 && places[1] == 4096));
  CHECK(places[3 * way.place_count - 3] == 7.75 * 1024);
  CHECK(places[3 * way.place_count] == 77);
  for (size_t i = 0; i < way.place_count; ++i) {
    const int32_t* p = places.data() + 3 * i;
    const double square =
        (p[0] - 4096.0) * (p[0] - 4096.0) + (p[1] - 4096.0) * (p[1] - 4096.0) + (p[2] - 4096.0) * (p[2] - 4096.0);
    REQUIRE(square > (3 * 1024.0) * (3 * 1024.0));
  }

  const std::vector<int32_t> all = places;
  places.assign(places.size(), 77);
  desc.place_room = 2;
  sgm_way again = SGM_WAY_INIT;
  CHECK(sgm_field_find_way(field.get(), &desc, &again, nullptr) == SGM_INCOMPLETE);
  CHECK(again.place_count == way.place_count);
  CHECK((std::equal(all.begin(), all.begin() + 6, places.begin()) && places[6] == 77));

  desc.places = nullptr;
  desc.radius = 1.2;
  REQUIRE(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
  CHECK(way.verdict == SGM_WAY_FROM_TOO_NARROW);
  CHECK((way.place_count == 0 && way.length == 0 && way.widest == again.widest && way.from_volume == 0));
  desc.from[0] = 4096;
  desc.flags = 0;
  REQUIRE(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
  CHECK(way.verdict == SGM_WAY_FROM_IN_ROCK);
  CHECK((way.from_clearance == 0 && way.widest == 0));
}

TEST_CASE("the radius that a way is widest for has none, and the number before it has one") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  sgm_way_desc desc = SGM_WAY_DESC_INIT;
  for (int32_t& v : desc.maximum) v = 8 * 1024;
  desc.to[0] = 7.75 * 1024;
  // Query positions around the ball at many different distances from the nearest samples.
  size_t odd = 0;
  for (int place = 0; place < 24; ++place) {
    CAPTURE(place);
    for (int axis = 0; axis < 3; ++axis) desc.to[axis] = desc.from[axis] = axis == place % 3 ? 256.0 : 256.0 * place;
    desc.radius = 0;
    desc.flags = SGM_WAY_WIDEST;
    sgm_way way = SGM_WAY_INIT;
    REQUIRE(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
    if (way.widest == 0) continue;
    const double cells = way.widest * 4;
    odd += cells != std::floor(cells);
    desc.flags = 0;
    desc.radius = way.widest;
    sgm_way again = SGM_WAY_INIT;
    REQUIRE(sgm_field_find_way(field.get(), &desc, &again, nullptr) == SGM_OK);
    CHECK(again.verdict == SGM_WAY_FROM_TOO_NARROW);
    desc.radius = std::nextafter(way.widest, 0);
    REQUIRE(sgm_field_find_way(field.get(), &desc, &again, nullptr) == SGM_OK);
    CHECK(again.verdict == SGM_WAY_FOUND);
  }
  CHECK(odd > 3);
}

namespace {

/// Records the calls of a progress callback. A run of calls begins with a call in which `done` is 1. runs: for each
/// run, the last `done` and the total.
struct Told {
  std::vector<std::array<uint64_t, 2>> runs;
  size_t calls = 0, stop_at = 0;  ///< number of calls so far; number of the call that cancels the work (0: none)
  bool steady = true;             ///< true if in each run `done` rose by one each time, and the total stayed the same
};

int32_t tell(void* user, uint64_t done, uint64_t total) {
  Told& told = *static_cast<Told*>(user);
  if (done == 1) told.runs.push_back({0, total});
  told.steady = told.steady && !told.runs.empty() && done == told.runs.back()[0] + 1 && total == told.runs.back()[1] &&
                done <= total;
  if (!told.runs.empty()) told.runs.back()[0] = done;
  return ++told.calls == told.stop_at ? 1 : 0;
}

}  // namespace

TEST_CASE("a way tells of each look at its region and of its walk, in a flat region too, and stops in any of them",
          "[costly]") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  for (const int flat : {0, 1, 2}) {
    CAPTURE(flat);
    // The searched region has 9 by 9 chunks of 8 m, and is one chunk thick along the axis `flat`.
    sgm_way_desc desc = SGM_WAY_DESC_INIT;
    for (int axis = 0; axis < 3; ++axis) {
      desc.maximum[axis] = (axis == flat ? 8 : 72) * 1024;
      desc.from[axis] = 256;
      desc.to[axis] = axis == flat ? 256 : 70 * 1024;
    }
    desc.flags = SGM_WAY_WIDEST;
    Told told;
    desc.progress = tell;
    desc.progress_user = &told;
    sgm_way way = SGM_WAY_INIT;
    REQUIRE(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
    REQUIRE(way.verdict == SGM_WAY_FOUND);
    CHECK(told.steady);
    // Expected runs of progress calls: one for sampling the region, one for the search, and at most two more for
    // sampling with wider agents.
    REQUIRE((told.runs.size() >= 3 && told.runs.size() <= 4));
    for (size_t run = 0; run < told.runs.size(); ++run) {
      CAPTURE(run);
      CHECK(told.runs[run][0] == told.runs[run][1]);
      if (run != 1) CHECK(told.runs[run][1] == 81);
    }
    CHECK((told.runs[1][1] >= 9 && told.runs[1][1] < 81));

    const size_t walk = 81 + told.runs[1][1];
    for (const size_t stop : {size_t{1}, size_t{50}, size_t{82}, walk + 1, walk + 80}) {
      CAPTURE(stop);
      Told stopped;
      stopped.stop_at = stop;
      desc.progress_user = &stopped;
      way.verdict = 77;
      CHECK(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_ERR_CANCELLED);
      CHECK((stopped.calls == stop && stopped.steady && way.verdict == 77));
    }
    // Cancelling in the last progress call of a run has no effect, since that work is complete.
    desc.flags = 0;
    Told last;
    last.stop_at = walk;
    desc.progress_user = &last;
    CHECK(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
    CHECK((last.calls == walk && last.runs.size() == 2));
  }
}

TEST_CASE("an end outside of the region is told by its name, in units") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  sgm_way_desc desc = SGM_WAY_DESC_INIT;
  for (int32_t& v : desc.maximum) v = 8 * 1024;
  desc.to[1] = 9000.5;
  sgm_way way = SGM_WAY_INIT;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_field_find_way(field.get(), &desc, &way, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(std::string(error.message) ==
        "the end `to` of the path lies outside of the region: it is at (0, 9000.5, 0), but the region goes from "
        "(0, 0, 0) to (8192, 8192, 8192), in units of 1/1024 m");
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
