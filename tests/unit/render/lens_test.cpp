#include <cmath>
#include <glm/packing.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "catch.h"
#include "tools/render/lens.h"

using namespace sgm;

namespace {

ExposedPixel exposed(float film, float light) {
  const uint32_t filmed = glm::packHalf2x16(glm::vec2(film)), lit = glm::packHalf2x16(glm::vec2(light));
  return {filmed, glm::packHalf2x16({film, light}), lit};
}

/// Mean green value of a square of 5 x 5 pixels.
double greenAround(const Image& image, int x, int y) {
  double sum = 0;
  for (int row = y - 2; row <= y + 2; ++row)
    for (int column = x - 2; column <= x + 2; ++column)
      sum += image.rgba[4 * static_cast<size_t>(row * image.width + column) + 1];
  return sum / 25;
}

}  // namespace

TEST_CASE("what is far brighter than white glows, the less the farther away", "[render]") {
  constexpr int kWidth = 161, kHeight = 121;
  std::vector<ExposedPixel> pixels(kWidth * kHeight, exposed(0, 0));
  const Image dark = developed(pixels, kWidth, kHeight);
  CHECK(greenAround(dark, 80, 60) < 1);
  for (int y = 56; y < 65; ++y)
    for (int x = 76; x < 85; ++x) pixels[static_cast<size_t>(y * kWidth + x)] = exposed(1, 20);
  const Image bright = developed(pixels, kWidth, kHeight);
  CHECK(bright.width == kWidth);
  CHECK(bright.height == kHeight);
  REQUIRE(bright.rgba.size() == 4 * pixels.size());
  const double beside = greenAround(bright, 90, 60), away = greenAround(bright, 105, 60),
               far = greenAround(bright, 150, 60);
  CAPTURE(beside, away, far);
  CHECK(greenAround(bright, 80, 60) > 245);
  CHECK(beside > away + 5);
  CHECK(away > far + 2);
  CHECK(developed(pixels, kWidth, kHeight).rgba == bright.rgba);
}

TEST_CASE("even grey stays about as it is, with a fine grain", "[render]") {
  constexpr int kSide = 64;
  const std::vector<ExposedPixel> pixels(kSide * kSide, exposed(0.2f, 0.2f));
  const Image image = developed(pixels, kSide, kSide);
  double sum = 0, squares = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const double value = image.rgba[4 * i];
    sum += value;
    squares += value * value;
    CHECK(image.rgba[4 * i + 3] == 255);
  }
  const double mean = sum / static_cast<double>(pixels.size());
  const double spread = std::sqrt(squares / static_cast<double>(pixels.size()) - mean * mean);
  CAPTURE(mean, spread);
  CHECK(mean == Approx(124).margin(4));  // 0.2 in sRGB
  CHECK(spread > 0.5);
  CHECK(spread < 5);
}

TEST_CASE("a pixel that is not a number, or infinite, does not spread", "[render]") {
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
    CAPTURE(wrong);
    std::vector<ExposedPixel> pixels(33 * 17, exposed(0.2f, 0.2f));
    pixels[8 * 33 + 16] = exposed(wrong, wrong);
    const Image image = developed(pixels, 33, 17);
    CHECK(greenAround(image, 4, 4) == Approx(124).margin(12));
  }
}

TEST_CASE("pictures of one pixel, row or column are developed", "[render]") {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 1}, std::pair{1, 9}}) {
    const auto count = static_cast<size_t>(width * height);
    const Image image = developed(std::vector<ExposedPixel>(count, exposed(0.5f, 0.5f)), width, height);
    REQUIRE(image.rgba.size() == 4 * count);
    CHECK(image.rgba[0] > 150);
  }
}
