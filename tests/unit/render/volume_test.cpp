// Tests pictures of fog against results in closed form.

#include "tools/render/volume.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "scenes.h"

using namespace sgm;

namespace {

/// A box of fog, with constant or varying density, and a camera in front of it that looks along -z.
struct Fog {
  std::vector<uint8_t> density;
  VolumeScene scene;

  template <class Density>
  Fog(glm::uvec3 size, float spacing, const Density& at) {
    scene.size = size;
    scene.spacing = spacing;
    for (uint32_t z = 0; z < size.z; ++z) {
      for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) density.push_back(at(glm::uvec3(x, y, z)));
      }
    }
    scene.density = density;
    const glm::vec3 end = glm::vec3(size - 1u) * spacing;
    scene.corner = glm::vec3(-0.5f * end.x, -0.5f * end.y, -end.z);
    scene.camera.position = {0, 0, 50};
    scene.camera.target = {0, 0, 0};
    scene.camera.fov_degrees = 40;
    scene.camera.width = 97;
    scene.camera.height = 71;
    scene.fog_distance = 1e30f;
    scene.supersample = 1;
  }

  glm::vec3 end() const { return scene.corner + glm::vec3(scene.size - 1u) * scene.spacing; }

  /// Length of a pixel's ray inside the box of fog.
  double crossed(int x, int y) const {
    const RenderCamera& camera = scene.camera;
    const double half = std::tan(0.5 * 3.14159265358979 / 180 * static_cast<double>(camera.fov_degrees));
    double d[3] = {((x + 0.5) / camera.width * 2 - 1) * half * camera.width / camera.height,
                   (1 - (y + 0.5) / camera.height * 2) * half, -1};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + 1);
    double first = 0, last = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] /= length;
      const double a = static_cast<double>(scene.corner[axis] - camera.position[axis]) / d[axis];
      const double b = static_cast<double>(end()[axis] - camera.position[axis]) / d[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return std::max(0.0, last - first);
  }

  const glm::vec4& at(const VolumePicture& picture, int x, int y) const {
    return picture.light[static_cast<size_t>(y * scene.camera.width + x)];
  }
};

VolumePicture drawn(const Renderer& renderer, const VolumeScene& scene) {
  auto picture = renderer.render(scene);
  INFO((picture ? std::string() : picture.error().message));
  REQUIRE(picture);
  for (const std::string& message : renderer.messages()) UNSCOPED_INFO(message);
  REQUIRE(renderer.messages().empty());
  return std::move(*picture);
}

/// The largest difference between the transmittance of a pixel and exp(-optical depth).
double error(const Fog& fog, const VolumePicture& picture, double extinction) {
  double worst = 0;
  for (int y = 0; y < fog.scene.camera.height; ++y) {
    for (int x = 0; x < fog.scene.camera.width; ++x) {
      const double expected = std::exp(-extinction * fog.crossed(x, y));
      worst = std::max(worst, std::fabs(double{fog.at(picture, x, y).w} - expected));
    }
  }
  return worst;
}

uint8_t full(glm::uvec3) { return 255; }

}  // namespace

TEST_CASE("a uniform box lets exp(-extinction * way) through, at every pixel", "[render][volume]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  for (const glm::uvec3 size : {glm::uvec3(2, 2, 2), glm::uvec3(9, 17, 33), glm::uvec3(30, 12, 7)}) {
    Fog fog(size, 1.3f, full);
    fog.scene.medium.extinction = 0.06f;
    CHECK(error(fog, drawn(*renderer, fog.scene), 0.06) < 1e-4);
    // Tests a camera inside the fog, too.
    fog.scene.camera.position = {0.1f, 0.1f, -0.3f};
    fog.scene.camera.target = {0.1f, 0.1f, -1.3f};
    CHECK(error(fog, drawn(*renderer, fog.scene), 0.06) < 1e-4);
  }
  Fog half({9, 9, 9}, 2, [](glm::uvec3) { return uint8_t{51}; });
  half.scene.medium.extinction = 0.1f;
  CHECK(error(half, drawn(*renderer, half.scene), 0.1 * 51 / 255) < 1e-4);
  Fog clear({40, 40, 40}, 1, [](glm::uvec3) { return uint8_t{0}; });
  const VolumePicture nothing = drawn(*renderer, clear.scene);
  for (const glm::vec4& light : nothing.light) REQUIRE((light == glm::vec4(0, 0, 0, 1)));
}

TEST_CASE("what lies far in a large volume counts, and the empty bricks before it do not", "[render][volume]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  // A slab across the middle of the box; on each side, its density falls linearly to 0 within a cell.
  Fog fog({60, 60, 90}, 1, [](glm::uvec3 p) { return p.z >= 41 && p.z <= 50 ? uint8_t{255} : uint8_t{0}; });
  fog.scene.medium.extinction = 0.05f;
  const VolumePicture picture = drawn(*renderer, fog.scene);
  CHECK(std::fabs(double{fog.at(picture, 48, 35).w} - std::exp(-0.05 * 10)) < 0.01);
  // A ray that passes beside the column of fog sees no fog.
  Fog column({60, 60, 60}, 1, [](glm::uvec3 p) { return p.x < 10 ? uint8_t{255} : uint8_t{0}; });
  const VolumePicture beside = drawn(*renderer, column.scene);
  CHECK(column.at(beside, 80, 35).w == 1.0f);
  CHECK(column.at(beside, 48 - 20, 35).w < 0.9f);
}

