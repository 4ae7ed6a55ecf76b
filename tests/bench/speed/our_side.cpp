// Benchmarks one stage of our library per process. speed.mjs runs this program and those of the other libraries. See
// ../README.md.
//
//   sgm_bench_ours write SCENE CELLS FILE            writes the scene's samples to a file, which all programs read
//   sgm_bench_ours grid FILE THREADS RUNS            measures sgm_surface_from_grid, with normals
//   sgm_bench_ours grid-plain FILE THREADS RUNS      measures sgm_surface_from_grid, without normals
//   sgm_bench_ours mesh SCENE CELLS THREADS RUNS     measures sgm_mesh_chunks, with cells derived beforehand
//   sgm_bench_ours region SCENE CELLS THREADS RUNS   measures sgm_surface_from_region, which makes one welded mesh
//   sgm_bench_ours chunk SCENE CELLS RUNS LEVEL      meshes chunks with a surface one by one, from derived cells
//   sgm_bench_ours grid-chunks FILE RUNS             meshes blocks of 32^3 cells in cache one by one, without normals
//
// SGM_BENCH_SET=avx2 (or sse4.2) keeps the library from using wider vectors.

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

/// Makes Highway behave as if this processor had no wider vectors. The library uses the same copy of Highway.
void limitVectors() {
  const char* set = std::getenv("SGM_BENCH_SET");
  if (set == nullptr) return;
#if defined(SGM_BENCH_HIGHWAY) && defined(__x86_64__)
  const int64_t here = hwy::SupportedTargets(), avx3 = HWY_AVX3 | HWY_AVX3_DL;
  if (std::string_view(set) == "avx2") return hwy::SetSupportedTargetsForTest(here & ~avx3);
  if (std::string_view(set) == "sse4.2") return hwy::SetSupportedTargetsForTest(here & ~(avx3 | HWY_AVX2));
#endif
  throw std::runtime_error(std::string("SGM_BENCH_SET knows no ") + set + " here");
}

/// Returns the number of ambiguous faces. A face is a square of four adjacent samples; it is ambiguous if one diagonal
/// pair is solid and the other pair is empty. Meshing algorithms connect the surface differently there, so for each
/// ambiguous face the genus of their surfaces may differ by one.
size_t ambiguousFaces(const Grid& grid) {
  size_t count = 0;
  const auto nx = static_cast<size_t>(grid.size[0]), ny = static_cast<size_t>(grid.size[1]);
  const size_t steps[3] = {1, nx, nx * ny};
  for (int32_t z = 0; z < grid.size[2]; ++z) {
    for (int32_t y = 0; y < grid.size[1]; ++y) {
      for (int32_t x = 0; x < grid.size[0]; ++x) {
        const int32_t place[3] = {x, y, z};
        const float* at =
            &grid.values[static_cast<size_t>(x) + nx * (static_cast<size_t>(y) + ny * static_cast<size_t>(z))];
        for (size_t u = 0; u < 3; ++u) {
          const size_t v = (u + 1) % 3;
          if (place[u] + 1 == grid.size[u] || place[v] + 1 == grid.size[v]) continue;
          const bool a = at[0] < 0, b = at[steps[u]] < 0, c = at[steps[v]] < 0, d = at[steps[u] + steps[v]] < 0;
          count += a == d && b == c && a != b;
        }
      }
    }
  }
  return count;
}

int gridStage(const char* file, int threads, int runs, bool normals) {
  const Grid grid = readGrid(file);
  Ours ours(threads);
  const Times times = timed(2, runs, [&] { ours.meshGrid(grid, normals); });
  printTimes(normals ? "grid" : "grid-plain", times);
  printShape(measure(ours.gridMesh(grid), grid.size[0] - 1));
  std::printf(" ambiguous=%zu set=%s\n", ambiguousFaces(grid), ours.device().c_str());
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

int regionStage(const Scene& scene, int cells, int threads, int runs) {
  Ours ours(scene, cells, threads);
  const Times times = timed(1, runs, [&] { ours.meshRegion(); });
  printTimes("region", times);
  std::printf(" set=%s\n", ours.device().c_str());
  return 0;
}

/// Prints the median time per chunk of each run. chunks(): returns the milliseconds of each chunk.
template <class Chunks>
int medianChunk(const char* stage, Ours& ours, int runs, const Chunks& chunks) {
  chunks();
  std::vector<double> medians;
  size_t count = 0;
  for (int i = 0; i < runs; ++i) {
    const std::vector<double> times = chunks();
    if (times.empty()) throw std::runtime_error("no chunk has a surface");
    count = times.size();
    medians.push_back(statistics(times).median);
  }
  printTimes(stage, statistics(medians));
  std::printf(" chunks=%zu set=%s\n", count, ours.device().c_str());
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
  if (is("region", 4)) {
    const int cells = std::atoi(argv[3]), threads = std::atoi(argv[4]);
    pin(threads);
    return regionStage(makeScene(argv[2], cells, SGM_BENCH_CAVE), cells, threads, std::atoi(argv[5]));
  }
  if (is("chunk", 4)) {
    pin(1);
    const int cells = std::atoi(argv[3]), level = std::atoi(argv[5]);
    Ours ours(makeScene(argv[2], cells, SGM_BENCH_CAVE), cells, 1);
    return medianChunk("chunk", ours, std::atoi(argv[4]), [&] { return ours.surfaceChunks(level); });
  }
  if (is("grid-chunks", 2)) {
    pin(1);
    const Grid grid = readGrid(argv[2]);
    Ours ours(1);
    return medianChunk("grid-chunks", ours, std::atoi(argv[3]), [&] { return ours.gridChunks(grid); });
  }
  std::fprintf(stderr, "usage: the head of tests/bench/speed/our_side.cpp\n");
  return 2;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_ours: error: %s\n", e.what());
  return 1;
}
