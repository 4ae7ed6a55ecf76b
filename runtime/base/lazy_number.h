#pragma once
// A number that is computed on its first use.

#include <atomic>
#include <cstdint>

namespace sgm {

/// Computes a number at the first request and keeps it for later requests. A copy of the object begins without the
/// number. Thread-safe: several threads may compute the number concurrently, and must get the same result.
class LazyNumber {
 public:
  LazyNumber() = default;
  LazyNumber(const LazyNumber&) {}
  LazyNumber& operator=(const LazyNumber&) {
    value_.store(0, std::memory_order_relaxed);
    return *this;
  }

  /// compute: returns the number. A result of 0 is not cached, so it is computed again at each request.
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
