#pragma once
// Decides when a server that did not answer is tried again, and when its outage is reported.

#include <chrono>
#include <mutex>

namespace sgm::store {

/// The state of one server. After its first failure it counts as away, and is tried again after one second, then two,
/// doubling up to a minute. If it fails soon after it has answered, the previous delay continues. Thread-safe. `begun`
/// and `now`: the times when a request began and when its outcome was known.
class Outage {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kFirstRest{1}, kLongestRest{60};

  /// there: send the request; away: send none; find_out: see below.
  enum class Look { there, away, find_out };
  /// Returns what a caller may do. find_out: the server is away, and this caller must try it and report the outcome by
  /// failed(), answered() or gaveUp().
  Look look(Clock::time_point now);
  /// Reports a failed request. Returns true if the failure should be logged: once per outage, and at most once a
  /// minute.
  bool failed(Clock::time_point begun, Clock::time_point now);
  /// Reports an answer. Returns true if the end of the outage should be logged, because its beginning was.
  bool answered(Clock::time_point begun, Clock::time_point now);
  /// Reports that the caller that got find_out did not try the server.
  void gaveUp();

 private:
  std::mutex mutex_;
  bool is_away_ = false, is_asked_ = false, is_told_ = false, was_ever_told_ = false;
  std::chrono::seconds rest_{0};  ///< delay before the next try, in the current or the last outage
  Clock::time_point until_, failed_at_, answered_at_, told_at_;
};

}  // namespace sgm::store
