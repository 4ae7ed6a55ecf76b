// Tests blades of lawns and leaves of crowns.

#include "tools/render/foliage.h"

#include <algorithm>

#include "scenes.h"
#include "tools/render/light_planes.h"

using namespace sgm;

namespace {

constexpr int kSide = 240;
/// A cloud material: if a world has clouds of its own, no other clouds are drawn in the sky.
constexpr RenderMaterial kPlainSky{SurfacePattern::cloud};

/// A scene with a ball of 2 m radius that is entirely visible.
RenderScene ballScene(const TestMesh& ball, std::span<const RenderMaterial> materials) {
  RenderScene scene;
  scene.vertices = ball.vertices;
  scene.indices = ball.indices;
  scene.materials = materials;
  scene.background = Background::sky;
  scene.camera.position = {0, 0, 8};
  scene.camera.target = {0, 0, 0};
  scene.camera.fov_degrees = 45;
  scene.camera.width = scene.camera.height = kSide;
  return scene;
}

/// Whether a pixel shows a body. Bluish pixels show the sky, or a body that only the sky lights, and do not count.
bool isBody(const Image& image, int x, int y) {
  const uint8_t* pixel = &image.rgba[static_cast<size_t>(4 * (y * image.width + x))];
  return pixel[2] + 4 < std::max(pixel[0], pixel[1]);
}

/// Numbers of pixels for which isBody() is true, by their distance from the middle of the picture, in radii of the
/// ball's outline: inside (below 0.97), near (1.03 to 1.17) and far. inside_all: number of all pixels inside.
struct Seen {
  int inside = 0, inside_all = 0, near = 0, far = 0;
  /// For the middle (below 0.6 radii) and the rim (up to the outline): the number of all pixels, and of those through
  /// which the background is visible (gaps).
  int middle_gaps = 0, middle = 0, rim_gaps = 0, rim = 0;
};

Seen seenOf(const Image& image) {
  const double outline = std::tan(std::asin(2.0 / 8.0)) / std::tan(45 * 3.14159265 / 360) * kSide / 2;
  Seen seen;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double from_middle = std::hypot(x + 0.5 - kSide / 2.0, y + 0.5 - kSide / 2.0) / outline;
      if (from_middle < 0.97) {
        ++seen.inside_all;
        seen.inside += isBody(image, x, y);
        (from_middle < 0.6 ? seen.middle : seen.rim) += 1;
        (from_middle < 0.6 ? seen.middle_gaps : seen.rim_gaps) += !isBody(image, x, y);
      } else if (from_middle > 1.03) {
        (from_middle < 1.17 ? seen.near : seen.far) += isBody(image, x, y);
      }
    }
  }
  return seen;
}

}  // namespace

TEST_CASE("leaves stand out from a crown, and no farther than they reach", "[render]") {
  const std::optional<Renderer> renderer = testRenderer();
  if (!renderer) return;
  const TestMesh ball = sphereMesh({0, 0, 0}, 2, false);
  const std::vector<RenderMaterial> leaf{materialByName("leaf"), kPlainSky}, brick{materialByName("brick"), kPlainSky};
  const Result<Image> crown = renderer->render(ballScene(ball, leaf));
  // The sun is behind the camera, because isBody() does not detect surfaces that only the sky lights.
  RenderScene lit = ballScene(ball, brick);
  lit.sun_direction = {0, 0.3f, 1};
  const Result<Image> bare = renderer->render(lit);
  REQUIRE(crown);
  REQUIRE(bare);
  const Seen leaves = seenOf(*crown), bricks = seenOf(*bare);
  CHECK(leaves.inside > 0.6 * leaves.inside_all);
  // The sky is more often visible through the rim of the crown than through its middle.
  CHECK(leaves.rim_gaps * leaves.middle > leaves.middle_gaps * leaves.rim);
  CHECK(leaves.middle_gaps < 0.25 * leaves.middle);
  CHECK(bricks.inside > 0.99 * bricks.inside_all);
  CHECK(leaves.near > 300);
  CHECK(bricks.near == 0);
  CHECK(leaves.far == 0);
  CHECK(bricks.far == 0);
  // The outermost leaves have no surface of the crown behind them. They must be lit all the same.
  double sum = 0, count = 0;
  for (int y = 0; y < kSide / 4; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (!isBody(*crown, x, y)) continue;
      sum += crown->rgba[static_cast<size_t>(4 * (y * kSide + x) + 1)];
      ++count;
    }
  }
  REQUIRE(count > 20);
  CHECK(sum / count > 40);
}

TEST_CASE("leaves are in the same places each time", "[render]") {
  const std::optional<Renderer> renderer = testRenderer();
  if (!renderer) return;
  const TestMesh ball = sphereMesh({0, 0, 0}, 2, false);
  const std::vector<RenderMaterial> leaf{materialByName("leaf")};
  const Result<Image> one = renderer->render(ballScene(ball, leaf)), other = renderer->render(ballScene(ball, leaf));
  REQUIRE(one);
  REQUIRE(other);
  CHECK(one->rgba == other->rgba);
}

