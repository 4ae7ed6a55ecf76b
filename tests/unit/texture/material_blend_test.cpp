// Tests blends of materials, and weights of triplanar mapping. A blend must choose the two most frequent materials,
// regardless of the order of the corners.

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "catch.h"
#include "rounds.h"
#include "seed.h"
#include "texture/material_blend.h"

using namespace sgm;

namespace {

/// A random mix of few materials, so that counts are often equal.
MaterialMix someMix(std::mt19937& random, uint32_t materials) {
  MaterialMix mix{};
  const auto kinds = static_cast<uint32_t>(1 + random() % materials);
  for (uint16_t& material : mix) material = static_cast<uint16_t>(7 * (random() % kinds));
  return mix;
}

}  // namespace

TEST_CASE("a triangle shows the two materials that it has most of, whatever the order of its corners") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t alone = 0, many = 0;
  for (unsigned round = 0; round < rounds(5000); ++round) {
    const auto materials = static_cast<uint32_t>(1 + random() % 5);
    std::array<MaterialMix, 3> corners;
    for (MaterialMix& corner : corners) corner = someMix(random, materials);
    const MaterialBlend blend = materialBlend(corners[0], corners[1], corners[2]);
    std::map<uint16_t, int> counts;
    for (const MaterialMix& corner : corners) {
      for (const uint16_t material : corner) ++counts[material];
    }
    REQUIRE(counts.count(blend.materials[0]) == 1);
    REQUIRE(counts.count(blend.materials[1]) == 1);
    if (counts.size() == 1) {
      ++alone;
      CHECK(blend == MaterialBlend{{corners[0][0], corners[0][0]}, {}});
      continue;
    }
    many += counts.size() > 2;
    REQUIRE(blend.materials[0] < blend.materials[1]);
    const int least = std::min(counts[blend.materials[0]], counts[blend.materials[1]]);
    for (const auto& [material, count] : counts) {
      if (material != blend.materials[0] && material != blend.materials[1]) CHECK(count <= least);
    }
    for (size_t i = 0; i < 3; ++i) {
      const auto low = std::count(corners[i].begin(), corners[i].end(), blend.materials[0]);
      const auto high = std::count(corners[i].begin(), corners[i].end(), blend.materials[1]);
      if (low + high == 0) continue;
      CHECK(blend.share[i] == Approx(255.0 * static_cast<double>(high) / static_cast<double>(low + high)).margin(0.5));
    }
    const MaterialBlend turned = materialBlend(corners[1], corners[2], corners[0]);
    CHECK(turned.materials == blend.materials);
    CHECK(turned.share == std::array<uint8_t, 3>{blend.share[1], blend.share[2], blend.share[0]});
  }
  CHECK(alone > 0);
  CHECK(many > 0);
}

TEST_CASE("planes share a place by the fourth powers of its normal, and leave nothing") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> part;
  for (unsigned round = 0; round < rounds(5000); ++round) {
    std::array<double, 3> normal{part(random), part(random), part(random)};
    if (round < 3) normal = {round == 0 ? 1.0 : 0.0, round == 1 ? -1.0 : 0.0, round == 2 ? 1.0 : 0.0};
    const std::array<uint8_t, 3> shares = planeShares(normal);
    CHECK(shares[0] + shares[1] + shares[2] == 255);
    double whole = 0;
    for (const double n : normal) whole += n * n * n * n;
    for (size_t axis = 0; axis < 3; ++axis) {
      CHECK(std::fabs(shares[axis] - 255 * std::pow(normal[axis], 4) / whole) < 3);
    }
  }
}
