#pragma once
// A video that the program ffmpeg encodes, picture by picture.

#include <cstdio>
#include <memory>
#include <string>

#include "base/file_writer.h"
#include "tools/render/image.h"

namespace sgm::cli {

/// One thread at a time.
class VideoFile {
 public:
  struct Format {
    int width = 640, height = 360;
    int rate = 30;  ///< pictures a second
  };

  /// Starts the encoder. Errors: unsupported, there is no ffmpeg on the PATH; io, the file cannot be written.
  static Result<std::unique_ptr<VideoFile>> begin(const std::string& target, UnfinishedFiles* unfinished,
                                                  const Format& format);
  /// Without commit() nothing is left behind.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// The picture must be of the format. Errors: io, the encoder has ended.
  Result<void> add(const Image& image);
  /// Waits for the encoder; then the file has its name. Errors: io.
  Result<void> commit();

 private:
  explicit VideoFile(FileWriter file) : file_(std::move(file)) {}

  Result<void> start(const Format& format);
  /// Its status, as waitpid() says it.
  int wait();
  Error failed(int status) const;

  FileWriter file_;
  std::FILE* words_ = nullptr;  ///< what the encoder says
  int pictures_ = -1;           ///< a socket to the encoder
  int encoder_ = -1;            ///< its process; -1: none runs
};

}  // namespace sgm::cli
