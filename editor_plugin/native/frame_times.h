#pragma once
// Measures how much of each frame's main-thread time the plugin uses.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

namespace sgm_godot {

/// The times of the last thousand frames.
class FrameTimes {
 public:
  /// Adds the time from construction to destruction to the current frame.
  class Span {
   public:
    explicit Span(FrameTimes& times) : times_(times), start_(Clock::now()) {}
    ~Span() { times_.current_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    FrameTimes& times_;
    std::chrono::steady_clock::time_point start_;
  };

  void nextFrame() {
    times_[count_++ % kFrames] = current_;
    current_ = 0;
  }
  // Milliseconds of the last complete frame.
  double last() const { return count_ == 0 ? 0 : times_[(count_ - 1) % kFrames]; }
  double percentile(double share) const {
    std::vector<double> sorted(times_.begin(), times_.begin() + static_cast<ptrdiff_t>(std::min(count_, kFrames)));
    if (sorted.empty()) return 0;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr size_t kFrames = 1000;
  std::array<double, kFrames> times_{};
  size_t count_ = 0;
  double current_ = 0;
};

}  // namespace sgm_godot
