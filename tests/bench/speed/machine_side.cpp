// Measures lower bounds of time on this machine, in the same run as the benchmarks, so that their times can be compared
// with these bounds.
//
//   sgm_bench_machine signs GRID THREADS RUNS     reads every sample's sign in one pass
//   sgm_bench_machine output BYTES THREADS RUNS   writes BYTES bytes once
//   sgm_bench_machine float THREADS RUNS          computes products and sums, without fused multiply-add
//   sgm_bench_machine brute CELLS THREADS RUNS    evaluates every blob at every sample of the scene `blobs`

#include <atomic>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

#include "answer.h"
#include "grid_file.h"
#include "scene.h"

namespace {

using namespace bench;

/// Divides 0..count into equal parts, one for each thread, and calls work(first, last) for each part. The calling
/// thread is one of the threads.
template <class Work>
void shared(int threads, size_t count, const Work& work) {
  std::vector<std::thread> others;
  const auto t = static_cast<size_t>(threads);
  for (size_t i = 1; i < t; ++i) others.emplace_back(work, count * i / t, count * (i + 1) / t);
  work(size_t{0}, count / t);
  for (std::thread& other : others) other.join();
}

Times signs(const Grid& grid, int threads, int runs) {
  std::atomic<uint32_t> kept = 0;
  return timed(2, runs, [&] {
    shared(threads, grid.values.size(), [&](size_t first, size_t last) {
      uint32_t count = 0;
      for (size_t i = first; i < last; ++i) count += std::bit_cast<uint32_t>(grid.values[i]) >> 31;
      kept.store(count, std::memory_order_relaxed);
    });
  });
}

Times output(size_t bytes, int threads, int runs) {
  std::vector<char> memory(bytes);
  char value = 0;
  return timed(2, runs, [&] {
    ++value;
    shared(threads, bytes, [&](size_t first, size_t last) { std::memset(memory.data() + first, value, last - first); });
  });
}

constexpr size_t kChains = 128;  // number of independent chains of operations, so that latency does not limit the rate
constexpr size_t kRounds = 200000;

Times floats(int threads, int runs) {
  std::atomic<float> kept = 0;
  return timed(1, runs, [&] {
    shared(threads, static_cast<size_t>(threads), [&](size_t, size_t) {
      float x[kChains];
      for (size_t i = 0; i < kChains; ++i) x[i] = static_cast<float>(i);
      for (size_t round = 0; round < kRounds; ++round)
        for (size_t i = 0; i < kChains; ++i) x[i] = x[i] * 0.999f + 0.5f;
      float sum = 0;
      for (const float value : x) sum += value;
      kept.store(sum, std::memory_order_relaxed);
    });
  });
}

/// The scene `blobs` for an evaluator written by hand: the field is the sum of (1 - d^2 / R^2)^3 over all blobs within
/// R = 2 r, so that a single blob's surface has the radius r. Centres are relative to the cube's middle, in units of a
/// cell.
struct Blobs {
  std::vector<float> x, y, z, scale;  ///< scale: 1 / R^2
};
Blobs blobsIn(int cells) {
  Blobs blobs;
  const float cell = 65536.0f / static_cast<float>(cells);
  for (uint64_t i = 0; i < kBlobs; ++i) {
    const Ball b = blobAt(i);
    const float support = 2.0f * static_cast<float>(b.radius) / cell;
    blobs.x.push_back(static_cast<float>(b.centre[0]) / cell);
    blobs.y.push_back(static_cast<float>(b.centre[1]) / cell);
    blobs.z.push_back(static_cast<float>(b.centre[2]) / cell);
    blobs.scale.push_back(1.0f / (support * support));
  }
  return blobs;
}

/// Computes N consecutive samples of a row, from x on. The N sums stay in registers during the loop over the blobs.
template <size_t N>
void samplesOf(const Blobs& blobs, float x, float y, float z, float* out) {
  float place[N], sum[N];
  for (size_t i = 0; i < N; ++i) {
    place[i] = x + static_cast<float>(static_cast<int>(i));
    sum[i] = 0;
  }
  for (size_t k = 0; k < blobs.x.size(); ++k) {
    const float dy = y - blobs.y[k], dz = z - blobs.z[k], scale = -blobs.scale[k];
    const float rest = std::fma(std::fma(dy, dy, dz * dz), scale, 1.0f);
    for (size_t i = 0; i < N; ++i) {
      const float dx = place[i] - blobs.x[k], t = std::fma(dx * dx, scale, rest), inside = t > 0 ? t : 0;
      sum[i] = std::fma(inside * inside, inside, sum[i]);
    }
  }
  for (size_t i = 0; i < N; ++i) out[i] = 0.421875f - sum[i];
}

Times brute(int cells, int threads, int runs, double& solid) {
  const Blobs blobs = blobsIn(cells);
  const auto side = static_cast<size_t>(cells) + 1;
  std::vector<float> values(side * side * side);
  const Times times = timed(1, runs, [&] {
    shared(threads, side, [&](size_t first, size_t last) {
      const float low = -0.5f * static_cast<float>(cells);
      for (size_t row = first * side; row < last * side; ++row) {
        const float y = low + static_cast<float>(row % side), z = low + static_cast<float>(row / side);
        float* out = values.data() + row * side;
        size_t x = 0;
        for (; x + 64 <= side; x += 64) samplesOf<64>(blobs, low + static_cast<float>(x), y, z, out + x);
        for (; x < side; ++x) samplesOf<1>(blobs, low + static_cast<float>(x), y, z, out + x);
      }
    });
  });
  size_t count = 0;
  for (const float v : values) count += v < 0;
  solid = static_cast<double>(count) / static_cast<double>(values.size());
  return times;
}

}  // namespace

int main(int argc, char** argv) try {
  const auto is = [&](const char* what, int arguments) {
    return argc == 2 + arguments && std::strcmp(argv[1], what) == 0;
  };
  const int threads = argc > 3 ? std::atoi(argv[argc - 2]) : 1, runs = argc > 3 ? std::atoi(argv[argc - 1]) : 1;
  pin(threads);
  if (is("signs", 3)) {
    const Grid grid = readGrid(argv[2]);
    printTimes("signs", signs(grid, threads, runs));
  } else if (is("output", 3)) {
    printTimes("output", output(std::strtoull(argv[2], nullptr, 10), threads, runs));
  } else if (is("float", 2)) {
    const Times times = floats(threads, runs);
    printTimes("float", times);
    std::printf(" gflops=%.2f",
                2e-6 * static_cast<double>(kChains * kRounds * static_cast<size_t>(threads)) / times.median);
  } else if (is("brute", 3)) {
    double solid = 0;
    printTimes("brute", brute(std::atoi(argv[2]), threads, runs, solid));
    std::printf(" solid=%.6f", solid);
  } else {
    std::fprintf(stderr, "usage: the head of tests/bench/speed/machine_side.cpp\n");
    return 2;
  }
  std::printf("\n");
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_machine: error: %s\n", e.what());
  return 1;
}
