#pragma once
// Decides when a server that did not answer is tried again, and when its outage is logged.

#include <chrono>
#include <mutex>

namespace sgm::store {

/// The availability of one server. After a failure the server counts as away. It is tried again after one second, then
/// after two; the delay doubles up to a minute. If the server fails again soon after it has answered, the delay
/// continues from its previous value. Thread-safe. Parameters: `begun` is the time when a request began, `now` the time
/// when its outcome was known.
class Outage {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kFirstRest{1}, kLongestRest{60};

  /// there: send the request; away: do not send it; find_out: send a test request and report its outcome.
  enum class Look { there, away, find_out };
  /// Returns whether a request may be sent. find_out: the server counts as away, and this caller must send a test
  /// request and report its outcome by failed(), answered() or gaveUp().
  Look look(Clock::time_point now);
  /// Reports a failed request. Returns true if the failure should be logged: once per outage, and at most once a
  /// minute.
  bool failed(Clock::time_point begun, Clock::time_point now);
  /// Reports that the server answered. Returns true if the end of an outage should be logged: the answer ends an
  /// outage, and the outage's start was logged.
  bool answered(Clock::time_point begun, Clock::time_point now);
  /// Call this after look() has returned find_out if no test request is sent after all: the next caller of look() may
  /// then send it.
  void gaveUp();

 private:
  std::mutex mutex_;
  bool is_away_ = false, is_asked_ = false, is_told_ = false, was_ever_told_ = false;
  std::chrono::seconds rest_{0};  ///< delay before the next test request, in the current or the last outage
  Clock::time_point until_, failed_at_, answered_at_, told_at_;
};

}  // namespace sgm::store
