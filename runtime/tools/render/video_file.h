#pragma once
// Writes a video, which the program ffmpeg encodes frame by frame.

#include <memory>
#include <optional>
#include <string>

#include "base/file_writer.h"
#include "base/platform/process.h"
#include "tools/render/image.h"

namespace sgm::cli {

/// A video file that is being written. Not thread-safe.
class VideoFile {
 public:
  struct Format {
    int width = 640, height = 360;
    int rate = 30;  ///< pictures a second
  };

  /// Starts ffmpeg. Errors: unsupported if ffmpeg is not on the PATH; io if the file cannot be written.
  static Result<std::unique_ptr<VideoFile>> begin(const std::string& target, UnfinishedFiles* unfinished,
                                                  const Format& format);
  /// Deletes the unfinished file unless commit() has succeeded.
  ~VideoFile() = default;
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// Adds a frame, which must have the size of Format. Error: io if ffmpeg has ended.
  Result<void> add(const Image& image);
  /// Waits until ffmpeg has finished, then renames the file to its final name. Error: io.
  Result<void> commit();

 private:
  explicit VideoFile(FileWriter file) : file_(std::move(file)) {}

  Result<void> start(const Format& format);
  Error failed(const platform::ProcessExit& exit) const;

  FileWriter file_;
  platform::File words_;  ///< file with ffmpeg's messages
  std::optional<platform::Process> encoder_;
};

}  // namespace sgm::cli
