// Compares the time to measure chunks with the time to mesh them. Each chunk is measured right after it was meshed, as
// in a streamed world. Uses one thread, places in several sample grammars, three levels of detail, and for each chunk a
// seam to a coarser neighbour below it. Prints medians over runs.
//
//   sgm_bench_chunk_measures FOLDER-OF-SAMPLE-GRAMMARS [RUNS]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "backend/open/open_backend.h"
#include "chunk/mesh_chunks.h"
#include "grammar/compile.h"
#include "measure.h"
#include "measure/measure_chunk.h"

namespace {

using namespace sgm;
using namespace sgm::measure;

struct Place {
  const char* grammar;
  int32_t cell;
  Int3 at;  ///< centre of the meshed chunks in metres
  bool sharp;
};
constexpr int kAround = 2;  ///< number of chunks in each direction from the centre

struct Times {
  double meshing = 0, measuring = 0;
  SurfaceSums sums;
};

Result<Times> run(const WorldField& world, Backend& backend, JobSystem& jobs, const Place& place,
                  MeasureScratch& scratch) {
  Times times;
  for (int level = 0; level < 3; ++level) {
    const int64_t edge = int64_t{kChunkCells} * place.cell << level;
    for (int i = 0; i < (2 * kAround) * (2 * kAround) * (2 * kAround); ++i) {
      ChunkRequest request;
      request.key.level = level;
      for (int axis = 0; axis < 3; ++axis) {
        const int step = (axis == 0 ? i : axis == 1 ? i / (2 * kAround) : i / (4 * kAround * kAround)) % (2 * kAround);
        request.key.at[axis] =
            static_cast<int32_t>(floorDiv(int64_t{place.at[axis]} * kUnitsPerMetre, edge)) + step - kAround;
      }
      request.seams = 1 << static_cast<int>(Face::y_lo);
      request.signs = level == 0;
      request.sharp = place.sharp;
      const double start = bench::now();
      const auto chunks = meshChunks(world, backend, jobs, {&request, 1});
      if (!chunks) return chunks.error();
      const double meshed = bench::now();
      const PlacedChunk& chunk = chunks->front();
      ChunkMeasures measures;
      measureBody(viewOf(chunk.mesh.body), chunk.mesh.signs, scratch, measures);
      for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) {
        measures.parts[1 + face] = measureSeam(viewOf(chunk.mesh.seams[face]));
      }
      times.measuring += bench::now() - meshed;
      times.meshing += meshed - start;
      times.sums.add(measures, chunk.grid, true, request.seams);
    }
  }
  return times;
}

int fail(const std::string& message) {
  std::fprintf(stderr, "sgm_bench_chunk_measures: %s\n", message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return fail("usage: sgm_bench_chunk_measures FOLDER-OF-SAMPLE-GRAMMARS [RUNS]");
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  bench::pin(1);
  const auto jobs = makeThreadPool(1);
  if (!jobs) return fail(jobs.error().message);
  const auto backend = makeBackend({}, **jobs, std::pmr::get_default_resource());
  if (!backend) return fail(backend.error().message);
  const Place places[] = {{"cave.sgm", 256, {112, 96, 96}, false},
                          {"city.sgm", 256, {40, 8, 40}, false},
                          {"terrain.sgm", 256, {0, 0, 0}, false},
                          {"cloud.sgm", 4096, {450, 1200, 450}, false},
                          {"building.sgm", 256, {0, 8, 0}, true}};
  MeasureScratch scratch(std::pmr::get_default_resource());
  std::printf("%-14s %9s %10s %10s %10s %7s %9s\n", "grammar", "chunks", "triangles", "meshing ms", "measure ms",
              "share", "ns/triangle");
  for (const Place& place : places) {
    std::ifstream file(std::string(argv[1]) + "/" + place.grammar);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const CompileResult compiled = compileGrammar(text, place.grammar);
    if (!file || !compiled.program) return fail(std::string("cannot read or compile ") + place.grammar);
    WorldFieldSettings settings;
    settings.program = compiled.program;
    settings.parameters = ParameterValues::defaults(*compiled.program);
    settings.seed = 3;
    settings.finest_cell = place.cell;
    std::vector<double> meshing, measuring, shares;
    SurfaceSums sums;
    for (int i = 0; i < runs; ++i) {
      const WorldField world(settings, std::pmr::get_default_resource());
      const Result<Times> times = run(world, **backend, **jobs, place, scratch);
      if (!times) return fail(times.error().message);
      meshing.push_back(times->meshing);
      measuring.push_back(times->measuring);
      shares.push_back(100 * times->measuring / times->meshing);
      sums = times->sums;
    }
    const double median = bench::statistics(measuring).median;
    std::printf("%-14s %9llu %10llu %10.1f %10.2f %6.2f%% %9.1f\n", place.grammar,
                static_cast<unsigned long long>(sums.bodies), static_cast<unsigned long long>(sums.triangles),
                bench::statistics(meshing).median, median, bench::statistics(shares).median,
                1e6 * median / static_cast<double>(sums.triangles));
    for (size_t kind = 0; kind < kDefects; ++kind) {
      if (sums.defects[kind] == 0) continue;
      std::printf("  %llu %s\n", static_cast<unsigned long long>(sums.defects[kind]),
                  defectName(static_cast<Defect>(kind)));
    }
  }
  return 0;
}
