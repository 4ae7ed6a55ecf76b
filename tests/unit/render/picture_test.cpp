#include <limits>

#include "scenes.h"

using namespace sgm;

#if defined(__SANITIZE_ADDRESS__)
// Switches the leak check off: Mesa's drivers leak a little memory for each instance. They are unloaded before the
// check, so suppressions cannot name them.
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
#endif

namespace {

struct Stage {
  TestMesh mesh;
  std::vector<RenderMaterial> materials{materialByName("limestone")};

  RenderScene scene(int width, int height) const {
    RenderScene s;
    s.vertices = mesh.vertices;
    s.indices = mesh.indices;
    s.materials = materials;
    s.camera.width = width;
    s.camera.height = height;
    return s;
  }
};

void requireNoMessages(const Renderer& renderer) {
  for (const std::string& message : renderer.messages()) {
    INFO(message);
    CHECK(message.empty());
  }
  REQUIRE(renderer.messages().empty());
}

}  // namespace

TEST_CASE("a sphere in the headlamp is lit in the middle and dark around", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const Stage stage{sphereMesh({0, 0, -6}, 2, false)};
  const RenderScene scene = stage.scene(160, 120);
  auto image = renderer->render(scene);
  REQUIRE(image);
  REQUIRE(image->rgba.size() == size_t{160} * 120 * 4);
  CHECK(brightness(*image, 80, 60, 12) > 60);
  CHECK(brightness(*image, 4, 4, 8) < 20);
  CHECK(brightness(*image, 155, 115, 8) < 20);
  for (size_t i = 3; i < image->rgba.size(); i += 4) REQUIRE(image->rgba[i] == 255);
  requireNoMessages(*renderer);
}

TEST_CASE("right is right and up is up", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const Stage stage{sphereMesh({2.2f, 1.6f, -6}, 0.8f, false)};
  auto image = renderer->render(stage.scene(160, 120));
  REQUIRE(image);
  CHECK(brightness(*image, 120, 30, 20) > 4 * brightness(*image, 40, 30, 20));
  CHECK(brightness(*image, 120, 30, 20) > 4 * brightness(*image, 120, 90, 20));
}

TEST_CASE("a void is seen from inside, and its walls' backs are open", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const Stage stage{sphereMesh({0, 0, 0}, 4, true)};
  auto inside = renderer->render(stage.scene(96, 96));
  REQUIRE(inside);
  CHECK(brightness(*inside, 48, 48, 20) > 60);
  RenderScene scene = stage.scene(96, 96);
  scene.camera.position = {0, 0, 9};
  scene.headlamp.reach = 20;
  auto outside = renderer->render(scene);
  REQUIRE(outside);
  // The far wall is visible, since the back of the near wall is not drawn.
  CHECK(brightness(*outside, 48, 48, 20) > 60);
}

TEST_CASE("relief that is too fine to be seen spreads highlights: what is far away is no mirror", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  // A dark wet ball 80 m away. One sample of the picture is as large as the relief, so the relief must act as
  // roughness.
  const auto highlight = [&](float relief) {
    Stage stage{sphereMesh({0, 0, -110}, 30, false, 48)};
    stage.materials = {{SurfacePattern::rock, glm::vec3(0.05f), 0.1f, relief}};
    RenderScene scene = stage.scene(64, 48);
    scene.headlamp.reach = 30;
    scene.fog_distance = 1e6f;
    scene.exposure = 0.5f;
    auto image = renderer->render(scene);
    REQUIRE(image);
    return brightness(*image, 32, 24, 3) / brightness(*image, 32, 24 + 5, 3);
  };
  const double mirror = highlight(0), rough = highlight(1);
  INFO("smooth " << mirror << ", rough " << rough);
  CHECK(mirror > 1.5 * rough);
  CHECK(rough < 2);
}

TEST_CASE("every pattern draws, under every background and supersampling, with no word from the validation layer",
          "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  constexpr std::array kNames{"limestone",     "granite",
                              "marble",        "calcite",
                              "brick",         "ashlar",
                              "rubble",        "paving",
                              "cobble",        "roof_tile",
                              "slate",         "plaster",
                              "concrete",      "wood",
                              "boards",        "metal",
                              "asphalt",       "glass",
                              "windscreen",    "shop_window",
                              "office_window", "curtained_window",
                              "blind_window",  "sand",
                              "gravel",        "grass",
                              "leaf",          "bark",
                              "moss",          "water",
                              "cloud",         "leaded",
                              "glow",          "joist",
                              "lava",          "nothing anyone has heard of"};
  Stage stage{sphereMesh({0, 0, -6}, 2, false)};
  // All materials are in one scene, so that the shaders are compiled only once for the device.
  stage.materials.clear();
  for (const char* name : kNames) stage.materials.push_back(materialByName(name));
  for (uint32_t i = 0; i < kNames.size(); ++i) {
    for (RenderVertex& vertex : stage.mesh.vertices) vertex.material = i;
    for (Background background : {Background::cave, Background::sky}) {
      RenderScene scene = stage.scene(65, 47);  // the sizes are odd, so that the last workgroup is only partly filled
      scene.background = background;
      scene.supersample = background == Background::sky ? 3 : 1;
      scene.lamps.assign(kMaxLamps, RenderLamp{{3, 3, -3}, {1, 1, 1}, 2});
      auto image = renderer->render(scene);
      INFO(kNames[i]);
      REQUIRE(image);
      const bool pane = stage.materials[i].pattern == SurfacePattern::glass;  // behind the pane, there is a dark room
      CHECK(brightness(*image, 32, 23, 8) > (pane ? 5 : 15));
    }
  }
  requireNoMessages(*renderer);
}

