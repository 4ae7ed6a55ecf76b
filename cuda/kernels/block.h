#pragma once
// The programming model of kernels: a block of threads runs phases, with prefix sums (scans) between them.
//
// A kernel is a class with the constant kThreads, the plain struct Shared, and
//   template <class Block> SGM_KERNEL static void run(Block& block, const Batch& batch, Shared& shared);
// Within run(), code outside of a phase is executed by every thread of the block with the same result. block.each(f) is
// a phase: it calls f(thread) for each thread number, in any order; all calls have ended before the next line. A phase
// thus needs no explicit barrier, and the same source runs as threads on a GPU and as a loop on the CPU. Data written
// in one phase may be read by other threads only in a later phase. Concurrent writes to the same address must use the
// atomic functions below.

#include <bit>
#include <cstdint>

#include "base/kernel.h"

namespace sgm::cuda {

/// Adds `by` to `sum` atomically; returns the previous value.
SGM_KERNEL uint32_t addTo(uint32_t& sum, uint32_t by) {
#ifdef __CUDA_ARCH__
  return atomicAdd(&sum, by);
#else
  const uint32_t before = sum;
  sum += by;
  return before;
#endif
}

/// Adds `by` to `sum` atomically. The values may be negative numbers in two's complement.
SGM_KERNEL void addTo(uint64_t& sum, uint64_t by) {
#ifdef __CUDA_ARCH__
  atomicAdd(reinterpret_cast<unsigned long long*>(&sum), static_cast<unsigned long long>(by));
#else
  sum += by;
#endif
}

SGM_KERNEL void raiseTo(uint32_t& most, uint32_t value) {
#ifdef __CUDA_ARCH__
  atomicMax(&most, value);
#else
  if (value > most) most = value;
#endif
}

SGM_KERNEL void setBits(uint64_t& word, uint64_t bits) {
#ifdef __CUDA_ARCH__
  atomicOr(reinterpret_cast<unsigned long long*>(&word), static_cast<unsigned long long>(bits));
#else
  word |= bits;
#endif
}

SGM_KERNEL uint32_t countOf(uint64_t bits) {
#ifdef __CUDA_ARCH__
  return static_cast<uint32_t>(__popcll(bits));
#else
  return static_cast<uint32_t>(std::popcount(bits));
#endif
}

/// Returns the index of the lowest set bit. Precondition: at least one bit is set.
SGM_KERNEL uint32_t lowestOf(uint64_t bits) {
#ifdef __CUDA_ARCH__
  return static_cast<uint32_t>(__ffsll(static_cast<long long>(bits)) - 1);
#else
  return static_cast<uint32_t>(std::countr_zero(bits));
#endif
}

/// Binary search: returns the last index whose element is at most `value`. Requires ascending elements, the first of
/// which is at most `value`.
SGM_KERNEL uint32_t lastAtMost(const uint32_t* values, uint32_t count, uint32_t value) {
  uint32_t lo = 0, hi = count;
  while (hi - lo > 1) {
    const uint32_t middle = (lo + hi) / 2;
    (values[middle] <= value ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace sgm::cuda
