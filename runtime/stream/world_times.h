#pragma once
// How long a world's work takes, each time: what an average hides is what a player sees.

#include <array>
#include <cmath>
#include <cstdint>

#include "world/chunk_key.h"

namespace sgm {

/// Seconds. counts[i] are those above 2^(i - 17) and up to 2^(i - 16); the first ones too that took less, the last
/// ones too that took more.
struct TimeHistogram {
  static constexpr int kBuckets = 21, kFirstExponent = -16;

  std::array<uint64_t, kBuckets> counts{};
  double sum = 0, longest = 0;

  void add(double seconds) {
    int bucket = 0;
    while (bucket + 1 < kBuckets && seconds > std::ldexp(1.0, bucket + kFirstExponent)) ++bucket;
    ++counts[static_cast<size_t>(bucket)];
    sum += seconds;
    longest = seconds > longest ? seconds : longest;
  }
};

struct WorldTimes {
  TimeHistogram update, poll;                     ///< calls, with their wait for each other
  std::array<TimeHistogram, kMaxLevel + 1> mesh;  ///< of bodies by level; of a batch each has an equal share
  TimeHistogram read;                             ///< of bodies that came from disk or from far, likewise
  double clock_seconds = 0;                       ///< in which jobs meshed or read chunks
  double job_seconds = 0;                         ///< likewise, times how many jobs they were
};

}  // namespace sgm
