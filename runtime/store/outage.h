#pragma once
// Whether a server that did not answer is to be left alone, and when that is worth a word.

#include <chrono>
#include <mutex>

namespace sgm::store {

/// One server's. After the first failure it is away, and asked again after a second, then two, a minute at most;
/// failures that follow soon after an answer go on where the ones before have ended. Any thread; `begun` and `now` are
/// when a request began, and when its outcome was known.
class Outage {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kFirstRest{1}, kLongestRest{60};

  enum class Look { there, away, find_out };
  /// find_out: it is away, and the caller is the one who asks it again, and says how that went.
  Look look(Clock::time_point now);
  /// Whether that is to be told: once an outage, and no more than once a minute.
  bool failed(Clock::time_point begun, Clock::time_point now);
  /// Whether that is to be told: the end of an outage that was.
  bool answered(Clock::time_point begun, Clock::time_point now);
  /// Who was to find out has not.
  void gaveUp();

 private:
  std::mutex mutex_;
  bool is_away_ = false, is_asked_ = false, is_told_ = false, was_ever_told_ = false;
  std::chrono::seconds rest_{0};  ///< of the last outage
  Clock::time_point until_, failed_at_, answered_at_, told_at_;
};

}  // namespace sgm::store
