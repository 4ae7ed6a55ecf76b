#pragma once
// What the command says, and with which status it ends.

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

/// The status that an error of ours ends with.
Exit exitOf(Code code);

/// "sgm: error: message" ("sgm: usage: message" for a wrong command line) as one line on stderr. Returns status.
Exit complain(Exit status, std::string_view message);
inline Exit complain(const Error& error) { return complain(exitOf(error.code), error.message); }

/// A bar on stderr where that is a terminal, with the time that is left where it takes long; erases itself when it
/// ends. Elsewhere a line each minute, for logs. Work that tells nothing of how far it is has the time it has taken, by
/// the second and the minute.
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
  /// ", 0:12:30 left", once that can be told.
  std::string left(Clock::time_point now) const;

  const std::string what_;
  const bool terminal_;
  const Clock::time_point begun_ = Clock::now();
  std::mutex mutex_;  ///< guards all that follows
  std::condition_variable ended_;
  uint64_t done_ = 0, total_ = 0;  ///< total_ is 0 while nothing is known
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
