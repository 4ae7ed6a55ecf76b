#pragma once
// The command's error messages, progress bar and exit status.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "base/result.h"

namespace sgm::cli {

/// Exit status of the command; part of its interface.
enum class Exit : int {
  done = 0,
  input = 1,    ///< the input is wrong
  usage = 2,    ///< the command line is wrong
  backend = 3,  ///< no such backend or device here
  file = 4,     ///< a file could not be read or written
};

/// The exit status for an error.
Exit exitOf(Code code);

/// "sgm: error: message" ("sgm: usage: message" for a wrong command line) as one line on stderr. Returns status.
Exit complain(Exit status, std::string_view message);
inline Exit complain(const Error& error) { return complain(exitOf(error.code), error.message); }

/// A bar on stderr if that is a terminal, with an estimate of the time left for long work; erases itself when it ends.
/// Otherwise a line each minute, for logs. Shows the elapsed time, each second or minute, while the work's extent is
/// unknown.
class ProgressBar {
 public:
  explicit ProgressBar(std::string_view what);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Any thread; redraws a few times a second at most.
  void show(uint64_t done, uint64_t total);

 private:
  using Clock = std::chrono::steady_clock;

  void tick();
  void draw(Clock::time_point now);
  /// ", 0:12:30 left", or "" while there is no estimate.
  std::string left(Clock::time_point now) const;

  const std::string what_;
  const bool terminal_;
  const Clock::time_point begun_ = Clock::now();
  std::mutex mutex_;  ///< guards all that follows
  std::condition_variable ended_;
  uint64_t done_ = 0, total_ = 0;  ///< total_ is 0 while it is unknown
  bool drawn_ = false, over_ = false;
  Clock::time_point last_ = begun_;
  std::thread ticker_;
};

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sgm::cli
