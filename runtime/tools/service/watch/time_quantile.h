#pragma once
// Quantiles of histograms of durations.

#include <sgm/sgm.h>

#include <cstdint>

namespace sgm::service {

/// The upper bound of a bucket in seconds; infinity for the last bucket.
double upperBound(int bucket);
/// The number of durations in the histogram.
uint64_t countOf(const sgm_time_histogram& times);
/// The duration in seconds below which `share` (0..1) of all durations lie: interpolated within a bucket, and at most
/// the longest duration. 0 if the histogram is empty.
double quantile(const sgm_time_histogram& times, double share);

}  // namespace sgm::service
