// Tests finding the place under the mouse pointer.

#include "tools/preview/pointed_place.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "world/world_support.h"

using namespace sgm;
using namespace sgm::preview;

namespace {

constexpr const char* kTwo = R"(sgm 1;
units m;
start Two;
rule Two {
  at(-4m, 0m, 0m) Ball(2m);
  at(4m, 0m, 0m) { box(3m, 3m, 3m); mat brick; }
}
rule Ball(r) { sphere(r); mat marble; tag "ball"; }
)";

}  // namespace

TEST_CASE("a ray finds what made the surface that it meets", "[preview]") {
  const WorldField world(settingsOf(kTwo, kUnitsPerMetre / 8), std::pmr::new_delete_resource());
  const auto place = placeOnRay(world, "two.sgm", {-4, 0, 10}, {0, 0, -3});
  REQUIRE(place);
  REQUIRE(*place);
  CHECK((**place).position[2] == Approx(2).margin(0.02));
  CHECK((**place).path == "Two/Ball[0]");
  CHECK((**place).source == "two.sgm:8:16");
  CHECK((**place).material == "marble");
  CHECK((**place).tag == "ball");

  const auto box = placeOnRay(world, "two.sgm", {4, 10, 0}, {0, -1, 0});
  REQUIRE(box);
  REQUIRE(*box);
  CHECK((**box).position[1] == Approx(1.5).margin(0.02));
  CHECK((**box).path == "Two");
  CHECK((**box).source == "two.sgm:6:20");
  CHECK((**box).material == "brick");
  CHECK((**box).tag.empty());
}

TEST_CASE("a ray that meets nothing finds no place", "[preview]") {
  const WorldField world(settingsOf(kTwo, kUnitsPerMetre / 8), std::pmr::new_delete_resource());
  const auto place = placeOnRay(world, "two.sgm", {0, 0, 10}, {0, 1, 0});
  REQUIRE(place);
  CHECK_FALSE(*place);
}

TEST_CASE("a ray from outside of the world is refused", "[preview]") {
  const WorldField world(settingsOf(kTwo, kUnitsPerMetre / 8), std::pmr::new_delete_resource());
  const auto place = placeOnRay(world, "two.sgm", {1e9, 0, 0}, {0, 1, 0});
  REQUIRE_FALSE(place);
  CHECK(place.error().code == Code::range);
}
