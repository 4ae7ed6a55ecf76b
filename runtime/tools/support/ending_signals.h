#pragma once
// Work that a signal must not cut in two.

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "base/file_writer.h"

namespace sgm::cli {

/// Signals that would end the process, and wait while something is done that has to be done whole. A mask would not do:
/// it is one thread's, and the signal goes to another. Of a program whose handler asks waits(). Any thread.
class EndingSignals {
 public:
  /// For the handler, before it ends the process: whether the signal came while work must not be cut. It is raised
  /// again when that is done. Neither locks nor allocates.
  bool waits(int signal) noexcept {
    int state = kOpen;
    while (!state_.compare_exchange_weak(state, state == kOpen ? kEnding : state == kHeld ? signal : state)) {
    }
    return state == kHeld || state > 0;
  }

 private:
  friend class Uninterrupted;
  static constexpr int kOpen = 0, kHeld = -1, kEnding = -2;  // or the signal that came while held

  std::atomic<int> state_{kOpen};
};

/// While it lives, signals wait. signals: null where nobody handles them; outlives this. One at a time.
class Uninterrupted {
 public:
  explicit Uninterrupted(EndingSignals* signals) : signals_(signals) {
    if (signals_ == nullptr) return;
    int open = EndingSignals::kOpen;
    // Another thread's handler is about to end the process.
    if (!signals_->state_.compare_exchange_strong(open, EndingSignals::kHeld))
      for (;;) pause();
  }
  ~Uninterrupted() {
    if (signals_ == nullptr) return;
    const int came = signals_->state_.exchange(EndingSignals::kOpen);
    if (came > 0) std::raise(came);
  }
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  EndingSignals* signals_;
};

/// Of this process, since a signal handler has nothing else to hold on to: the files that it removes, and the work that
/// it waits for.
extern UnfinishedFiles unfinished_files;
extern EndingSignals ending_signals;

}  // namespace sgm::cli
