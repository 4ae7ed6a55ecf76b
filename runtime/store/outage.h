#pragma once
// Decides whether to avoid a server that did not answer, and when to report that.

#include <chrono>
#include <mutex>

namespace sgm::store {

/// The state of one server. After the first failure it is away, and tested again after one second, then two, doubling
/// up to a minute. Failures soon after an answer continue with the previous delay. Thread-safe. `begun` and `now` are
/// the times when a request began and when its outcome was known.
class Outage {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kFirstRest{1}, kLongestRest{60};

  enum class Look { there, away, find_out };
  /// find_out: the server is away, and the caller must test it and report the outcome.
  Look look(Clock::time_point now);
  /// Returns whether to report the failure: once per outage, and at most once a minute.
  bool failed(Clock::time_point begun, Clock::time_point now);
  /// Returns whether to report the end of an outage: if its beginning was reported.
  bool answered(Clock::time_point begun, Clock::time_point now);
  /// The caller that had to find out did not test the server.
  void gaveUp();

 private:
  std::mutex mutex_;
  bool is_away_ = false, is_asked_ = false, is_told_ = false, was_ever_told_ = false;
  std::chrono::seconds rest_{0};  ///< of the last outage
  Clock::time_point until_, failed_at_, answered_at_, told_at_;
};

}  // namespace sgm::store
