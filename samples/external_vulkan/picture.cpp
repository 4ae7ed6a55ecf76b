#include "picture.h"

#include <stdexcept>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

void writePng(const Picture& picture, const std::string& path) {
  std::vector<uint8_t> rgb;
  rgb.reserve(3 * picture.pixels());
  for (size_t i = 0; i < picture.rgba.size(); i += 4) rgb.insert(rgb.end(), &picture.rgba[i], &picture.rgba[i] + 3);
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  if (stbi_write_png(path.c_str(), width, height, 3, rgb.data(), 0) == 0) {
    throw std::runtime_error("cannot write " + path);
  }
}
