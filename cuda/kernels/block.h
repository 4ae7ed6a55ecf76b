#pragma once
// The programming model of kernels: a block of threads runs phases, with scans between them.
//
// A kernel is a class with the constant kThreads, the plain struct Shared, and
//   template <class Block> SGM_KERNEL static void run(Block& block, const Batch& batch, Shared& shared);
// Within run(), all code outside of a phase gives the same result in all threads of the block. block.each(f) is a
// phase: it calls f(thread) for each thread, in any order, and all calls have ended before the next line. So a phase is
// a plain function without a barrier, and the same source runs on a GPU as threads, and on the CPU as a loop. Data that
// threads of one phase write may be read by other threads only in a later phase; writes to the same place must use the
// functions below.

#include <bit>
#include <cstdint>

#include "base/kernel.h"

namespace sgm::cuda {

/// Adds to a sum atomically; returns the previous value.
SGM_KERNEL uint32_t addTo(uint32_t& sum, uint32_t by) {
#ifdef __CUDA_ARCH__
  return atomicAdd(&sum, by);
#else
  const uint32_t before = sum;
  sum += by;
  return before;
#endif
}

/// Adds to a sum atomically. Values are two's complement and may be negative.
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

/// Returns the index of the lowest set bit. Precondition: a bit is set.
SGM_KERNEL uint32_t lowestOf(uint64_t bits) {
#ifdef __CUDA_ARCH__
  return static_cast<uint32_t>(__ffsll(static_cast<long long>(bits)) - 1);
#else
  return static_cast<uint32_t>(std::countr_zero(bits));
#endif
}

/// Returns the last index whose value is at most `value`. The values must ascend, and the first one be at most `value`.
SGM_KERNEL uint32_t lastAtMost(const uint32_t* values, uint32_t count, uint32_t value) {
  uint32_t lo = 0, hi = count;
  while (hi - lo > 1) {
    const uint32_t middle = (lo + hi) / 2;
    (values[middle] <= value ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace sgm::cuda
