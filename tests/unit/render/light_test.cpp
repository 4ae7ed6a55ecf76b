// Tests the light that rays compute, in scenes whose light is known analytically.

#include <cstring>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/packing.hpp>
#include <random>

#include "scenes.h"
#include "tools/render/light_filter.h"

using namespace sgm;

namespace {

struct LitStage {
  TestMesh mesh;
  std::vector<RenderMaterial> materials;
  RenderScene scene;

  LitStage() { materials.push_back({SurfacePattern::plain, glm::vec3(0.5f), 0.9f, 0.0f}); }

  /// Adds a quadrangle a b c d, counter-clockwise as seen from the side that it faces.
  void add(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, uint32_t material = 0) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& corner : {a, b, c, d}) mesh.vertices.push_back({corner, n, material});
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  }

  void addFloor(float half, float y, uint32_t material = 0) {
    add({-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}, material);
  }

  void addSphere(glm::vec3 centre, float radius, bool hollow) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const TestMesh sphere = sphereMesh(centre, radius, hollow);
    mesh.vertices.insert(mesh.vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
    for (const uint32_t index : sphere.indices) mesh.indices.push_back(first + index);
  }

  void look(glm::vec3 from, glm::vec3 to) { scene.camera = {from, to, 60, 64, 48}; }

  LightPlanes traced(unsigned workers = 1) {
    scene.vertices = mesh.vertices;
    scene.indices = mesh.indices;
    scene.materials = materials;
    auto jobs = makeThreadPool(workers);
    REQUIRE(jobs);
    auto planes = traceLight(scene, frameOf(scene), **jobs);
    REQUIRE(planes);
    REQUIRE(planes->direct.size() == size_t{64} * 48);
    REQUIRE(planes->soft.size() == size_t{32} * 24);
    return std::move(*planes);
  }
};

#define FN inline
using glm::dot, glm::exp, glm::max, glm::mix, glm::pow, glm::smoothstep, glm::vec3;
#include "render/illumination.h"
#undef FN

/// The sky's mean radiance over the upper hemisphere, weighted by the cosine, integrated on a fine grid.
glm::vec3 skyMean(glm::vec3 to_sun) {
  constexpr int kRings = 400, kAround = 800;
  glm::dvec3 sum(0);
  for (int ring = 0; ring < kRings; ++ring) {
    const float u = (static_cast<float>(ring) + 0.5f) / kRings, r = std::sqrt(u), y = std::sqrt(1 - u);
    for (int i = 0; i < kAround; ++i) {
      const float angle = 6.28318531f * (static_cast<float>(i) + 0.5f) / kAround;
      sum += glm::dvec3(skyLight({r * std::cos(angle), y, r * std::sin(angle)}, to_sun));
    }
  }
  return glm::vec3(sum / static_cast<double>(kRings * kAround));
}

uint32_t openAt(const LightPlanes& planes, uint32_t x, uint32_t y, uint32_t light = 0) {
  return planes.direct[size_t{y} * planes.width + x].open[light / 4] >> (8 * (light % 4)) & 255u;
}
glm::vec3 softAt(const LightPlanes& planes, uint32_t x, uint32_t y) {
  return glm::vec3(planes.soft[size_t{y} / kSoftPixels * planes.soft_width + x / kSoftPixels].light);
}

}  // namespace

TEST_CASE("in even light a convex body is as bright as the light, and a cleft is darker", "[render]") {
  LitStage stage;
  stage.addSphere({0, 0, 0}, 1, false);
  stage.scene.ambient = 0.5f;
  stage.scene.headlamp.colour = glm::vec3(0);
  stage.look({0, 0, 5}, {0, 0, 0});
  const LightPlanes alone = stage.traced();
  CHECK(softAt(alone, 32, 24).g == Approx(0.5).margin(0.01));
  CHECK(alone.brightness == Approx(0.25).margin(0.01));

  LitStage cleft;
  cleft.add({-0.2f, -9, 0}, {-0.2f, -9, -9}, {-0.2f, 9, -9}, {-0.2f, 9, 0});
  cleft.add({0.2f, -9, -9}, {0.2f, -9, 0}, {0.2f, 9, 0}, {0.2f, 9, -9});
  cleft.add({-0.2f, -9, -3}, {0.2f, -9, -3}, {0.2f, 9, -3}, {-0.2f, 9, -3});
  cleft.scene.ambient = 0.5f;
  cleft.scene.headlamp.colour = glm::vec3(0);
  cleft.look({0, 0, 1}, {0, 0, -3});
  CHECK(softAt(cleft.traced(), 32, 24).g < 0.4f);
}

