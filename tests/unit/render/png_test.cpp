#include <unistd.h>

#include <filesystem>
#include <random>

#include "catch.h"
#include "tools/render/image.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

using namespace sgm;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("sgm_png_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

Image randomImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{width, height, std::vector<uint8_t>(static_cast<size_t>(4 * width * height))};
  for (uint8_t& byte : image.rgba) byte = static_cast<uint8_t>(random());
  return image;
}

}  // namespace

TEST_CASE("a PNG gives back every pixel", "[render]") {
  const Folder folder;
  const std::string path = (folder.path / "picture.png").string();
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 3}, std::pair{64, 65}, std::pair{333, 2}}) {
    const Image image = randomImage(width, height, static_cast<unsigned>(width));
    Result<FileWriter> file = FileWriter::create(path);
    REQUIRE(file);
    REQUIRE(writePng(image, *file));
    int w = 0, h = 0, channels = 0;
    stbi_uc* pixels = stbi_load(path.c_str(), &w, &h, &channels, 4);
    REQUIRE(pixels);
    CHECK((w == width && h == height && channels == 4));
    CHECK(std::equal(image.rgba.begin(), image.rgba.end(), pixels));
    stbi_image_free(pixels);
  }
}

TEST_CASE("sizes must match pixels", "[render]") {
  const Folder folder;
  Image image = randomImage(4, 4, 2);
  image.width = 5;
  Result<FileWriter> file = FileWriter::create(folder.path / "never.png");
  REQUIRE(file);
  const Result<void> written = writePng(image, *file);
  REQUIRE(!written);
  CHECK(written.error().code == Code::invalid_argument);
  CHECK(!fs::exists(folder.path / "never.png"));
}
