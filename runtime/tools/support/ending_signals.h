#pragma once
// Work that an ending signal must not interrupt.

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "base/file_writer.h"

namespace sgm::cli {

/// Defers signals that would end the process while critical work is done. A signal mask is not enough: it holds for one
/// thread, and the signal goes to another. Works only if the signal handler asks waits(). Thread-safe.
class EndingSignals {
 public:
  /// For the handler, before it ends the process: whether the signal is deferred. It is raised again when the critical
  /// work is done. Neither locks nor allocates.
  bool waits(int signal) noexcept {
    int state = kOpen;
    while (!state_.compare_exchange_weak(state, state == kOpen ? kEnding : state == kHeld ? signal : state)) {
    }
    return state == kHeld || state > 0;
  }

 private:
  friend class Uninterrupted;
  static constexpr int kOpen = 0, kHeld = -1, kEnding = -2;  // or the deferred signal

  std::atomic<int> state_{kOpen};
};

/// Defers ending signals during its lifetime. signals: must outlive this; null (nothing is deferred) if no signal
/// handler calls signals->waits(). At most one Uninterrupted exists for an EndingSignals.
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

/// Global, because a signal handler has no other access: the files that it removes, and the work that it waits for.
extern UnfinishedFiles unfinished_files;
extern EndingSignals ending_signals;

}  // namespace sgm::cli