TEST_CASE("blades and leaves grow where their material is, and near the camera", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("brick"),
                                              materialByName("grass"),
                                              materialByName("leaf"),
                                              {SurfacePattern::leafy, {0.1f, 0.2f, 0.1f}, 0.6f, 0.0f}};
  TestMesh mesh;
  const auto triangle = [&](uint32_t material, uint32_t second, float z, glm::vec2 texture = {0, 0}) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (int i = 0; i < 3; ++i)
      mesh.vertices.push_back({{static_cast<float>(i), 0, z}, {0, 1, 0}, material, second, 0.5f, texture});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
  };
  triangle(0, 0, 0);
  triangle(1, 1, 0);
  triangle(0, 1, 0);
  triangle(1, 2, 0);
  triangle(2, 2, -1000);            // too far from the camera for leaves
  triangle(3, 3, 0);                // a material without relief
  triangle(2, 2, 0, {0.5f, 0.5f});  // drawn in the checkerboard pattern
  const RenderScene scene = ballScene(mesh, materials);
  const Foliage foliage = foliageOf(scene, frameOf(scene));
  REQUIRE(foliage.ground.size() == 9);
  CHECK(foliage.ground[0].texture.x == 3);
  CHECK(foliage.ground[3].texture.x == 2);
  CHECK(foliage.ground[6].texture.x == 1);
  for (const RenderVertex& vertex : foliage.ground) {
    CHECK(vertex.texture.y >= 0.25f);
    CHECK(vertex.texture.y <= 1);
  }
}

TEST_CASE("blades stand on lawns and leaves on crowns, within the picture", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("brick"), materialByName("grass"), materialByName("leaf")};
  TestMesh mesh;
  const auto addTriangle = [&](uint32_t material, glm::vec3 place) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (const glm::vec3 corner : {glm::vec3(0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)})
      mesh.vertices.push_back({place + corner, {0, 1, 0}, material, material});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
  };
  addTriangle(0, {0, 0, 0});
  addTriangle(1, {-2, 0, 0});
  addTriangle(2, {2, 0, 0});
  addTriangle(1, {0, 0, 30});  // the triangle lies behind the camera
  const RenderScene scene = ballScene(mesh, materials);
  const Foliage foliage = foliageOf(scene, frameOf(scene));
  size_t blades = 0, leaves = 0;
  for (const Sprout& sprout : foliage.sprouts) {
    const bool leaf = sprout.form == SproutForm::leaf;
    ++(leaf ? leaves : blades);
    CHECK(sprout.material == (leaf ? 2 : 1));
    CHECK(sprout.root.z <= 1);
    CHECK((leaf ? sprout.root.x >= 2 : sprout.root.x <= -1));
    CHECK((leaf || sprout.root.y < 0.6f));
  }
  CHECK(blades > 100);
  CHECK(leaves > 10);
}

TEST_CASE("of near crowns the leaves alone are drawn, of all else its surface", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("leaf"), materialByName("bark")};
  TestMesh mesh;
  const auto triangle = [&](uint32_t material, uint32_t second, float share, float z) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (int i = 0; i < 3; ++i)
      mesh.vertices.push_back({{static_cast<float>(i), 0, z}, {0, 1, 0}, material, second, share});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
  };
  triangle(0, 0, 0, 0);
  triangle(0, 1, 0, 0);      // the second material has a share of 0
  triangle(0, 1, 0.4f, 0);   // a blend from leaves to bark
  triangle(1, 1, 0, 0);      // bark
  triangle(0, 0, 0, -1000);  // too far away for leaves
  const RenderScene scene = ballScene(mesh, materials);
  const std::vector<uint32_t> drawn = withoutCrowns(scene, frameOf(scene), scene.indices);
  CHECK(drawn == std::vector<uint32_t>{6, 7, 8, 9, 10, 11, 12, 13, 14});
}

TEST_CASE("rays of the eye pass gaps of those triangles alone whose surface is not drawn", "[render]") {
  const std::vector<RenderMaterial> materials{materialByName("leaf"), materialByName("bark"), materialByName("glass")};
  // A sheet of leaves stands in front of a pane of glass. Only the pane reflects, so a pixel with a reflection shows a
  // ray that passed through the sheet.
  const auto seen = [&](uint32_t second, float share, glm::vec2 texture) {
    TestMesh mesh;
    const auto addSquare = [&](float half, float z, RenderVertex like) {
      const auto first = static_cast<uint32_t>(mesh.vertices.size());
      for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        like.position = glm::vec3(half * corner, z);
        mesh.vertices.push_back(like);
      }
      for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
    };
    addSquare(9, 0, {{}, {0, 0, 1}, 0, second, share, texture});
    addSquare(90, -5, {{}, {0, 0, 1}, 2, 2});
    const RenderScene scene = ballScene(mesh, materials);
    const Result<LightPlanes> planes = traceLight(scene, frameOf(scene), **makeThreadPool(1));
    REQUIRE(planes);
    return std::ranges::count_if(planes->direct, [](const DirectLight& one) { return one.mirror[0] != 0; });
  };
  CHECK(seen(0, 0, {0, 0}) > 100);
  CHECK(seen(0, 0.4f, {0, 0}) == seen(0, 0, {0, 0}));
  CHECK(seen(1, 0, {0, 0}) == seen(0, 0, {0, 0}));  // the second material has a share of 0
  CHECK(seen(1, 0.4f, {0, 0}) == 0);
  CHECK(seen(0, 0, {0.5f, 0.5f}) == 0);
}
