#pragma once
// A number that is computed only if somebody asks for it.

#include <atomic>
#include <cstdint>

namespace sgm {

/// Keeps the number of its first request. A copy begins without one. Thread-safe: threads that ask concurrently may
/// compute it several times, and must get the same.
class LazyNumber {
 public:
  LazyNumber() = default;
  LazyNumber(const LazyNumber&) {}
  LazyNumber& operator=(const LazyNumber&) {
    value_.store(0, std::memory_order_relaxed);
    return *this;
  }

  /// compute: gives the number, which is computed at each request if it is 0.
  template <class Compute>
  uint64_t get(const Compute& compute) const {
    uint64_t value = value_.load(std::memory_order_relaxed);
    if (value == 0) value_.store(value = compute(), std::memory_order_relaxed);
    return value;
  }

 private:
  mutable std::atomic<uint64_t> value_{0};
};

}  // namespace sgm
