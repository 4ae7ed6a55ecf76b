#pragma once
// Lets a command wait for signals that would otherwise end it.

namespace sgm::cli {

/// Blocks SIGINT, SIGTERM and SIGHUP in this thread, and in the threads that it starts, until wait() or pass() is
/// called.
class AwaitedSignals {
 public:
  AwaitedSignals();
  ~AwaitedSignals();
  AwaitedSignals(const AwaitedSignals&) = delete;
  AwaitedSignals& operator=(const AwaitedSignals&) = delete;

  /// Whether one of these signals is pending. Never blocks.
  bool came();
  /// Ends the process by the signal that came() has found, as if that signal had never been blocked.
  void pass();
  /// Blocks until one of these signals arrives; returns immediately if came() has found one. The next signal ends the
  /// process.
  void wait();

 private:
  void release();

  bool held_ = true;
  int came_ = 0;  ///< the signal that came() or wait() has found; 0: none
};

}  // namespace sgm::cli
