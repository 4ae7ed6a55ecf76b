#pragma once
// A background thread for work that must not delay the engine's main thread.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace sgm_godot {

/// Lowers the priority of the calling thread, so that the engine's own threads run first if there are fewer processors
/// than threads. Has no effect if the system does not allow it.
void yieldToEngine();

class Background {
 public:
  Background();
  /// Blocks until all submitted work is done.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Submits work. Thread-safe. Work runs in the order of submission, and must not throw exceptions.
  void run(std::function<void()> work);
  /// Blocks until all work that was submitted so far is done.
  void finish();

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> work_;
  bool ending_ = false, working_ = false;
  std::thread thread_;  // the last member, because the thread uses all members above
};

}  // namespace sgm_godot
