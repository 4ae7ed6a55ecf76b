#pragma once
// Lets a command wait for ending signals instead of being ended by them.

namespace sgm::cli {

/// Blocks SIGINT, SIGTERM and SIGHUP in this thread, and in the threads that it starts, until wait() or pass().
class AwaitedSignals {
 public:
  AwaitedSignals();
  ~AwaitedSignals();
  AwaitedSignals(const AwaitedSignals&) = delete;
  AwaitedSignals& operator=(const AwaitedSignals&) = delete;

  /// Whether a signal is pending. Never blocks.
  bool came();
  /// Ends the process by the signal that came(), as if it had never been blocked.
  void pass();
  /// Blocks until a signal arrives; returns at once if came(). The next signal ends the process.
  void wait();

 private:
  void release();

  bool held_ = true;
  int came_ = 0;  ///< the signal
};

}  // namespace sgm::cli