TEST_CASE("a floor in the open gets the sky's mean, and its own shadow nowhere", "[render]") {
  LitStage stage;
  stage.addFloor(500, 0);
  stage.materials.push_back({SurfacePattern::cloud});  // a world with clouds of its own gets no clouds in the sky
  stage.scene.background = Background::sky;
  stage.look({0, 4, 0}, {0, 0, -6});
  const LightPlanes planes = stage.traced();
  const glm::vec3 sky = softAt(planes, 32, 40), mean = skyMean(glm::normalize(stage.scene.sun_direction));
  for (int channel = 0; channel < 3; ++channel) CHECK(sky[channel] == Approx(mean[channel]).epsilon(0.06));
  for (uint32_t y = 26; y < 48; ++y)
    for (uint32_t x = 0; x < 64; ++x) REQUIRE(openAt(planes, x, y) == 255);
  for (uint32_t x = 0; x < 64; x += 9) {
    const float relative = softAt(planes, x, 44).g / sky.g;
    CHECK(relative == Approx(1).margin(0.12));
  }
}

TEST_CASE("a ball shades the ground behind it from the sun, softly at the rim", "[render]") {
  LitStage stage;
  stage.addFloor(50, 0);
  stage.addSphere({0, 3, 0}, 1, false);
  stage.scene.background = Background::sky;
  stage.scene.sun_direction = {0, 1, 0};
  stage.look({6, 7, 0}, {0, 0, 0});
  const LightPlanes planes = stage.traced();
  uint32_t dark = 0, bright = 0, between = 0;
  for (uint32_t x = 0; x < 64; ++x) {
    const uint32_t open = openAt(planes, x, 24);
    (open == 0 ? dark : open == 255 ? bright : between) += 1;
  }
  CHECK(openAt(planes, 32, 24) == 0);
  CHECK(dark > 2);
  CHECK(bright > 20);
  CHECK(between > 0);
  CHECK(between < 20);
}

TEST_CASE("what a lit wall sends back colours what stands beside it", "[render]") {
  const auto bounced = [](glm::vec3 colour) {
    LitStage stage;
    stage.materials = {{SurfacePattern::plain, glm::vec3(0.6f), 0.9f, 0.0f},
                       {SurfacePattern::plain, colour, 0.9f, 0.0f}};
    stage.addFloor(4, 0);
    stage.add({-2, 0, 4}, {-2, 0, -4}, {-2, 4, -4}, {-2, 4, 4}, 1);
    stage.scene.ambient = 0;
    stage.scene.headlamp.colour = glm::vec3(0);
    stage.scene.lamps = {{{0, 2, 0}, {1, 1, 1}, 3}};
    stage.look({0, 3, 0.1f}, {-1.5f, 0, 0});
    return softAt(stage.traced(), 32, 24);
  };
  const glm::vec3 red = bounced({0.8f, 0.1f, 0.1f}), grey = bounced(glm::vec3(0.4f));
  CHECK(red.r > 3 * red.b);
  CHECK(grey.r == Approx(grey.b).epsilon(0.01));
  CHECK(grey.r > 0.01f);
}

TEST_CASE("a lamp behind a wall does not reach, and the wall's back lets it through", "[render]") {
  LitStage stage;
  stage.addFloor(9, 0);
  // A slab between the lamp and the left half of the floor.
  stage.add({-4, 2, 4}, {0, 2, 4}, {0, 2, -4}, {-4, 2, -4});
  stage.add({-4, 1.9f, -4}, {0, 1.9f, -4}, {0, 1.9f, 4}, {-4, 1.9f, 4});
  stage.scene.lamps = {{{0, 5, 0}, {1, 1, 1}, 4}};
  stage.look({0, 1, 6}, {0, 0, 0});
  const LightPlanes planes = stage.traced();
  CHECK(openAt(planes, 10, 26, 1) == 0);
  CHECK(openAt(planes, 54, 26, 1) == 255);
}

