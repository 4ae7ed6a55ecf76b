// Tests the sketch of a scene, a preview picture that is drawn in a fraction of a second.

#include "tools/render/sketch.h"

#include <atomic>

#include "scenes.h"

using namespace sgm;

namespace {

RenderScene sceneOf(const TestMesh& mesh, std::span<const RenderMaterial> materials, Background background) {
  RenderScene scene;
  scene.vertices = mesh.vertices;
  scene.indices = mesh.indices;
  scene.materials = materials;
  scene.background = background;
  scene.camera.position = {0, 0, background == Background::sky ? 6.0f : 0.0f};
  scene.camera.target = {0, 0, -1};
  scene.camera.width = 160;
  scene.camera.height = 90;
  return scene;
}

Result<Image> sketched(const RenderScene& scene, unsigned threads) {
  const Result<RayCaster> tree = RayCaster::over(scene.vertices, scene.indices);
  REQUIRE(tree);
  return sketch(scene, *tree, **makeThreadPool(threads));
}

}  // namespace

TEST_CASE("a sketch is lit by the sun, and has a sky", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("marble")};
  const TestMesh ball = sphereMesh({0, 0, 0}, 2, false);
  const Result<Image> image = sketched(sceneOf(ball, materials, Background::sky), 2);
  REQUIRE(image);
  // The light comes from the upper left.
  CHECK(brightness(*image, 70, 35, 5) > 1.3 * brightness(*image, 92, 56, 5));
  CHECK(brightness(*image, 92, 56, 5) > 15);
  const auto pixel = [&](int x, int y) { return &image->rgba[static_cast<size_t>(4 * (y * image->width + x))]; };
  CHECK(pixel(4, 4)[2] > pixel(4, 4)[0] + 20);
  CHECK(pixel(4, 4)[3] == 255);
}

TEST_CASE("a sketch of a hollow is lit by the head lamp, and by what is near", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("limestone")};
  const TestMesh hollow = sphereMesh({0, 0, 0}, 5, true);
  const Result<Image> image = sketched(sceneOf(hollow, materials, Background::cave), 2);
  REQUIRE(image);
  CHECK(brightness(*image, 80, 45, 9) > 40);
  CHECK(brightness(*image, 80, 45, 9) > brightness(*image, 3, 45, 5));
}

TEST_CASE("a sketch is as bright as the picture that follows it", "[render]") {
  const std::optional<Renderer> renderer = testRenderer();
  if (!renderer) return;
  for (const Background background : {Background::sky, Background::cave}) {
    CAPTURE(static_cast<int>(background));
    const std::vector<RenderMaterial> materials{materialByName("limestone")};
    const bool inside = background == Background::cave;
    const TestMesh mesh = sphereMesh({0, 0, 0}, inside ? 5.0f : 2.0f, inside);
    const RenderScene scene = sceneOf(mesh, materials, background);
    const Result<Image> quick = sketched(scene, 2), whole = renderer->render(scene);
    REQUIRE(quick);
    REQUIRE(whole);
    const double one = brightness(*quick, 80, 45, 41), other = brightness(*whole, 80, 45, 41);
    CAPTURE(one, other);
    CHECK(one < 1.5 * other);
    CHECK(other < 1.5 * one);
  }
}

TEST_CASE("a sketch has the same bytes whatever the threads", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("brick")};
  const TestMesh ball = sphereMesh({0, 0, 0}, 2, false);
  const RenderScene scene = sceneOf(ball, materials, Background::sky);
  const Result<Image> one = sketched(scene, 1), several = sketched(scene, 4);
  REQUIRE(one);
  REQUIRE(several);
  CHECK(one->rgba == several->rgba);
}

TEST_CASE("a scene that cannot be sketched is refused", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("brick")};
  const TestMesh ball = sphereMesh({0, 0, 0}, 2, false);
  RenderScene scene = sceneOf(ball, {}, Background::sky);
  CHECK(sketched(scene, 1).error().code == Code::invalid_argument);
  scene = sceneOf(ball, materials, Background::sky);
  scene.camera.width = 0;
  CHECK(sketched(scene, 1).error().code == Code::invalid_argument);
  scene = sceneOf(ball, materials, Background::sky);
  scene.lamps.resize(kMaxLamps + 1);
  CHECK(sketched(scene, 1).error().code == Code::invalid_argument);
}

TEST_CASE("a picture that is not wanted any more ends", "[render]") {
  const std::optional<Renderer> renderer = testRenderer();
  if (!renderer) return;
  const std::vector<RenderMaterial> materials{materialByName("brick")};
  const TestMesh ball = sphereMesh({0, 0, 0}, 2, false);
  RenderScene scene = sceneOf(ball, materials, Background::sky);
  std::atomic<int> asked = 0;
  scene.go_on = [&] { return ++asked < 5; };
  const Result<Image> image = renderer->render(scene);
  REQUIRE_FALSE(image);
  CHECK(image.error().code == Code::cancelled);
  CHECK(asked < 40);
}
