// Compares the backend of a device with the CPU's: both mesh the chunks around a viewer in the sample cave, in turn.
//
//   sgm_bench_backends [GRAMMAR [CELL_UNITS [THREADS [vulkan | cuda]]]]
//
// Software Vulkan takes its number of threads from LP_NUM_THREADS: set it to THREADS too.

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "backend/open/open_backend.h"
#include "cave.h"
#include "chunk/mesh_chunks.h"
#include "measure.h"

using namespace sgm;
using bench::must, bench::now;

namespace {

constexpr int kRuns = 5;
constexpr size_t kBatchChunks = 256;  // number of chunks per batch of a device
std::pmr::memory_resource* const heap = std::pmr::get_default_resource();

std::vector<ChunkJob> jobsAround(const WorldField& world) {
  std::vector<ChunkJob> jobs;
  for (const ChunkRequest& request : bench::aroundViewer(world.settings().finest_cell)) {
    jobs.push_back(bench::jobOf(world, request));
  }
  return jobs;
}

struct Run {
  double whole = 0, submitting = 0;  ///< ms
  size_t triangles = 0, with_surface = 0;
  ContentHash hash;  ///< sum of the content hashes of all mesh parts
};

Run meshAll(Backend& backend, const std::vector<ChunkJob>& jobs) {
  Run run;
  const double start = now();
  for (size_t first = 0; first < jobs.size(); first += kBatchChunks) {
    const auto begin = jobs.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = static_cast<std::ptrdiff_t>(std::min(kBatchChunks, jobs.size() - first));
    const double before = now();
    auto batch = must(backend.submit({begin, begin + count}));
    run.submitting += now() - before;
    batch->wait();
    for (const ChunkMesh& mesh : must(batch->take())) {
      const auto add = [&run](const MeshPart& part) {
        run.triangles += part.indices.size() / 3;
        run.hash.a += part.hash.a;
        run.hash.b += part.hash.b;
      };
      run.with_surface += mesh.body.indices.empty() ? 0u : 1u;
      add(mesh.body);
      for (const MeshPart& seam : mesh.seams) add(seam);
    }
  }
  run.whole = now() - start;
  return run;
}

BackendKind kindOf(const std::string& name) {
  if (name == "vulkan") return BackendKind::vulkan;
  if (name == "cuda") return BackendKind::cuda;
  throw std::runtime_error("the backend is vulkan or cuda, not " + name);
}

void compare(const char* path, int32_t cell, unsigned threads, const std::string& name) {
  WorldFieldSettings settings = bench::settingsOf(path, 3);
  settings.finest_cell = cell;
  const WorldField world(settings, heap);
  const std::vector<ChunkJob> jobs = jobsAround(world);
  const auto pool = must(makeThreadPool(threads));
  BackendRequest request;
  const auto cpu = must(makeBackend(request, *pool, heap));
  request.kind = kindOf(name);
  const auto device = must(makeBackend(request, *pool, heap));
  const Run first = meshAll(*device, jobs);
  std::printf("%s, %u threads | %s\n", cpu->capabilities().device.c_str(), threads,
              device->capabilities().device.c_str());
  std::printf("%zu chunks, %zu with a surface, %zu triangles; the first time, all made ready: %.0f ms\n", jobs.size(),
              first.with_surface, first.triangles, first.whole);
  Run best_cpu, best_device;
  for (int i = 0; i < kRuns; ++i) {
    const Run a = meshAll(*cpu, jobs), b = meshAll(*device, jobs);
    if (a.hash != b.hash || a.triangles != b.triangles) throw std::runtime_error("the meshes differ");
    if (i == 0 || a.whole < best_cpu.whole) best_cpu = a;
    if (i == 0 || b.whole < best_device.whole) best_device = b;
  }
  const BackendCounters counters = device->counters();
  std::printf(
      "best of %d: CPU %.1f ms, %s %.1f ms (%.2f times the CPU; %.0f chunks with a surface a second), %.2f %% of it in "
      "submit; by the CPU %llu\n",
      kRuns, best_cpu.whole, name.c_str(), best_device.whole, best_device.whole / best_cpu.whole,
      1000 * static_cast<double>(best_device.with_surface) / best_device.whole,
      100 * best_device.submitting / best_device.whole, static_cast<unsigned long long>(counters.on_cpu));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    compare(argc > 1 ? argv[1] : SGM_BENCH_CAVE, argc > 2 ? std::atoi(argv[2]) : 256,
            argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 2, argc > 4 ? argv[4] : "vulkan");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sgm_bench_backends: %s\n", error.what());
    return 1;
  }
  return 0;
}
