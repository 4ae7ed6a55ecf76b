#include "tools/support/console.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <system_error>

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

Exit reportError(Exit status, std::string_view message) {
  // On a terminal, erase an unfinished progress bar first.
  const char* erase = isatty(STDERR_FILENO) == 1 ? "\r\x1b[K" : "";
  fmt::print(stderr, "{}sgm: {}: {}\n", erase, status == Exit::usage ? "usage" : "error", message);
  return status;
}

namespace {

/// Seconds until a progress bar shows an estimate of the remaining time.
constexpr double kBeforeEstimates = 3;
constexpr std::chrono::seconds kBetweenTicks{1};
constexpr std::chrono::minutes kBetweenLines{1};

std::string clockText(uint64_t seconds) {
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace

ProgressBar::ProgressBar(std::string_view what) : what_(what), terminal_(isatty(STDERR_FILENO) == 1) {
  // Block all signals in the new thread, so that they are handled by the threads that existed before.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    ticker_ = std::thread([this] { tick(); });
  } catch (const std::system_error&) {
    // Without the thread, the bar is redrawn only when show() is called.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ProgressBar::~ProgressBar() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  ended_.notify_all();
  if (ticker_.joinable()) ticker_.join();
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::tick() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kBetweenTicks, [this] { return over_; })) {
    const Clock::time_point now = Clock::now();
    if (now - last_ >= (terminal_ ? Clock::duration(kBetweenTicks) : Clock::duration(kBetweenLines))) draw(now);
  }
}

std::string ProgressBar::left(Clock::time_point now) const {
  const double passed = std::chrono::duration<double>(now - begun_).count();
  if (passed < kBeforeEstimates || done_ == 0) return {};
  const double left = passed * static_cast<double>(total_ - done_) / static_cast<double>(done_);
  return ", " + clockText(static_cast<uint64_t>(left)) + " left";
}

void ProgressBar::draw(Clock::time_point now) {
  last_ = now;
  const auto passed = static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(now - begun_).count());
  const bool known = done_ > 0 && total_ > 0;
  if (!terminal_) {
    if (known)
      fmt::print(stderr, "sgm: {}: {} %{}\n", what_, 100 * done_ / total_, left(now));
    else
      fmt::print(stderr, "sgm: {}: for {}\n", what_, clockText(passed));
    return;
  }
  drawn_ = true;
  if (known) {
    constexpr uint64_t kWidth = 32;
    const uint64_t filled = std::min(kWidth, done_ * kWidth / total_);
    fmt::print(stderr, "\r{} [{:#<{}}{: <{}}] {}/{}{}\x1b[K", what_, "", filled, "", kWidth - filled, done_, total_,
               left(now));
  } else {
    fmt::print(stderr, "\r{}: for {}\x1b[K", what_, clockText(passed));
  }
  std::fflush(stderr);
}

void ProgressBar::show(uint64_t done, uint64_t total) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  total_ = total;
  const Clock::time_point now = Clock::now();
  const auto between = terminal_ ? Clock::duration(std::chrono::milliseconds(100)) : Clock::duration(kBetweenLines);
  if (total > 0 && (now - last_ >= between || (terminal_ && !drawn_))) draw(now);
}

}  // namespace sgm::cli
