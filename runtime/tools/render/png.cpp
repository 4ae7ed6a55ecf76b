#include "tools/render/image.h"

// Makes stb's functions static, because a program that links this library may contain its own copy of stb.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace sgm {
namespace {

void append(void* bytes, void* data, int size) {
  auto& into = *static_cast<std::vector<std::byte>*>(bytes);
  const auto* from = static_cast<const std::byte*>(data);
  into.insert(into.end(), from, from + size);
}

}  // namespace

Result<std::vector<std::byte>> encodePng(const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      image.rgba.size() != size_t{4} * static_cast<size_t>(image.width) * static_cast<size_t>(image.height)) {
    return Error{Code::invalid_argument, "the size of the picture does not match its pixels"};
  }
  std::vector<std::byte> bytes;
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), 0) == 0)
    return Error{Code::out_of_memory, "out of memory while encoding the picture"};
  return bytes;
}

Result<void> writePng(const Image& image, FileWriter& file) {
  const Result<std::vector<std::byte>> bytes = encodePng(image);
  if (!bytes) return bytes.error();
  file.write(bytes->data(), bytes->size());
  return file.commit();
}

}  // namespace sgm
