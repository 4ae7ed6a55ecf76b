#pragma once
// Histograms of the durations of a world's operations; averages would hide the peaks that players notice.

#include <array>
#include <cmath>
#include <cstdint>

#include "world/chunk_key.h"

namespace sgm {

/// A histogram of durations in seconds. counts[i] counts durations above 2^(i - 17) and up to 2^(i - 16); the first
/// element also counts shorter durations, the last one also longer ones.
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
  /// durations of calls of update() and of poll(), including the time that a call waits for a call of the other
  /// function
  TimeHistogram update, poll;
  /// time to mesh a body, by level; the time of a batch is divided equally among its chunks
  std::array<TimeHistogram, kMaxLevel + 1> mesh;
  /// time to read a body from the disk or a server; the time of a batch is divided equally among its chunks
  TimeHistogram read;
  double clock_seconds = 0;  ///< seconds during which at least one job meshed or read chunks
  double job_seconds = 0;    ///< seconds that jobs spent on meshing or reading chunks, summed over all jobs
};

}  // namespace sgm
