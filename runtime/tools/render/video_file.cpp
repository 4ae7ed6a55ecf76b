#include "tools/render/video_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/plain_text.h"

namespace sgm::cli {
namespace {

constexpr size_t kLastWords = 300;

/// The last line of a file, at most kLastWords bytes.
std::string lastLine(int file) {
  constexpr uint64_t kEnd = 4096;
  platform::FileStatus status;
  if (platform::statusOf(file, status) != 0) return {};
  std::string text(static_cast<size_t>(std::min(status.bytes, kEnd)), '\0');
  const ptrdiff_t count = platform::readAt(file, text.data(), text.size(), status.bytes - text.size());
  text.resize(count > 0 ? static_cast<size_t>(count) : 0);
  text.erase(text.find_last_not_of(" \r\n\t") + 1);
  const size_t before = text.find_last_of("\r\n");
  return text.substr(before == text.npos ? 0 : before + 1).substr(0, kLastWords);
}

}  // namespace

Result<std::unique_ptr<VideoFile>> VideoFile::begin(const std::string& target, UnfinishedFiles* unfinished,
                                                    const Format& format) {
  Result<FileWriter> file = FileWriter::create(target, unfinished, FileWriter::Naming::named);
  if (!file) return file.error();
  std::unique_ptr<VideoFile> video(new VideoFile(std::move(*file)));
  if (Result<void> started = video->start(format); !started) return started.error();
  return video;
}

Result<void> VideoFile::start(const Format& format) {
  std::error_code why;
  words_ = platform::File(platform::openScratchFile(std::filesystem::temp_directory_path(why)));
  if (!words_) return Error{Code::io, "cannot make a file for ffmpeg's messages: " + systemMessage(errno)};
  platform::ProcessSettings settings;
  settings.program = "ffmpeg";
  settings.arguments = {"-nostdin",
                        "-loglevel",
                        "error",
                        "-y",
                        "-f",
                        "rawvideo",
                        "-pix_fmt",
                        "rgba",
                        "-s",
                        fmt::format("{}x{}", format.width, format.height),
                        "-r",
                        std::to_string(format.rate),
                        "-i",
                        "pipe:0",
                        "-pix_fmt",
                        "yuv420p",
                        "-movflags",
                        "+faststart",
                        "-f",
                        "mp4",
                        "file:" + file_.name()};
  settings.input = {platform::Stream::pipe};
  settings.output = {platform::Stream::none};
  settings.error = {platform::Stream::file, words_.number()};
  Result<platform::Process> encoder = platform::Process::start(settings);
  if (!encoder && encoder.error().code == Code::unsupported)
    return Error{Code::unsupported,
                 "there is no program ffmpeg on the PATH to encode a video: install the package ffmpeg"};
  if (!encoder) return encoder.error();
  encoder_.emplace(std::move(*encoder));
  return {};
}

Error VideoFile::failed(const platform::ProcessExit& exit) const {
  const bool by_itself = exit.kind == platform::ProcessExit::Kind::exited;
  std::string why = by_itself ? fmt::format("ffmpeg ended with status {}", exit.number)
                              : fmt::format("ffmpeg was ended by signal {}", exit.number);
  if (const std::string words = lastLine(words_.number()); !words.empty()) why += ": " + words;
  return {Code::io, "the video could not be encoded: " + why};
}

Result<void> VideoFile::add(const Image& image) {
  const std::string_view bytes(reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size());
  if (encoder_->write(bytes)) return {};
  encoder_->closeInput();
  return failed(encoder_->wait());
}

Result<void> VideoFile::commit() {
  encoder_->closeInput();
  const platform::ProcessExit exit = encoder_->wait();
  std::error_code why;
  const auto bytes = std::filesystem::file_size(file_.name(), why);
  if (!exit.succeeded() || why || bytes == 0) return failed(exit);
  return file_.commit();
}

}  // namespace sgm::cli