TEST_CASE("single scattering of a sun behind the eye is what its integral says", "[render][volume]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  Fog fog({33, 33, 17}, 2, full);
  fog.scene.medium = {0.04f, 0.7f, 0.3f, 1};
  fog.scene.sun_direction = {0, 0, 1};
  fog.scene.sun_light = {10, 5, 0};
  fog.scene.sky_light = fog.scene.ground_light = {0, 0, 0};
  const VolumePicture picture = drawn(*renderer, fog.scene);
  // Light enters along the ray and is scattered back along it, so it is attenuated in both directions.
  const double g = 0.3, phase = (1 - g * g) / (4 * 3.14159265 * std::pow(1 + g, 3));
  const double expected = 10 * 0.7 * phase * (1 - std::exp(-2 * 0.04 * 32)) / 2;
  // Each pixel samples its ray at different offsets; the mean of many pixels is exact.
  glm::dvec3 light(0);
  for (int y = 28; y < 43; ++y) {
    for (int x = 41; x < 56; ++x) light += glm::dvec3(fog.at(picture, x, y)) / (15.0 * 15.0);
  }
  CHECK(light.x == Approx(expected).epsilon(0.005));
  CHECK(light.y == Approx(expected / 2).epsilon(0.005));
  CHECK(light.z < 1e-6);
}

TEST_CASE("in light that comes from everywhere alike, fog that loses none of it is not seen", "[render][volume]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  Fog fog({30, 20, 25}, 1, [](glm::uvec3 p) { return static_cast<uint8_t>((p.x * 7 + p.y * 31 + p.z * 13) % 256); });
  fog.scene.sun_light = {0, 0, 0};
  fog.scene.sky_light = fog.scene.ground_light = {1, 1, 1};
  fog.scene.medium.extinction = 0.2f;
  const VolumePicture picture = drawn(*renderer, fog.scene);
  float least = 1;
  for (const glm::vec4& light : picture.light) {
    REQUIRE(light.x + light.w == Approx(1).margin(1e-3));
    least = std::min(least, light.w);
  }
  CHECK(least < 0.2f);
}

TEST_CASE("a ball of fog is bright towards the sun and dark below, the same each time", "[render][volume]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  Fog ball({41, 41, 41}, 1, [](glm::uvec3 p) {
    const float away = glm::distance(glm::vec3(p), glm::vec3(20));
    return static_cast<uint8_t>(255 * std::clamp((18 - away) / 6, 0.0f, 1.0f));
  });
  ball.scene.medium.extinction = 0.3f;
  ball.scene.sun_direction = {-1, 0.4f, 0.2f};
  const VolumePicture picture = drawn(*renderer, ball.scene);
  CHECK(ball.at(picture, 37, 35).x > 1.5f * ball.at(picture, 60, 35).x);
  CHECK(ball.at(picture, 48, 25).x > 1.2f * ball.at(picture, 48, 46).x);
  CHECK(brightness(picture.image, 37, 35, 6) > brightness(picture.image, 60, 35, 6) + 10);
  CHECK(ball.at(picture, 2, 2).w == 1.0f);
  ball.scene.supersample = 3;
  const VolumePicture fine = drawn(*renderer, ball.scene);
  CHECK(!(fine.light == picture.light));
  CHECK(ball.at(fine, 48, 35).x == Approx(ball.at(picture, 48, 35).x).epsilon(0.1));
  ball.scene.supersample = 1;
  const VolumePicture again = drawn(*renderer, ball.scene);
  CHECK(again.image.rgba == picture.image.rgba);
  CHECK((again.light == picture.light));
}

TEST_CASE("a volume that cannot be drawn is refused", "[render][volume]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  const Fog fog({3, 4, 5}, 1, full);
  const auto refused = [&](auto change) {
    VolumeScene scene = fog.scene;
    change(scene);
    auto picture = renderer->render(scene);
    return !picture && picture.error().code == Code::invalid_argument && !picture.error().message.empty();
  };
  const float infinite = std::numeric_limits<float>::infinity();
  CHECK(!refused([](VolumeScene&) {}));
  CHECK(refused([](VolumeScene& s) { s.camera.width = 0; }));
  CHECK(refused([](VolumeScene& s) { s.camera.target = s.camera.position; }));
  CHECK(refused([](VolumeScene& s) { s.medium.extinction = -1; }));
  CHECK(refused([&](VolumeScene& s) { s.medium.extinction = infinite; }));
  CHECK(refused([](VolumeScene& s) { s.medium.albedo = 1.5f; }));
  CHECK(refused([](VolumeScene& s) { s.medium.forward = 1; }));
  CHECK(refused([](VolumeScene& s) { s.medium.octaves = 0; }));
  CHECK(refused([](VolumeScene& s) { s.medium.octaves = 33; }));
  CHECK(refused([](VolumeScene& s) { s.spacing = 0; }));
  CHECK(refused([&](VolumeScene& s) { s.corner.y = infinite; }));
  CHECK(refused([](VolumeScene& s) { s.sun_direction = {0, 0, 0}; }));
  CHECK(refused([](VolumeScene& s) { s.fog_distance = 0; }));
  CHECK(refused([](VolumeScene& s) { s.supersample = 0; }));
  CHECK(refused([](VolumeScene& s) { s.supersample = 4; }));
  CHECK(refused([](VolumeScene& s) { s.size.x = 1; }));
  CHECK(refused([](VolumeScene& s) { s.size.x = 4; }));
  CHECK(refused([](VolumeScene& s) { s.density = s.density.first(59); }));
  VolumeScene wide = fog.scene;
  wide.size = {1u << 20, 2, 2};
  const auto picture = renderer->render(wide);
  REQUIRE(!picture);
  CHECK(picture.error().code == Code::limit);
}
