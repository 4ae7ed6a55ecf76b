// Tests pictures of drawn chunks: the visible surfaces, in the right place and in the requested colours.

#include "tools/flight/flight_picture.h"

#include <array>

#include "drawn_world.h"
#include "scenes.h"

using namespace sgm;
using cli::FlightPlace;
using cli::PicturedChunk;
using cli::PictureRequest;

#if defined(__SANITIZE_ADDRESS__)
// Switches the leak check off: Mesa's drivers leak a little memory for each instance. They are unloaded before the
// check, so suppressions cannot name them.
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
#endif

namespace {

std::vector<PicturedChunk> pictured(MeshedWorld& world, const Octree& tree) {
  const Drawing drawing = drawingOf(tree);
  world.want(drawing);
  std::vector<PicturedChunk> chunks;
  for (const auto& [key, parts] : drawing) chunks.push_back({world.view(key), parts.seams});
  return chunks;
}

std::array<int, 3> pixelAt(const Image& image, int x, int y) {
  const uint8_t* p =
      image.rgba.data() + 4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
  return {p[0], p[1], p[2]};
}

Image plain(int width, int height, uint8_t grey) {
  Image image{width, height, {}};
  image.rgba.assign(size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height), grey);
  return image;
}

}  // namespace

TEST_CASE("a contact sheet shows every picture in its place") {
  const std::vector<Image> images{plain(10, 6, 50), plain(10, 6, 100), plain(4, 6, 150)};
  const Image sheet = cli::contactSheet(images, 2);
  CHECK(sheet.width == 3 * 8 + 2 * 10);
  CHECK(sheet.height == 3 * 8 + 2 * 6);
  CHECK(sheet.rgba.size() == size_t{4} * 44 * 36);
  CHECK(pixelAt(sheet, 8, 8) == std::array{50, 50, 50});
  CHECK(pixelAt(sheet, 17, 13) == std::array{50, 50, 50});
  CHECK(pixelAt(sheet, 26, 8) == std::array{100, 100, 100});
  CHECK(pixelAt(sheet, 8, 22) == std::array{150, 150, 150});
  CHECK(pixelAt(sheet, 12, 22) != std::array{150, 150, 150});
  CHECK(pixelAt(sheet, 7, 7) == pixelAt(sheet, 30, 30));
  CHECK(cli::contactSheet(std::span(images).first(1), 5).width == 26);
  CHECK(cli::contactSheet({}, 3).rgba.empty());
}

TEST_CASE("a picture shows the chunks that are drawn, each level in its colour", "[render]") {
  auto renderer = testRenderer();
  if (!renderer) return;
  MeshedWorld world(kClosedWorlds[0]);
  Octree coarse(kTop, kFinestCell);
  for (int corner = 0; corner < 8; ++corner)
    coarse.split({kTop + 1, {-(corner & 1), -(corner >> 1 & 1), -(corner >> 2)}});
  PictureRequest request;
  request.camera.position = {4, -3, 70};
  request.width = 160;
  request.height = 120;
  request.levels = true;
  const auto draw = [&](std::span<const PicturedChunk> chunks) {
    auto image = cli::drawChunks(*renderer, world.grammar(), chunks, request);
    INFO((image ? "" : image.error().message));
    REQUIRE(image);
    return std::move(*image);
  };
  const Image rock = draw(pictured(world, coarse));
  // The picture shows a ball of 30 m, 65 m away, in the colour of the coarsest level: red is largest, blue is smallest.
  const std::array<int, 3> middle = pixelAt(rock, 80, 60);
  CHECK(middle[0] > middle[1]);
  CHECK(middle[1] > middle[2] + 20);
  CHECK(brightness(rock, 80, 60, 20) > 40);
  CHECK(brightness(rock, 4, 4, 6) < 10);
  const Image nothing = draw({});
  CHECK(brightness(nothing, 80, 60, 20) < 10);

  Octree fine = coarse;
  for (int corner = 0; corner < 8; ++corner) fine.split({kTop, {-(corner & 1), -(corner >> 1 & 1), -(corner >> 2)}});
  refineToRules(fine);
  const std::array<int, 3> blue = pixelAt(draw(pictured(world, fine)), 80, 60);
  CHECK(blue[2] > blue[1]);
  CHECK(blue[1] > blue[0]);

  // Shows the ball in its own material, from the other side.
  request.levels = false;
  request.camera.position = {4, -3, -70};
  request.camera.direction = {0, 0, 1};
  CHECK(brightness(draw(pictured(world, coarse)), 80, 60, 20) > 30);
  for (const std::string& message : renderer->messages()) CHECK(message.empty());
}
