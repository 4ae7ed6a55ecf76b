// Our side of the benchmark, one stage a process: speed.mjs runs it beside the peers. See ../README.md.
//
//   sgm_bench_ours write SCENE CELLS FILE            the scene's samples, for every side
//   sgm_bench_ours grid FILE THREADS RUNS            sgm_surface_from_grid, with normals
//   sgm_bench_ours grid-plain FILE THREADS RUNS      without
//   sgm_bench_ours mesh SCENE CELLS THREADS RUNS     sgm_mesh_chunks, cells derived before
//   sgm_bench_ours chunk SCENE CELLS RUNS            one surface chunk of it after the other
//
// SGM_BENCH_SET=avx2 (or sse4.2) keeps the library from wider vectors.

#ifdef SGM_BENCH_HIGHWAY
#include <hwy/targets.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "answer.h"
#include "ours.h"

namespace {

using namespace bench;

/// As if this processor had no more. The library asks the same copy of Highway.
void limitVectors() {
  const char* set = std::getenv("SGM_BENCH_SET");
  if (set == nullptr) return;
#if defined(SGM_BENCH_HIGHWAY) && defined(__x86_64__)
  const int64_t here = hwy::SupportedTargets(), avx3 = HWY_AVX3 | HWY_AVX3_DL;
  if (std::string_view(set) == "avx2") return hwy::SetSupportedTargetsForTest(here & ~avx3);
  if (std::string_view(set) == "sse4.2") return hwy::SetSupportedTargetsForTest(here & ~(avx3 | HWY_AVX2));
  if (std::string_view(set) == "avx512") return;
#endif
  throw std::runtime_error(std::string("SGM_BENCH_SET knows no ") + set + " here");
}


int gridStage(const char* file, int threads, int runs, bool normals) {
  const Grid grid = readGrid(file);
  Ours ours(threads);
  const Times times = timed(2, runs, [&] { ours.meshGrid(grid, normals); });
  printTimes(normals ? "grid" : "grid-plain", times);
  printShape(measure(ours.gridMesh(grid), grid.size[0] - 1));
  std::printf(" set=%s\n", ours.device().c_str());
  return 0;
}

int meshStage(const Scene& scene, int cells, int threads, int runs) {
  Ours ours(scene, cells, threads);
  const double start = now();
  const size_t triangles = ours.meshChunks();
  const double first = now() - start;
  const Times times = timed(1, runs, [&] { ours.meshChunks(); });
  printTimes("mesh", times);
  std::printf(" first=%.6f drawn=%zu", first, triangles);
  printShape(measure(ours.welded(), cells));
  std::printf(" set=%s\n", ours.device().c_str());
  return 0;
}

int chunkStage(const Scene& scene, int cells, int runs) {
  Ours ours(scene, cells, 1);
  ours.meshChunks();
  std::vector<double> medians;
  size_t chunks = 0;
  for (int i = 0; i < runs; ++i) {
    const std::vector<double> times = ours.surfaceChunks();
    chunks = times.size();
    medians.push_back(statistics(times).median);
  }
  printTimes("chunk", statistics(medians));
  std::printf(" chunks=%zu set=%s\n", chunks, ours.device().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  limitVectors();
  const auto is = [&](const char* stage, int arguments) {
    return argc == 2 + arguments && std::strcmp(argv[1], stage) == 0;
  };
  if (is("write", 3)) {
    const int cells = std::atoi(argv[3]);
    Ours ours(makeScene(argv[2], cells, SGM_BENCH_CAVE), cells, 0);
    writeGrid(argv[4], ours.sample());
    return 0;
  }
  if (is("grid", 3) || is("grid-plain", 3)) {
    pin(std::atoi(argv[3]));
    return gridStage(argv[2], std::atoi(argv[3]), std::atoi(argv[4]), is("grid", 3));
  }
  if (is("mesh", 4)) {
    const int cells = std::atoi(argv[3]), threads = std::atoi(argv[4]);
    pin(threads);
    return meshStage(makeScene(argv[2], cells, SGM_BENCH_CAVE), cells, threads, std::atoi(argv[5]));
  }
  if (is("chunk", 3)) {
    const int cells = std::atoi(argv[3]);
    pin(1);
    return chunkStage(makeScene(argv[2], cells, SGM_BENCH_CAVE), cells, std::atoi(argv[4]));
  }
  std::fprintf(stderr, "usage: the head of tests/bench/speed/our_side.cpp\n");
  return 2;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_ours: error: %s\n", e.what());
  return 1;
}
