#pragma once
// Writes a video; the program ffmpeg encodes it picture by picture.

#include <memory>
#include <optional>
#include <string>

#include "base/file_writer.h"
#include "base/platform/process.h"
#include "tools/render/image.h"

namespace sgm::cli {

/// Not thread-safe.
class VideoFile {
 public:
  struct Format {
    int width = 640, height = 360;
    int rate = 30;  ///< pictures a second
  };

  /// Starts the encoder. Errors: unsupported if ffmpeg is not on the PATH; io if the file cannot be written.
  static Result<std::unique_ptr<VideoFile>> begin(const std::string& target, UnfinishedFiles* unfinished,
                                                  const Format& format);
  /// Without commit(), removes the file.
  ~VideoFile() = default;
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// Adds a picture, which must have the format's size. Error: io if the encoder has ended.
  Result<void> add(const Image& image);
  /// Waits until the encoder has finished, then renames the file to its target. Error: io.
  Result<void> commit();

 private:
  explicit VideoFile(FileWriter file) : file_(std::move(file)) {}

  Result<void> start(const Format& format);
  Error failed(const platform::ProcessExit& exit) const;

  FileWriter file_;
  platform::File words_;  ///< the encoder's messages
  std::optional<platform::Process> encoder_;
};

}  // namespace sgm::cli
