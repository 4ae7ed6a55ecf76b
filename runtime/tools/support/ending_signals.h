#pragma once
// Defers signals that end the process during work that they must not interrupt.

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "base/file_writer.h"

namespace sgm::cli {

/// Defers signals that would end the process while critical work is done. Blocking the signals is not enough: a signal
/// mask applies to one thread only, and the system would deliver the signal to another. Works only if the signal
/// handler calls waits(). Thread-safe.
class EndingSignals {
 public:
  /// Must be called by the signal handler before it ends the process. Returns whether the signal is deferred; if so,
  /// the handler must return, and the signal is raised again when the critical work is done. Neither locks nor
  /// allocates.
  bool waits(int signal) noexcept {
    int state = kOpen;
    while (!state_.compare_exchange_weak(state, state == kOpen ? kEnding : state == kHeld ? signal : state)) {
    }
    return state == kHeld || state > 0;
  }

 private:
  friend class Uninterrupted;
  // Values of state_; a positive value is the number of the deferred signal.
  static constexpr int kOpen = 0, kHeld = -1, kEnding = -2;

  std::atomic<int> state_{kOpen};
};

/// Defers ending signals during its lifetime. signals: must outlive this object; null, with which nothing is deferred,
/// if no signal handler calls signals->waits(). At most one Uninterrupted may exist for an EndingSignals.
class Uninterrupted {
 public:
  explicit Uninterrupted(EndingSignals* signals) : signals_(signals) {
    if (signals_ == nullptr) return;
    int open = EndingSignals::kOpen;
    // The signal handler, in another thread, is about to end the process: wait for that end.
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

/// Global variables, because a signal handler cannot reach anything else: the files that it removes, and the work that
/// it must not interrupt.
extern UnfinishedFiles unfinished_files;
extern EndingSignals ending_signals;

}  // namespace sgm::cli
