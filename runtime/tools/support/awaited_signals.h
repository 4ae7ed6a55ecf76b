#pragma once
// Signals that a command waits for in place of being ended by them.

namespace sgm::cli {

/// Holds SIGINT, SIGTERM and SIGHUP back, from this thread and those that it starts, until it is waited for one.
class AwaitedSignals {
 public:
  AwaitedSignals();
  ~AwaitedSignals();
  AwaitedSignals(const AwaitedSignals&) = delete;
  AwaitedSignals& operator=(const AwaitedSignals&) = delete;

  /// Whether one has come. Never waits.
  bool came();
  /// Ends the process by the signal that has come, as if it had never been held back.
  void pass();
  /// Blocks until one comes, unless one has. The next one ends the process.
  void wait();

 private:
  void release();

  bool held_ = true;
  int came_ = 0;  ///< the signal
};

}  // namespace sgm::cli
