#pragma once
// How much of a frame the plugin takes on the engine's main thread.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

namespace sgm_godot {

/// The last thousand frames.
class FrameTimes {
 public:
  /// Adds what was spent to the frame that goes on.
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
  double last() const { return count_ == 0 ? 0 : times_[(count_ - 1) % kFrames]; }  // milliseconds
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
