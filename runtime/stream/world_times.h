#pragma once
// Durations of a world's work as histograms: averages would hide the peaks that a player notices.

#include <array>
#include <cmath>
#include <cstdint>

#include "world/chunk_key.h"

namespace sgm {

/// Seconds. counts[i] has the durations above 2^(i - 17) and up to 2^(i - 16); the first bucket also has shorter ones,
/// the last bucket also longer ones.
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
  TimeHistogram update, poll;                     ///< calls, including the wait for each other
  std::array<TimeHistogram, kMaxLevel + 1> mesh;  ///< of bodies by level; each chunk of a batch has an equal share
  TimeHistogram read;                             ///< of bodies from the disk or a server, in equal shares
  double clock_seconds = 0;                       ///< time during which jobs meshed or read chunks
  double job_seconds = 0;                         ///< the same, multiplied by the number of these jobs
};

}  // namespace sgm
