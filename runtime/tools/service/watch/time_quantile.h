#pragma once
// Quantiles of a histogram of times.

#include <sgm/sgm.h>

#include <cstdint>

namespace sgm::service {

/// The longest time in bucket i, in seconds; infinity for the last one.
double upperBound(int bucket);
/// The number of times.
uint64_t countOf(const sgm_time_histogram& times);
/// The time within which a share of them (0 to 1) stayed, in seconds: interpolated in its bucket, and at most the
/// longest time. 0 without times.
double quantile(const sgm_time_histogram& times, double share);

}  // namespace sgm::service
