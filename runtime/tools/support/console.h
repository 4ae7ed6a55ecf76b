#pragma once
// Error messages, progress bar and exit status of the command `sgm`.

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

/// Exit status of the command. Scripts depend on these numbers.
enum class Exit : int {
  done = 0,
  input = 1,    ///< the input is wrong
  usage = 2,    ///< the command line is wrong
  backend = 3,  ///< the requested backend or device does not exist here
  file = 4,     ///< a file could not be read or written
};

/// The exit status for an error.
Exit exitOf(Code code);

/// Prints "sgm: error: message" ("sgm: usage: message" for a wrong command line) as one line on stderr. Returns status.
Exit reportError(Exit status, std::string_view message);
inline Exit reportError(const Error& error) { return reportError(exitOf(error.code), error.message); }

/// Shows progress on stderr. On a terminal it is a bar, with an estimate of the remaining time for long work, which is
/// erased at the end. Otherwise it is a line each minute, for logs. While the amount of work is unknown, the elapsed
/// time is shown instead, each second or minute.
class ProgressBar {
 public:
  explicit ProgressBar(std::string_view what);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Thread-safe. Redraws a few times a second at most.
  void show(uint64_t done, uint64_t total);

 private:
  using Clock = std::chrono::steady_clock;

  void tick();
  void draw(Clock::time_point now);
  /// The remaining time as ", 0:12:30 left", or "" while there is no estimate.
  std::string left(Clock::time_point now) const;

  const std::string what_;
  const bool terminal_;
  const Clock::time_point begun_ = Clock::now();
  std::mutex mutex_;  ///< protects the members below
  std::condition_variable ended_;
  uint64_t done_ = 0, total_ = 0;  ///< amounts of work; total_ is 0 while it is unknown
  bool drawn_ = false, over_ = false;
  Clock::time_point last_ = begun_;
  std::thread ticker_;
};

/// Measures the seconds since its construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sgm::cli
