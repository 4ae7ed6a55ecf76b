#pragma once
// Error messages, progress bar and exit status of the program `sgm`.

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

/// Exit status of the program. The numbers are part of its interface, since scripts use them.
enum class Exit : int {
  done = 0,
  input = 1,    ///< the input, such as a grammar, is invalid
  usage = 2,    ///< the command line is invalid
  backend = 3,  ///< the requested backend or device is not available
  file = 4,     ///< a file could not be read or written
};

/// The exit status for an error code.
Exit exitOf(Code code);

/// Prints one line to stderr: "sgm: error: message", or "sgm: usage: message" for Exit::usage. Returns `status`.
Exit reportError(Exit status, std::string_view message);
inline Exit reportError(const Error& error) { return reportError(exitOf(error.code), error.message); }

/// Shows progress on stderr. On a terminal, a bar is shown, which is erased at the end; after some seconds, the bar
/// shows an estimate of the remaining time. If stderr is not a terminal, one line a minute is printed, for logs. While
/// the total amount of work is unknown, the elapsed time is shown instead.
class ProgressBar {
 public:
  explicit ProgressBar(std::string_view what);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Sets the amount of work done and its total. Thread-safe. Redraws the bar at most ten times a second.
  void show(uint64_t done, uint64_t total);

 private:
  using Clock = std::chrono::steady_clock;

  void tick();
  void draw(Clock::time_point now);
  /// The estimated remaining time as ", 0:12:30 left"; "" if there is no estimate yet.
  std::string left(Clock::time_point now) const;

  const std::string what_;
  const bool terminal_;
  const Clock::time_point begun_ = Clock::now();
  std::mutex mutex_;  ///< guards all members below it
  std::condition_variable ended_;
  uint64_t done_ = 0, total_ = 0;  ///< amount of work done and in total; total_ is 0 while unknown
  bool drawn_ = false, over_ = false;
  Clock::time_point last_ = begun_;
  std::thread ticker_;
};

/// Measures the time in seconds since its construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sgm::cli
