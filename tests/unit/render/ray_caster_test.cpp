#include "tools/render/ray_caster.h"

#include <random>

#include "scenes.h"

using namespace sgm;

namespace {

// Finds the nearest hit by testing each triangle.
std::optional<RayHit> castSlowly(const TestMesh& mesh, glm::vec3 from, glm::vec3 direction, float max_distance) {
  std::optional<RayHit> nearest;
  for (uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const std::span<const uint32_t> one(mesh.indices.data() + size_t{3} * t, 3);
    const Result<RayCaster> alone = RayCaster::over(mesh.vertices, one);
    REQUIRE(alone);
    auto hit = alone->cast(from, direction, nearest ? nearest->distance : max_distance);
    if (hit) nearest = RayHit{hit->distance, hit->front, t, hit->u, hit->v, hit->facing};
  }
  return nearest;
}

}  // namespace

TEST_CASE("the tree finds what asking every triangle finds", "[render]") {
  const unsigned seed = 20260;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto point = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  for (const size_t triangles : {1u, 7u, 8u, 9u, 63u, 500u}) {
    TestMesh mesh;
    for (size_t t = 0; t < triangles; ++t) {
      const glm::vec3 centre = 10.0f * point();
      for (int c = 0; c < 3; ++c) {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back({centre + 1.5f * point(), {}, 0});
      }
    }
    const Result<RayCaster> tree = RayCaster::over(mesh.vertices, mesh.indices);
    REQUIRE(tree);
    int hits = 0;
    for (int ray = 0; ray < 100; ++ray) {
      const glm::vec3 from = 12.0f * point();
      glm::vec3 direction = glm::normalize(-from + 6.0f * point());
      if (ray % 10 == 0) direction = {0, 0, from.z > 0 ? -1 : 1};
      const auto fast = tree->cast(from, direction, 30), slow = castSlowly(mesh, from, direction, 30);
      REQUIRE(fast.has_value() == slow.has_value());
      if (!fast) continue;
      ++hits;
      CHECK(fast->distance == slow->distance);
      CHECK(fast->front == slow->front);
      CHECK(fast->triangle == slow->triangle);
      const glm::vec3 facing = glm::normalize(tree->facing(fast->triangle));
      CHECK(glm::distance(glm::normalize(fast->facing), facing) < 1e-3f);
    }
    CHECK((triangles < 100 || hits > 10));
  }
}

TEST_CASE("sides and distances are told apart", "[render]") {
  const TestMesh solid = sphereMesh({0, 0, 0}, 2, false, 32);
  const Result<RayCaster> tree = RayCaster::over(solid.vertices, solid.indices);
  REQUIRE(tree);
  const auto outside = tree->cast({0, 0.1f, 10}, {0, 0, -1}, 100), inside = tree->cast({0, 0.1f, 0}, {0, 0, -1}, 100);
  REQUIRE((outside && inside));
  CHECK(outside->front);
  CHECK(!inside->front);
  CHECK(outside->distance == Approx(8).margin(0.05));
  CHECK(inside->distance == Approx(2).margin(0.05));
  CHECK(!tree->cast({0, 0.1f, 10}, {0, 0, -1}, 7));
  CHECK(!tree->cast({0, 0.1f, 10}, {0, 0, 1}, 100));
  const TestMesh empty;
  const Result<RayCaster> nothing = RayCaster::over(empty.vertices, empty.indices);
  REQUIRE(nothing);
  CHECK(!nothing->cast({0, 0, 0}, {0, 0, 1}, 100));
}

TEST_CASE("some light passes a crown that was loosened, all a pane, and none other bodies", "[render]") {
  const TestMesh ball = sphereMesh({0, 0, 0}, 3, false);
  Result<RayCaster> mesh = RayCaster::over(ball.vertices, ball.indices);
  REQUIRE(mesh);
  const auto passing = [&] {
    int free = 0;
    for (int i = 0; i < 40 * 40; ++i) {
      const glm::vec3 from(0.1f * static_cast<float>(i % 40 - 20), -9, 0.1f * static_cast<float>(i / 40 - 20));
      free += mesh->isFree(from, {0, 1, 0}, 100);
    }
    return free;
  };
  CHECK(passing() == 0);
  const std::array<LetsLight, 1> leaf{LetsLight::in_spots}, pane{LetsLight::always}, other{LetsLight::never};
  mesh->loosen(leaf, glm::vec3(0));
  const int through = passing();
  CHECK(through > 1600 * 0.04);
  CHECK(through < 1600 * 0.45);
  CHECK(passing() == through);
  mesh->loosen(pane, glm::vec3(0));
  CHECK(passing() == 1600);
  mesh->loosen(other, glm::vec3(0));
  CHECK(passing() == 0);
}