TEST_CASE("a room shows behind a pane of clear glass, and none behind a tinted one", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  // A scene without any light but that of the room behind the pane.
  const auto within = [&](const char* material) {
    Stage stage{sphereMesh({0, 0, -6}, 2, false)};
    stage.materials = {materialByName(material)};
    RenderScene scene = stage.scene(64, 48);
    scene.headlamp.colour = glm::vec3(0);
    scene.ambient = 0;
    auto image = renderer->render(scene);
    REQUIRE(image);
    return brightness(*image, 32, 24, 9);
  };
  CHECK(within("glass") > 10);
  CHECK(within("glass_black") < 3);
  CHECK(within("glass_green") < 3);
}

TEST_CASE("a window of stained glass shows the sky behind it, and is dark in a cave", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const auto seen = [&](const char* material, Background background) {
    Stage stage{sphereMesh({0, 0, -6}, 2, false)};
    stage.materials = {materialByName(material)};
    RenderScene scene = stage.scene(64, 48);
    scene.background = background;
    scene.sun_direction = {0, 1, -4};  // the sun is behind the window
    scene.headlamp.colour = glm::vec3(0);
    scene.ambient = 0;
    auto image = renderer->render(scene);
    REQUIRE(image);
    // The brightness is relative to that of the sky next to the window, because the exposure rises if the window is
    // dark.
    return brightness(*image, 32, 24, 9) / (background == Background::sky ? brightness(*image, 5, 40, 4) : 1);
  };
  const double pale = seen("leaded", Background::sky), dark = seen("leaded_black", Background::sky);
  INFO("pale " << pale << ", dark " << dark);
  CHECK(pale > 1.1 * dark);
  CHECK(seen("leaded", Background::cave) < 3);
}

TEST_CASE("the same scene gives the same bytes, wherever its origin lies", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const Stage stage{sphereMesh({0, 0, 0}, 4, true)};
  RenderScene scene = stage.scene(120, 80);
  auto first = renderer->render(scene);
  auto again = renderer->render(scene);
  REQUIRE((first && again));
  CHECK(first->rgba == again->rgba);
  // The coordinates are multiples of the periods of the materials' patterns.
  scene.origin = {1024 * 1024 * 1500, -1024 * 1024 * 900, 1024 * 1024};
  auto far_away = renderer->render(scene);
  REQUIRE(far_away);
  CHECK(first->rgba == far_away->rgba);
  scene.origin = {4096, 0, 0};
  auto elsewhere = renderer->render(scene);
  REQUIRE(elsewhere);
  CHECK(first->rgba != elsewhere->rgba);

  auto other = testRenderer();
  scene.origin = {};
  auto on_other = other->render(scene);
  REQUIRE(on_other);
  CHECK(first->rgba == on_other->rgba);
}

TEST_CASE("an empty mesh is a picture of nothing", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const Stage stage;
  auto image = renderer->render(stage.scene(32, 32));
  REQUIRE(image);
  CHECK(brightness(*image, 16, 16, 30) < 20);
  requireNoMessages(*renderer);
}

TEST_CASE("scenes that make no sense are refused", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  Stage stage{sphereMesh({0, 0, -6}, 2, false, 4)};
  const auto refused = [&](auto change) {
    RenderScene scene = stage.scene(32, 32);
    change(scene);
    auto image = renderer->render(scene);
    return !image && image.error().code == Code::invalid_argument && !image.error().message.empty();
  };
  CHECK(refused([](RenderScene& s) { s.camera.width = 0; }));
  CHECK(refused([](RenderScene& s) { s.camera.height = kMaxPicture + 1; }));
  CHECK(refused([](RenderScene& s) { s.camera.fov_degrees = 0; }));
  CHECK(refused([](RenderScene& s) { s.camera.target = s.camera.position; }));
  CHECK(refused([](RenderScene& s) { s.camera.position.x = std::numeric_limits<float>::quiet_NaN(); }));
  CHECK(refused([](RenderScene& s) { s.materials = {}; }));
  CHECK(refused([](RenderScene& s) { s.indices = s.indices.first(4); }));
  CHECK(refused([](RenderScene& s) { s.vertices = s.vertices.first(3); }));
  CHECK(refused([](RenderScene& s) { s.lamps.resize(kMaxLamps + 1); }));
  CHECK(refused([](RenderScene& s) { s.supersample = 4; }));
  CHECK(refused([](RenderScene& s) { s.fog_distance = 0; }));
  CHECK(refused([](RenderScene& s) { s.sun_direction = {0, 0, 0}; }));
  stage.mesh.vertices[0].position.y = std::numeric_limits<float>::infinity();
  CHECK(refused([](RenderScene&) {}));
}

TEST_CASE("a device that is not there is refused by number", "[render]") {
  if (!listGpus()) return;
  GpuOptions options;
  options.index = 1000;
  auto renderer = Renderer::create(options);
  REQUIRE(!renderer);
  CHECK(renderer.error().code == Code::unsupported);
  CHECK(renderer.error().message.find("1000") != std::string::npos);
}
