#include "render/image.h"

// The writer's functions stay private to this file: a program that embeds us may bring its own stb.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace sgm {
namespace {

void append(void* file, void* data, int size) {
  static_cast<FileWriter*>(file)->write(data, static_cast<size_t>(size));
}

}  // namespace

Result<void> writePng(const Image& image, FileWriter& file) {
  if (image.width < 1 || image.height < 1 ||
      image.rgba.size() != size_t{4} * static_cast<size_t>(image.width) * static_cast<size_t>(image.height)) {
    return Error{Code::invalid_argument, "the picture's sizes do not match its pixels"};
  }
  if (stbi_write_png_to_func(append, &file, image.width, image.height, 4, image.rgba.data(), 0) == 0)
    return Error{Code::out_of_memory, "out of memory while encoding the picture"};
  return file.commit();
}

}  // namespace sgm
