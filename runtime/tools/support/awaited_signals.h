#pragma once
// Lets a command wait for signals that would otherwise end the process.

namespace sgm::cli {

/// Blocks SIGINT, SIGTERM and SIGHUP in the current thread, and in threads that it starts, until wait() or pass()
/// returns.
class AwaitedSignals {
 public:
  AwaitedSignals();
  ~AwaitedSignals();
  AwaitedSignals(const AwaitedSignals&) = delete;
  AwaitedSignals& operator=(const AwaitedSignals&) = delete;

  /// Whether one of these signals has arrived. Never blocks.
  bool came();
  /// Ends the process by the signal that came() has found, as if the signal had not been blocked.
  void pass();
  /// Blocks until one of these signals arrives. Returns at once if came() has found one. After that, signals are no
  /// longer blocked, so the next one ends the process.
  void wait();

 private:
  void release();

  bool held_ = true;
  int came_ = 0;  ///< number of the signal that has arrived; 0 if none has
};

}  // namespace sgm::cli
