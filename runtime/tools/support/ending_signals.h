#pragma once
// Defers signals that would end the process, as long as critical work is done that must not be interrupted.

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "base/file_writer.h"

namespace sgm::cli {

/// Defers signals that would end the process while critical work is done. Blocking the signals would not suffice: a
/// signal mask applies to a single thread, and the system would deliver the signal to another. Requires that the signal
/// handler calls waits(). Thread-safe.
class EndingSignals {
 public:
  /// Must be called by the signal handler before it ends the process. If it returns true, the signal is deferred: the
  /// handler must return, and the signal is raised again when the critical work is done. Async-signal-safe: neither
  /// locks nor allocates.
  bool waits(int signal) noexcept {
    int state = kOpen;
    while (!state_.compare_exchange_weak(state, state == kOpen ? kEnding : state == kHeld ? signal : state)) {
    }
    return state == kHeld || state > 0;
  }

 private:
  friend class Uninterrupted;
  // Values of state_. kOpen: signals are not deferred. kHeld: signals are deferred, and none has arrived yet. kEnding:
  // a signal handler is ending the process. A positive value is the number of the deferred signal.
  static constexpr int kOpen = 0, kHeld = -1, kEnding = -2;

  std::atomic<int> state_{kOpen};
};

/// As long as an object of this class exists, signals that would end the process are deferred. signals: must outlive
/// the object; null if no signal handler calls waits(): then nothing is deferred. Only one Uninterrupted may exist at a
/// time for each EndingSignals.
class Uninterrupted {
 public:
  explicit Uninterrupted(EndingSignals* signals) : signals_(signals) {
    if (signals_ == nullptr) return;
    int open = EndingSignals::kOpen;
    // In another thread, the signal handler is already ending the process: wait for the end.
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

/// Global, because a signal handler can reach only global variables. unfinished_files: the files that the handler
/// removes. ending_signals: tells the handler whether a signal must be deferred.
extern UnfinishedFiles unfinished_files;
extern EndingSignals ending_signals;

}  // namespace sgm::cli
