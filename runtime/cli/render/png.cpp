#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

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

struct Sink {
  std::FILE* file;
  bool failed;
};

void append(void* context, void* data, int size) {
  auto* sink = static_cast<Sink*>(context);
  const size_t bytes = static_cast<size_t>(size);
  if (std::fwrite(data, 1, bytes, sink->file) != bytes) sink->failed = true;
}

Error fileError(const std::string& path, int reason) {
  return {Code::io, "cannot write " + path + ": " + std::strerror(reason)};
}

}  // namespace

Result<void> writePng(const std::string& path, const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      image.rgba.size() != size_t{4} * static_cast<size_t>(image.width) * static_cast<size_t>(image.height)) {
    return Error{Code::invalid_argument, "the picture's sizes do not match its pixels"};
  }
  // The process number keeps two runs that write the same picture from sharing a temporary file.
  const std::string beside = path + ".part" + std::to_string(getpid());
  errno = 0;
  Sink sink{std::fopen(beside.c_str(), "wb"), false};
  if (!sink.file) return fileError(path, errno);
  const int encoded = stbi_write_png_to_func(append, &sink, image.width, image.height, 4, image.rgba.data(), 0);
  int reason = errno;
  bool ok = encoded != 0 && !sink.failed;
  if (std::fclose(sink.file) != 0 && ok) ok = false, reason = errno;
  if (ok && std::rename(beside.c_str(), path.c_str()) != 0) ok = false, reason = errno;
  if (ok) return {};
  std::remove(beside.c_str());
  return fileError(path, reason ? reason : EIO);
}

}  // namespace sgm
