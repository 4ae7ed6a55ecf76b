#include "background.h"

#include <utility>

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace sgm_godot {

void yieldToEngine() {
#if defined(__linux__)
  constexpr int kNiceness = 5;
  static_cast<void>(setpriority(PRIO_PROCESS, 0, kNiceness));  // who = 0 stands for the calling thread: on Linux, each
                                                               // thread has its own priority
#endif
}

Background::Background() : thread_([this] { loop(); }) {}

Background::~Background() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Background::run(std::function<void()> work) {
  {
    const std::lock_guard lock(mutex_);
    work_.push_back(std::move(work));
  }
  changed_.notify_all();
}

void Background::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return work_.empty() && !working_; });
}

void Background::loop() {
  yieldToEngine();
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !work_.empty(); });
    if (work_.empty()) return;
    {
      const std::function<void()> work = std::move(work_.front());
      work_.pop_front();
      working_ = true;
      lock.unlock();
      work();
    }
    lock.lock();
    working_ = false;
    changed_.notify_all();
  }
}

}  // namespace sgm_godot
