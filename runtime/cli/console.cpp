#include "cli/console.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>

namespace sgm::cli {

Exit exitOf(Code code) {
  switch (code) {
    case Code::invalid_argument:
    case Code::range:
    case Code::bad_input:
    case Code::limit:
    case Code::out_of_memory:
    case Code::cancelled:
    case Code::busy:
      return Exit::input;
    case Code::io:
      return Exit::file;
    case Code::unsupported:
    case Code::device_lost:
      return Exit::backend;
  }
  return Exit::input;
}

Exit complain(Exit status, std::string_view message) {
  fmt::print(stderr, "sgm: {}: {}\n", status == Exit::usage ? "usage" : "error", message);
  return status;
}

/// Seconds in which a bar has shown too little to tell from.
constexpr double kBeforeEstimates = 3;

ProgressBar::ProgressBar(std::string_view what) : what_(what), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

std::string ProgressBar::left(uint64_t done, uint64_t total, std::chrono::steady_clock::time_point now) const {
  const double passed = std::chrono::duration<double>(now - begun_).count();
  if (passed < kBeforeEstimates || done == 0) return {};
  const auto left = static_cast<uint64_t>(passed * static_cast<double>(total - done) / static_cast<double>(done));
  return fmt::format(", {}:{:02}:{:02} left", left / 3600, left / 60 % 60, left % 60);
}

void ProgressBar::show(uint64_t done, uint64_t total) {
  if (total == 0) return;
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_) {
    if (now - last_ < std::chrono::minutes(1)) return;
    last_ = now;
    fmt::print(stderr, "sgm: {}: {} %{}\n", what_, 100 * done / total, left(done, total, now));
    return;
  }
  if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  constexpr uint64_t kWidth = 32;
  const uint64_t filled = std::min(kWidth, done * kWidth / total);
  fmt::print(stderr, "\r{} [{:#<{}}{: <{}}] {}/{}", what_, "", filled, "", kWidth - filled, done, total);
  fmt::print(stderr, "{}\x1b[K", left(done, total, now));
  std::fflush(stderr);
}

}  // namespace sgm::cli
