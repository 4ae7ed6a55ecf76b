#pragma once
// A thread of the plugin's own, for work that the engine's main thread must not wait for.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace sgm_godot {

/// Lets the engine's own threads go first where there are fewer processors than threads: for the calling thread. What a
/// system does not allow is left as it is.
void yieldToEngine();

class Background {
 public:
  Background();
  /// Finishes everything that was given to it.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Any thread. Work is done in the order in which it comes; it lets no exception out.
  void run(std::function<void()> work);
  /// Waits until everything that was given to it is done.
  void finish();

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> work_;
  bool ending_ = false, working_ = false;
  std::thread thread_;  // last, so that all else is there when it starts
};

}  // namespace sgm_godot
