#pragma once
// Quantiles of a histogram of times.

#include <sgm/sgm.h>

#include <cstdint>

namespace sgm::service {

/// The longest time that bucket i counts, in seconds; of the last one an infinity.
double upperBound(int bucket);
/// How many it has counted.
uint64_t countOf(const sgm_time_histogram& times);
/// The time that a share of them (0 to 1) kept within, in seconds: interpolated within its bucket, and never more than
/// the longest. 0 where nothing was counted.
double quantile(const sgm_time_histogram& times, double share);

}  // namespace sgm::service
