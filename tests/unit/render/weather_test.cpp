// Tests the exposure of places to rain and dirt.

#include "scenes.h"
#include "tools/render/light_planes.h"

using namespace sgm;

namespace {

constexpr int kWidth = 64, kHeight = 48;

/// A wall 6 m high on a floor; a slab projects from its left half at a height of 4 m.
struct Wall {
  TestMesh mesh;
  std::vector<RenderMaterial> materials{{SurfacePattern::plain, glm::vec3(0.5f), 0.9f, 1.0f}};

  Wall() {
    add({-60, 0, 60}, {60, 0, 60}, {60, 0, -60}, {-60, 0, -60});
    add({-8, 0, 0}, {8, 0, 0}, {8, 6, 0}, {-8, 6, 0});
    add({-8, 4, 0}, {0, 4, 0}, {0, 4, 0.4f}, {-8, 4, 0.4f});
  }

  void add(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& corner : {a, b, c, d}) mesh.vertices.push_back({corner, n, 0});
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  }

  LightPlanes traced(Background background) const {
    RenderScene scene;
    scene.vertices = mesh.vertices;
    scene.indices = mesh.indices;
    scene.materials = materials;
    scene.background = background;
    scene.camera = {{0, 3, 8}, {0, 3, 0}, 60, kWidth, kHeight};
    auto jobs = makeThreadPool(1);
    REQUIRE(jobs);
    auto planes = traceLight(scene, frameOf(scene), **jobs);
    REQUIRE(planes);
    return std::move(*planes);
  }
};

/// The exposure (SoftLight::lie) of a place on the wall, x metres to the right of its middle and y metres above the
/// floor.
glm::vec4 lieAt(const LightPlanes& planes, float x, float y) {
  const float metres = 2 * 8 * std::tan(30 * 3.14159265f / 180) / kHeight;
  const auto u = static_cast<uint32_t>(kWidth / 2 + x / metres),
             v = static_cast<uint32_t>(kHeight / 2 - (y - 3) / metres);
  return planes.soft[size_t{v} / kSoftPixels * planes.soft_width + u / kSoftPixels].lie;
}

}  // namespace

TEST_CASE("dirt finds corners, the foot of a wall and what lies under a ledge", "[render]") {
  const LightPlanes planes = Wall().traced(Background::sky);
  CHECK(lieAt(planes, -3, 3.5f).y > 0.6f);
  CHECK(lieAt(planes, -3, 2.5f).y < lieAt(planes, -3, 3.5f).y);
  CHECK(lieAt(planes, 3, 3.5f).y == 0);  // the place is not below the slab
  CHECK(lieAt(planes, 3, 0.4f).z > 0.5f);
  CHECK(lieAt(planes, 3, 3).z == 0);
  CHECK(lieAt(planes, 3, 0.3f).x > 2 * lieAt(planes, 3, 3).x);
  CHECK(lieAt(planes, 3, 3).x == Approx(0).margin(0.02));
  for (const SoftLight& soft : planes.soft) {
    for (int i = 0; i < 3; ++i) {
      REQUIRE(soft.lie[i] >= 0);
      REQUIRE(soft.lie[i] <= 1);
    }
  }
}

TEST_CASE("there is no weather in caves", "[render]") {
  for (const SoftLight& soft : Wall().traced(Background::cave).soft) REQUIRE(soft.lie == glm::vec4(0));
}

TEST_CASE("the brightest twentieth of what is in sight is brighter than the mean", "[render]") {
  const LightPlanes planes = Wall().traced(Background::sky);
  CHECK(planes.brightness > 0);
  CHECK(planes.highlight > planes.brightness);
  CHECK(planes.highlight < 2.5f);  // the limit is half of the brightness that direct sun and sky together could give
}
