#include "tools/render/camera.h"

#include "scenes.h"

using namespace sgm;

TEST_CASE("inside a hollow the camera stands in it", "[render]") {
  const glm::vec3 centre{40, -7, 12};
  const TestMesh mesh = sphereMesh(centre, 9, true);
  auto view = chooseCamera(mesh.vertices, mesh.indices, {});
  REQUIRE(view);
  CHECK(view->enclosed);
  CHECK(glm::distance(view->camera.position, centre) < 8.5f);
  CHECK(view->depth > 4);
  for (const RenderLamp& lamp : view->lamps) CHECK(glm::distance(lamp.position, centre) < 9);

  auto again = chooseCamera(mesh.vertices, mesh.indices, {});
  REQUIRE(again);
  CHECK(view->camera.position == again->camera.position);
  CHECK(view->camera.target == again->camera.target);

  RenderScene scene;
  const std::vector<RenderMaterial> materials{materialByName("limestone")};
  scene.materials = materials;
  lightScene(*view, Light::lamp, scene);
  CHECK(scene.background == Background::cave);
  CHECK(scene.camera.position == view->camera.position);
}

TEST_CASE("of two hollows the one with the anchor is taken", "[render]") {
  TestMesh mesh = sphereMesh({0, 0, 0}, 12, true);
  const TestMesh small = sphereMesh({60, 0, 0}, 5, true);
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), small.vertices.begin(), small.vertices.end());
  for (uint32_t index : small.indices) mesh.indices.push_back(base + index);
  auto free_choice = chooseCamera(mesh.vertices, mesh.indices, {});
  REQUIRE(free_choice);
  CHECK(glm::distance(free_choice->camera.position, glm::vec3(0)) < 12);

  // Three anchors: one far outside, one in rock, and one in the small hollow.
  const std::vector<glm::vec3> anchors{{200, 0, 0}, {30, 0, 0}, {60, 0, 1}};
  CameraRequest request;
  request.anchors = anchors;
  auto anchored = chooseCamera(mesh.vertices, mesh.indices, request);
  REQUIRE(anchored);
  CHECK(anchored->enclosed);
  CHECK(glm::distance(anchored->camera.position, glm::vec3(60, 0, 0)) < 5);
}

TEST_CASE("a solid is framed whole from outside", "[render]") {
  const glm::vec3 centre{0, 100, 0};
  const TestMesh mesh = sphereMesh(centre, 30, false);
  for (bool airborne : {false, true}) {
    CameraRequest request;
    request.airborne = airborne;
    auto view = chooseCamera(mesh.vertices, mesh.indices, request);
    REQUIRE(view);
    CHECK(!view->enclosed);
    CHECK((view->camera.position.y < centre.y) == airborne);
    const float distance = glm::distance(view->camera.position, centre);
    const float half = 3.14159265f / 360 * view->camera.fov_degrees;
    CHECK(std::asin(30 / distance) < half);
    CHECK(std::asin(30 / distance) > 0.6f * half);
  }
}

TEST_CASE("a mesh without triangles has no view", "[render]") {
  auto view = chooseCamera({}, {}, {});
  REQUIRE(!view);
  CHECK(view.error().code == Code::invalid_argument);
}

TEST_CASE("a given camera's view is measured", "[render]") {
  const TestMesh mesh = sphereMesh({0, 0, 0}, 10, true);
  RenderCamera camera;
  camera.position = {0, 0, 0};
  camera.target = {1, 0, 0};
  const Result<View> found = viewFrom(mesh.vertices, mesh.indices, camera);
  REQUIRE(found);
  const View& view = *found;
  CHECK(view.enclosed);
  CHECK(view.depth == Approx(10).margin(0.3));
  const Result<View> nothing = viewFrom({}, {}, camera);
  REQUIRE(nothing);
  CHECK(!nothing->enclosed);
}

TEST_CASE("the light that is asked for is set, whatever the view", "[render]") {
  for (const bool enclosed : {false, true}) {
    View view;
    view.enclosed = enclosed;
    view.depth = 10;
    view.lamps.push_back({});
    for (const Light light : {Light::sun, Light::lamp, Light::none}) {
      RenderScene scene;
      lightScene(view, light, scene);
      CHECK((scene.background == Background::sky) == (light == Light::sun));
      CHECK(scene.lamps.size() == (light == Light::lamp ? 1 : 0));
      CHECK((glm::length(scene.headlamp.colour) > 0) == (light != Light::none));
    }
    // If the scene has no other lamp (alone), the headlamp reaches farther than beside another lamp (beside).
    RenderScene beside, alone;
    lightScene(view, Light::lamp, beside);
    view.lamps.clear();
    lightScene(view, Light::lamp, alone);
    CHECK(alone.headlamp.reach > 2 * beside.headlamp.reach);
  }
}

TEST_CASE("materials are known by name, and unknown names keep their tint", "[render]") {
  CHECK(materialByName("calcite").pattern == SurfacePattern::flow);
  CHECK(materialByName("cloud").pattern == SurfacePattern::cloud);
  CHECK(materialByName("unobtainium").colour == materialByName("unobtainium").colour);
  CHECK(materialByName("unobtainium").colour != materialByName("adamant").colour);
  CHECK(materialByName("").pattern == SurfacePattern::plain);
}