TEST_CASE("water is the deeper the farther its shore, and what stands in it is wet at its foot", "[render]") {
  LitStage stage;
  stage.materials = {materialByName("limestone"), materialByName("water")};
  stage.addFloor(6, 0, 1);
  stage.add({-6, -1, -6}, {6, -1, -6}, {6, 5, -6}, {-6, 5, -6});
  stage.look({0, 3, 6}, {0, 0.5f, -6});
  const LightPlanes planes = stage.traced();
  // Returns the depth of the water at a row of the picture. If there is no water, returns minus the wetness of the
  // surface.
  const auto water = [&](uint32_t y) {
    const uint32_t bits = planes.direct[size_t{y} * planes.width + 32].mirror[1] >> 16;
    const int exponent = static_cast<int>(bits >> 10 & 31u);
    const float size = exponent == 0 ? 0.0f : std::ldexp(1 + static_cast<float>(bits & 1023u) / 1024, exponent - 15);
    return (bits & 0x8000u) != 0 ? -size : size;
  };
  uint32_t shore = 47;  // the last row of pixels, from the top, that shows the wall
  while (shore > 0 && planes.direct[size_t{shore} * 64 + 32].mirror[0] != 0) --shore;
  REQUIRE(shore > 4);
  REQUIRE(shore < 40);
  CHECK(water(shore + 2) > 0);
  CHECK(water(shore + 2) < water(shore + 8));
  CHECK(water(shore + 8) < 8);
  CHECK(water(shore) < -0.3f);
  CHECK(water(shore) >= -1);
  CHECK(water(0) == -2);
}

TEST_CASE("light is the same however many workers trace it", "[render]") {
  LitStage stage;
  stage.addSphere({0, 0, 0}, 4, true);
  stage.scene.lamps = {{{1, 1, 0}, {1, 0.8f, 0.6f}, 3}};
  stage.look({0, 0, 2}, {0, 0, -1});
  const LightPlanes one = stage.traced(1), four = stage.traced(4);
  CHECK(one.brightness == four.brightness);
  CHECK(std::memcmp(one.direct.data(), four.direct.data(), one.direct.size() * sizeof(DirectLight)) == 0);
  CHECK(std::memcmp(one.soft.data(), four.soft.data(), one.soft.size() * sizeof(SoftLight)) == 0);
}

TEST_CASE("the filter keeps even light, takes out noise, and stops at edges", "[render]") {
  constexpr uint32_t kSide = 64;
  auto jobs = makeThreadPool(1);
  REQUIRE(jobs);
  const unsigned seed = 7;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> noise(0, 2);
  Guides guides(kSide, kSide);
  std::vector<SoftLight> light(size_t{kSide} * kSide);
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      // Two walls that meet in a corner: the left one dark, the right one bright with noise.
      const bool left = x < kSide / 2;
      const float along = (static_cast<float>(x) - kSide / 2.0f) / kSide;
      const size_t at = size_t{y} * kSide + x;
      guides.set(at, {along, static_cast<float>(y) / kSide, left ? along : -along},
                 left ? glm::vec3(0.7071f, 0, -0.7071f) : glm::vec3(-0.7071f, 0, -0.7071f), 1);
      light[at].light = glm::vec4(left ? 0.25f : noise(random));
    }
  }
  filterSoft(light, guides, 1.0f / kSide, **jobs);
  double sum = 0, square = 0, dark = 0;
  for (uint32_t y = 16; y < 48; ++y) {
    for (uint32_t x = 40; x < 60; ++x) {
      const double value = static_cast<double>(light[size_t{y} * kSide + x].light.r);
      sum += value;
      square += value * value;
    }
    dark = std::max(dark, static_cast<double>(light[size_t{y} * kSide + 31].light.r));
  }
  const double mean = sum / 640, deviation = std::sqrt(square / 640 - mean * mean);
  CHECK(mean == Approx(1).margin(0.06));
  CHECK(deviation < 0.12);  // without filtering, the deviation would be 0.58
  CHECK(dark == Approx(0.25).margin(1e-4));
}

namespace {

/// A ball of cloud with a radius of 100 m, seen from a distance of 400 m with nothing behind it.
struct CloudStage : LitStage {
  explicit CloudStage(glm::vec3 to_sun) {
    materials = {materialByName("cloud")};
    addSphere({0, 0, 0}, 100, false);
    scene.background = Background::sky;
    scene.sun_direction = to_sun;
    look({0, 0, 400}, {0, 0, 0});
  }
};

/// Red, green and blue of the clouds in a pixel, and their transmittance.
glm::vec4 cloudAt(const LightPlanes& planes, uint32_t x, uint32_t y) {
  REQUIRE(planes.vapour.size() == planes.direct.size());
  const VapourLight& one = planes.vapour[size_t{y} * planes.width + x];
  const glm::vec2 first = glm::unpackHalf2x16(one.light[0]), last = glm::unpackHalf2x16(one.light[1]);
  return {first, last};
}

/// Mean luminance over the part of a picture's row that shows cloud.
float meanOfRow(const LightPlanes& planes, uint32_t y, uint32_t from, uint32_t to) {
  float sum = 0, weight = 0;
  for (uint32_t x = from; x < to; ++x) {
    const glm::vec4 seen = cloudAt(planes, x, y);
    sum += seen.g;
    weight += 1 - seen.w;
  }
  return sum / std::max(weight, 1e-6f);
}

}  // namespace

