#include "tools/render/video_file.h"
#include "base/plain_text.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

extern char** environ;

namespace sgm::cli {
namespace {

constexpr const char* kEncoder = "ffmpeg";
constexpr size_t kLastWords = 300;

Error ioError(int code) { return {Code::io, std::string("cannot start ffmpeg: ") + systemMessage(code)}; }

/// The last line in a file.
std::string lastLine(std::FILE* file) {
  std::string text(4096, '\0');
  const off_t size = lseek(fileno(file), 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(text.size()));
  const ssize_t count = pread(fileno(file), text.data(), text.size(), from);
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
  words_ = std::tmpfile();
  if (words_ == nullptr) return ioError(errno);
  // A socket instead of a pipe: if the encoder ends early, writing fails without SIGPIPE.
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return ioError(errno);
  pictures_ = ends[0];
  std::vector<std::string> words{kEncoder,
                                 "-nostdin",
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
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(words_), STDERR_FILENO);
  pid_t process = -1;
  const int code = posix_spawnp(&process, kEncoder, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (code == ENOENT)
    return Error{Code::unsupported,
                 "there is no program ffmpeg on the PATH to encode a video: install the package ffmpeg"};
  if (code != 0) return ioError(code);
  encoder_ = process;
  return {};
}

VideoFile::~VideoFile() {
  if (encoder_ > 0) {
    kill(encoder_, SIGKILL);
    wait();
  }
  if (pictures_ >= 0) close(pictures_);
  if (words_ != nullptr) std::fclose(words_);
}

int VideoFile::wait() {
  int status = 0;
  while (waitpid(encoder_, &status, 0) < 0 && errno == EINTR) continue;
  encoder_ = -1;
  return status;
}

Error VideoFile::failed(int status) const {
  std::string why = WIFSIGNALED(status) ? fmt::format("ffmpeg was ended by signal {}", WTERMSIG(status))
                                        : fmt::format("ffmpeg ended with status {}", WEXITSTATUS(status));
  if (const std::string words = lastLine(words_); !words.empty()) why += ": " + words;
  return {Code::io, "the video could not be encoded: " + why};
}

Result<void> VideoFile::add(const Image& image) {
  const uint8_t* from = image.rgba.data();
  for (size_t left = image.rgba.size(); left > 0;) {
    const ssize_t sent = send(pictures_, from, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) {
      close(std::exchange(pictures_, -1));
      return failed(wait());
    }
    from += sent;
    left -= static_cast<size_t>(sent);
  }
  return {};
}

Result<void> VideoFile::commit() {
  close(std::exchange(pictures_, -1));
  const int status = wait();
  std::error_code why;
  const auto bytes = std::filesystem::file_size(file_.name(), why);
  if (status != 0 || why || bytes == 0) return failed(status);
  return file_.commit();
}

}  // namespace sgm::cli
