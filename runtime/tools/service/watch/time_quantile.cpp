#include "tools/service/watch/time_quantile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace sgm::service {

double upperBound(int bucket) {
  if (bucket + 1 >= SGM_TIME_BUCKETS) return std::numeric_limits<double>::infinity();
  return std::ldexp(1.0, bucket + SGM_TIME_FIRST_EXPONENT);
}

uint64_t countOf(const sgm_time_histogram& times) {
  return std::accumulate(std::begin(times.counts), std::end(times.counts), uint64_t{0});
}

double quantile(const sgm_time_histogram& times, double share) {
  const auto wanted = static_cast<double>(countOf(times)) * share;
  double below = 0;
  for (int bucket = 0; bucket < SGM_TIME_BUCKETS; ++bucket) {
    const auto here = static_cast<double>(times.counts[bucket]);
    if (here > 0 && below + here >= wanted) {
      const double low = bucket == 0 ? 0 : upperBound(bucket - 1), high = std::min(upperBound(bucket), times.longest);
      return std::min(times.longest, low + (std::max(high, low) - low) * (wanted - below) / here);
    }
    below += here;
  }
  return below > 0 ? times.longest : 0;
}

}  // namespace sgm::service