TEST_CASE("a cloud has a rim that light comes through, and a middle that none does", "[render]") {
  CloudStage stage({0, 1, 0});
  const LightPlanes planes = stage.traced();
  CHECK(cloudAt(planes, 32, 24).w == 0);
  CHECK(cloudAt(planes, 0, 0).w == 1);
  CHECK(cloudAt(planes, 0, 0).g == 0);
  size_t thin = 0;
  for (uint32_t y = 0; y < 48; ++y)
    for (uint32_t x = 0; x < 64; ++x) thin += cloudAt(planes, x, y).w > 0.02f && cloudAt(planes, x, y).w < 0.98f;
  CHECK(thin > 20);
  CHECK(thin < 400);
  // Clouds do not count for the mean brightness, because they are no surfaces.
  CHECK(planes.brightness == 0);
}

TEST_CASE("a cloud is brighter on the side of the sun, and its base is grey", "[render]") {
  CloudStage stage({-1, 0.05f, 0});
  const LightPlanes side = stage.traced();
  CHECK(meanOfRow(side, 24, 18, 28) > 1.5f * meanOfRow(side, 24, 36, 46));
  stage.scene.sun_direction = {0, 1, 0};
  const LightPlanes noon = stage.traced();
  CHECK(meanOfRow(noon, 13, 24, 40) > 2 * meanOfRow(noon, 35, 24, 40));
}

TEST_CASE("a cloud's rim shines where the sun stands behind it", "[render]") {
  const auto rim = [](glm::vec3 to_sun) {
    CloudStage stage(to_sun);
    const LightPlanes planes = stage.traced();
    float sum = 0, weight = 0;
    for (uint32_t y = 0; y < 48; ++y) {
      for (uint32_t x = 0; x < 64; ++x) {
        const glm::vec4 seen = cloudAt(planes, x, y);
        if (seen.w > 0.5f && seen.w < 0.97f) sum += seen.g, weight += 1 - seen.w;
      }
    }
    return sum / weight;
  };
  CHECK(rim({0, 0.2f, -1}) > 2 * rim({1, 0.2f, 0}));
}

TEST_CASE("a cloud sends no more light than it gets", "[render]") {
  // Renders the ball of cloud from twelve directions, and compares the light that leaves it with the light from sun and
  // sky that falls on it.
  double sum = 0, sky = 0;
  constexpr int kSides = 12;
  const glm::vec3 to_sun = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
  for (int i = 0; i < kSides; ++i) {
    CloudStage stage(to_sun);
    const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / kSides, r = std::sqrt(1 - y * y);
    const float angle = 2.39996323f * static_cast<float>(i);
    stage.look(400.0f * glm::vec3(r * std::cos(angle), y, r * std::sin(angle)), {0, 0, 0});
    const LightPlanes planes = stage.traced();
    double seen = 0;
    for (uint32_t v = 0; v < 48; ++v)
      for (uint32_t u = 0; u < 64; ++u) seen += static_cast<double>(cloudAt(planes, u, v).g);
    // Converts pixels to square metres across the view at the ball's distance.
    const double pixel = 2 * std::tan(0.5235988) * 400 / 48;
    sum += seen * pixel * pixel / kSides;
    sky += static_cast<double>(skyLight(glm::normalize(stage.scene.camera.position), to_sun).g) / kSides;
  }
  const double disc = 3.14159265 * 100 * 100;
  // leaves: light that leaves the ball in all directions. comes: light that arrives, which is pi times sunLight() on
  // the ball's disc from the sun, and the sky's mean radiance times 4 pi from the sky.
  const double leaves = sum * 4 * 3.14159265,
               comes = disc * (3.14159265 * static_cast<double>(sunLight().g)) + disc * sky * 4 * 3.14159265;
  INFO(leaves / comes);
  CHECK(leaves < comes);
  CHECK(leaves > 0.4 * comes);
}

