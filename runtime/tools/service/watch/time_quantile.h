#pragma once
// Computes quantiles of a histogram of times.

#include <sgm/sgm.h>

#include <cstdint>

namespace sgm::service {

/// The upper bound of bucket i in seconds; infinity for the last bucket.
double upperBound(int bucket);
/// The number of times in the histogram.
uint64_t countOf(const sgm_time_histogram& times);
/// The quantile of the times in seconds for a share from 0 to 1: interpolated within its bucket, and at most the
/// longest time. 0 if the histogram is empty.
double quantile(const sgm_time_histogram& times, double share);

}  // namespace sgm::service
