// Tests the drawn sky, and the land that is drawn beyond the end of the world.

#include "tools/render/land.h"

#include <algorithm>

#include "scenes.h"

using namespace sgm;

namespace {

/// Adds a floor, as triangles that face up.
void addFloor(TestMesh& mesh, glm::vec2 lo, glm::vec2 hi, float height, uint32_t material) {
  constexpr int kCells = 20;
  const glm::vec2 step = (hi - lo) / static_cast<float>(kCells);
  for (int i = 0; i < kCells * kCells; ++i) {
    const glm::vec2 at = lo + step * glm::vec2(i % kCells, i / kCells);
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0)}) {
      const glm::vec2 place = at + step * corner;
      mesh.vertices.push_back({{place.x, height, place.y}, {0, 1, 0}, material, material});
    }
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
  }
}

RenderScene outdoors(const TestMesh& mesh, std::span<const RenderMaterial> materials) {
  RenderScene scene;
  scene.vertices = mesh.vertices;
  scene.indices = mesh.indices;
  scene.materials = materials;
  scene.background = Background::sky;
  scene.camera = {{0, 2, 40}, {0, 2, 0}, 60, 96, 96};
  return scene;
}

int channel(const Image& image, int x, int y, int c) {
  return image.rgba[static_cast<size_t>(4 * (y * image.width + x) + c)];
}

/// Returns red minus blue of a pixel of the sky: negative for blue sky, near 0 for a white cloud.
int whiteness(const Image& image, int x, int y) { return channel(image, x, y, 0) - channel(image, x, y, 2); }

}  // namespace

TEST_CASE("land goes on at the height of the ground that the camera looks to", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("grass"), materialByName("sand"), materialByName("brick")};
  TestMesh mesh;
  addFloor(mesh, {-50, -50}, {50, 0}, 0.5f, 0);
  addFloor(mesh, {-50, 0}, {50, 50}, -7, 1);
  RenderScene scene = outdoors(mesh, materials);
  const std::optional<Land> ahead = landAround(scene);
  REQUIRE(ahead);
  CHECK(ahead->material == 0);
  CHECK(ahead->height == 0.5f);
  CHECK(!ahead->bare);
  scene.camera.position = {0, 2, -10};
  const std::optional<Land> behind = landAround(scene);
  REQUIRE(behind);
  CHECK(behind->material == 1);
  CHECK(behind->height == -7);
  CHECK(behind->bare);
}

TEST_CASE("no land lies under what is whole, nor under what is made", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("grass"), materialByName("plaster"),
                                              materialByName("water")};
  for (const uint32_t material : {0u, 1u, 2u}) {
    CAPTURE(material);
    TestMesh cut;
    addFloor(cut, {-50, -50}, {50, 50}, 0, material);
    CHECK(landAround(outdoors(cut, materials)).has_value() == (material == 0));
  }
  // A floor between two walls. Only the walls reach the region's border, so the floor does not count as the region's
  // ground.
  TestMesh whole;
  addFloor(whole, {-49, -49}, {49, 49}, 0, 0);
  for (const float x : {-50.0f, 50.0f}) {
    const auto first = static_cast<uint32_t>(whole.vertices.size());
    for (const glm::vec2 corner : {glm::vec2(-50, -1), glm::vec2(50, -1), glm::vec2(0, 4)})
      whole.vertices.push_back({{x, corner.y, corner.x}, {1, 0, 0}, 0, 0});
    for (uint32_t i = 0; i < 3; ++i) whole.indices.push_back(first + i);
  }
  CHECK_FALSE(landAround(outdoors(whole, materials)));
}

TEST_CASE("where something grows the land is alive, however much rock stands beside it", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("limestone"), materialByName("grass")};
  TestMesh mesh;
  addFloor(mesh, {-50, -50}, {20, 50}, 1, 0);
  addFloor(mesh, {20, -50}, {50, 50}, 0, 1);
  const std::optional<Land> land = landAround(outdoors(mesh, materials));
  REQUIRE(land);
  CHECK(land->material == 1);
  CHECK(!land->bare);
}

TEST_CASE("without ground at its border a world has no land around it", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("grass")};
  const TestMesh none;
  CHECK(!landAround(outdoors(none, materials)));
  TestMesh above;
  addFloor(above, {-50, -50}, {50, 50}, 9, 0);  // the floor is above the camera
  CHECK(!landAround(outdoors(above, materials)));
  TestMesh ceiling;
  addFloor(ceiling, {-50, -50}, {50, 50}, 0, 0);
  for (size_t i = 0; i < ceiling.indices.size(); i += 3) std::swap(ceiling.indices[i], ceiling.indices[i + 1]);
  CHECK(!landAround(outdoors(ceiling, materials)));
}

TEST_CASE("some of a fair sky is clouds, soft ones, and a world with its own clouds has no others", "[render]") {
  const std::optional<Renderer> renderer = testRenderer();
  if (!renderer) return;
  const TestMesh none;
  const std::vector<RenderMaterial> rock{materialByName("rock")}, cloud{materialByName("cloud")};
  RenderScene fair = outdoors(none, rock), own = outdoors(none, cloud);
  int clouded = 0, all = 0;
  for (const glm::vec3 way : {glm::vec3(1, 0.35f, 0), glm::vec3(0, 0.35f, -1), glm::vec3(-0.7f, 0.35f, 0.7f)}) {
    fair.camera.target = fair.camera.position + way;
    own.camera.target = own.camera.position + way;
    const Result<Image> seen = renderer->render(fair), plain = renderer->render(own), again = renderer->render(fair);
    REQUIRE((seen && plain && again));
    CHECK(seen->rgba == again->rgba);
    for (int y = 1; y < 60; ++y) {
      for (int x = 1; x < 96; ++x) {
        clouded += whiteness(*seen, x, y) > whiteness(*plain, x, y) + 24;
        ++all;
        for (int c = 0; c < 3; ++c) {
          // With clouds, no pixel is darker than a thick cloud. Without clouds, neighbouring pixels differ little, as
          // in plain air.
          REQUIRE(channel(*seen, x, y, c) > 60);
          REQUIRE(std::abs(channel(*plain, x, y, c) - channel(*plain, x - 1, y, c)) < 14);
        }
      }
    }
  }
  CHECK(clouded > all / 50);
  CHECK(clouded < all * 6 / 10);
}

TEST_CASE("the end of the ground is hard to tell from the land behind it", "[render]") {
  const std::optional<Renderer> renderer = testRenderer();
  if (!renderer) return;
  const std::vector<RenderMaterial> materials{materialByName("sand")};
  TestMesh mesh;
  addFloor(mesh, {-50, -50}, {50, 50}, 0, 0);
  RenderScene scene = outdoors(mesh, materials);
  scene.fog_distance = 5000;
  const Result<Image> image = renderer->render(scene);
  REQUIRE(image);
  // The ground ends 90 m away, 1.3 degrees below the horizon, which is in the middle of the picture. The land continues
  // there.
  const double ground = brightness(*image, 48, 56, 6), land = brightness(*image, 48, 49, 1);
  CHECK(land == Approx(ground).epsilon(0.25));
  // The land does not have the colour of the sky.
  CHECK(channel(*image, 48, 49, 0) > channel(*image, 48, 49, 2));
}
