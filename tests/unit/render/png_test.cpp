#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "catch.h"
#include "render/image.h"

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
  size_t entries() const {
    size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(path)) ++count;
    return count;
  }
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
    auto written = writePng(path, image);
    REQUIRE(written);
    int w = 0, h = 0, channels = 0;
    stbi_uc* pixels = stbi_load(path.c_str(), &w, &h, &channels, 4);
    REQUIRE(pixels);
    CHECK((w == width && h == height && channels == 4));
    CHECK(std::equal(image.rgba.begin(), image.rgba.end(), pixels));
    stbi_image_free(pixels);
    CHECK(folder.entries() == 1);
  }
}

TEST_CASE("what cannot be written is an error that names the file, and leaves nothing", "[render]") {
  const Folder folder;
  const Image image = randomImage(8, 8, 1);
  const auto refused = [&](const std::string& path) {
    auto written = writePng(path, image);
    INFO(path);
    REQUIRE(!written);
    CHECK(written.error().code == Code::io);
    CHECK(written.error().message.find(path) != std::string::npos);
  };
  refused((folder.path / "missing" / "picture.png").string());
  CHECK(folder.entries() == 0);
  fs::create_directories(folder.path / "taken.png" / "inside");
  refused((folder.path / "taken.png").string());  // a folder cannot be replaced by a file
  CHECK(folder.entries() == 1);
  if (geteuid() != 0) {  // root may write anywhere
    REQUIRE(chmod(folder.path.c_str(), 0500) == 0);
    refused((folder.path / "picture.png").string());
    REQUIRE(chmod(folder.path.c_str(), 0700) == 0);
    CHECK(folder.entries() == 1);
  }
  if (fs::exists("/dev/full")) {
    // Nothing can be renamed onto a device from another file system; a full disk shows at the link beside.
    fs::create_symlink("/dev/full", folder.path / ("full.png.part" + std::to_string(getpid())));
    refused((folder.path / "full.png").string());
    CHECK(folder.entries() == 1);
  }
}

TEST_CASE("sizes must match pixels", "[render]") {
  Image image = randomImage(4, 4, 2);
  image.width = 5;
  auto written = writePng("never.png", image);
  REQUIRE(!written);
  CHECK(written.error().code == Code::invalid_argument);
  CHECK(!fs::exists("never.png"));
}