TEST_CASE("clouds shade the ground, hide what is behind them, and are the same however many workers light them",
          "[render]") {
  CloudStage stage({0, 1, 0});
  stage.materials.push_back({SurfacePattern::plain, glm::vec3(0.5f), 0.9f, 0.0f});
  stage.addFloor(2000, -150, 1);
  stage.look({0, 300, 500}, {0, -60, 0});
  const LightPlanes one = stage.traced(1), four = stage.traced(4);
  CHECK(std::memcmp(one.vapour.data(), four.vapour.data(), one.vapour.size() * sizeof(VapourLight)) == 0);
  CHECK(std::memcmp(one.direct.data(), four.direct.data(), one.direct.size() * sizeof(DirectLight)) == 0);
  uint32_t darkest = 255, brightest = 0;
  for (uint32_t y = 0; y < 48; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      if (cloudAt(one, x, y).w < 1 || openAt(one, x, y) == 0) continue;
      darkest = std::min(darkest, openAt(one, x, y));
      brightest = std::max(brightest, openAt(one, x, y));
    }
  }
  CHECK(brightest == 255);
  CHECK(darkest < 80);
  // Adds a wall in front of the cloud, which the wall must hide.
  const auto before = cloudAt(one, 32, 24).w;
  stage.add({-300, -300, 200}, {300, -300, 200}, {300, 300, 200}, {-300, 300, 200}, 1);
  stage.look({0, 0, 500}, {0, 0, 0});
  CHECK(before == 0);
  CHECK(cloudAt(stage.traced(), 32, 24).w == 1);
}

TEST_CASE("a cloud that is drawn with texture coordinates, or by lamps, has a surface", "[render]") {
  CloudStage stage({0, 1, 0});
  stage.scene.background = Background::cave;
  CHECK(stage.traced().vapour.empty());
  stage.scene.background = Background::sky;
  for (size_t i = 0; i < stage.mesh.vertices.size(); ++i) stage.mesh.vertices[i].texture = glm::vec2(float(i), 1);
  const LightPlanes planes = stage.traced();
  CHECK(planes.vapour.empty());
  CHECK(planes.brightness > 0);
}

TEST_CASE("materials are found by name, tint and wetness", "[render]") {
  const auto ochre = findMaterial("plaster_ochre"), plaster = findMaterial("plaster");
  REQUIRE((ochre && plaster));
  CHECK(ochre->pattern == plaster->pattern);
  CHECK(ochre->colour.b < 0.6f * plaster->colour.b);
  const auto wet = findMaterial("wet_limestone"), dry = findMaterial("limestone");
  REQUIRE((wet && dry));
  CHECK(wet->pattern == dry->pattern);
  CHECK(wet->roughness < 0.5f * dry->roughness);
  CHECK(wet->colour.g < 0.7f * dry->colour.g);
  CHECK(findMaterial("wet_roof_tile_red"));
  // Even the smoothest material is rough enough for the shaders, which divide by the roughness.
  for (const char* smooth : {"wet_water", "wet_glass", "wet_ice", "wet_wet_wet_limestone"}) {
    INFO(smooth);
    REQUIRE(findMaterial(smooth));
    CHECK(findMaterial(smooth)->roughness >= 0.05f);
  }
  CHECK(findMaterial("wet_wet_limestone")->colour == wet->colour);
  std::string long_name;
  for (int i = 0; i < 1'000'000; ++i) long_name += "wet_";
  CHECK(findMaterial(long_name + "limestone"));
  CHECK(!findMaterial(long_name + "plastic"));
  for (const char* unknown : {"", "plastic", "plaster_", "plaster_mauve", "_ochre", "wet_", "wet_plastic"}) {
    INFO(unknown);
    CHECK(!findMaterial(unknown));
  }
}

TEST_CASE("a name that is not known looks as a word of it that is", "[render]") {
  CHECK(!findMaterial("old_brick_wall"));
  CHECK(materialByName("old_brick_wall").pattern == SurfacePattern::brick);
  CHECK(materialByName("old_brick_wall").colour == materialByName("brick").colour);
  CHECK(materialByName("main_road").colour == materialByName("asphalt").colour);
  CHECK(materialByName("wall_ochre").colour == materialByName("plaster_ochre").colour);
  CHECK(materialByName("old_wet_road").colour == materialByName("wet_asphalt").colour);
  // A word that names a material ("brick") has priority over words that only imply a material, wherever it stands.
  CHECK(materialByName("wall_brick").pattern == SurfacePattern::brick);
  CHECK(materialByName("roof_slate").pattern == SurfacePattern::slates);
  CHECK(materialByName("floor_wood").pattern == SurfacePattern::wooden);
  CHECK(materialByName("old_roof_tile").pattern == SurfacePattern::roof_tiles);
  CHECK(materialByName("road_wall").pattern == SurfacePattern::asphalt);
  // A word inside a longer word does not count.
  CHECK(materialByName("roadster").pattern == SurfacePattern::rock);
}
