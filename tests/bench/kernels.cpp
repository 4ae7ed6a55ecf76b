// Benchmarks the CUDA kernels alone: from programs in GPU memory to meshes in GPU memory.
//
//   sgm_bench_kernels [GRAMMAR [CELL_UNITS]]
//
// The loads are 256 chunks with a surface around a viewer in the sample cave, as a single batch and as several
// concurrent batches, as worlds submit them; and cubes of 64^3 and 256^3 cells around that viewer. Each load is meshed
// repeatedly by kernel launches without copies. Fails if the meshes of a load differ from the CPU's.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "backend/cpu/mesh_chunk.h"
#include "cave.h"
#include "chunk/mesh_chunks.h"
#include "cuda/driver_device.h"
#include "cuda/mesher.h"
#include "float_operations.h"
#include "measure.h"

using namespace sgm;
using bench::jobOf, bench::must, bench::now;

namespace {

constexpr int kWarm = 3, kRuns = 10, kRepeats = 20;
std::pmr::memory_resource* const heap = std::pmr::get_default_resource();

void check(const Result<void>& result) {
  if (!result) throw std::runtime_error(result.error().message);
}

/// Chunks to mesh on the GPU, and the CPU's results with which the GPU's are compared.
struct Load {
  std::string name;
  std::vector<ChunkJob> jobs;
  size_t distinct = 0;  ///< number of different chunks at the beginning of `jobs`, which the rest of the list repeats
  size_t with_surface = 0, vertices = 0, indices = 0;
  uint64_t fields = 0;  ///< sum, over all samples, of the number of instructions in the pruned program that evaluates
                        ///< the sample
  bench::OperationCount floats;
  ContentHash hash;  ///< sum of the content hashes of all mesh parts

  void add(const ChunkMesh& mesh) {
    const auto addPart = [this](const MeshPart& part) {
      vertices += part.vertices.size();
      indices += part.indices.size();
      hash.a += part.hash.a;
      hash.b += part.hash.b;
    };
    with_surface += mesh.body.indices.empty() ? 0u : 1u;
    addPart(mesh.body);
    for (const MeshPart& seam : mesh.seams) addPart(seam);
  }
};

ChunkMesh meshOnCpu(const FieldKernels& kernels, const ChunkJob& job, ChunkScratch& scratch) {
  ChunkMesh mesh(heap);
  meshChunk({kernels, bestMeshKernels()}, job, scratch, mesh);
  return mesh;
}

/// Meshes the load on the CPU, and counts its floating-point operations.
void finish(Load& load) {
  bench::takeOperationCount();
  ChunkScratch scratch(heap);
  for (size_t i = 0; i < load.distinct; ++i) {
    const ChunkMesh mesh = meshOnCpu(bench::floatCountingKernels(), load.jobs[i], scratch);
    ChunkJob bodies = load.jobs[i];
    bodies.seams = 0;
    ChunkScratch counting(heap);
    meshOnCpu(countingKernels(), bodies, counting);
    const bench::OperationCount floats = bench::takeOperationCount();
    for (size_t again = i; again < load.jobs.size(); again += load.distinct) {
      load.add(mesh);
      load.floats.arithmetic += floats.arithmetic;
      load.floats.others += floats.others;
      load.fields += counting.evaluation.operations;
    }
  }
}

Load surfaceLoad(const WorldField& world, size_t batches) {
  Load load;
  const size_t chunks = batches * cuda::kMaxChunks;
  load.name = std::to_string(chunks) + " surface chunks, batches at one time: " + std::to_string(batches);
  ChunkScratch scratch(heap);
  std::vector<ChunkJob> found;
  for (const ChunkRequest& request : bench::aroundViewer(world.settings().finest_cell)) {
    ChunkJob job = jobOf(world, request);
    if (!meshOnCpu(scalarKernels(), job, scratch).body.indices.empty()) found.push_back(std::move(job));
  }
  if (found.empty()) throw std::runtime_error("there is no surface around the viewer");
  for (size_t i = 0; i < chunks; ++i) load.jobs.push_back(found[i % found.size()]);
  load.distinct = std::min(found.size(), chunks);
  return load;
}

Load cubeLoad(const WorldField& world, int cells) {
  Load load;
  load.name = "cube of " + std::to_string(cells) + "^3 cells";
  const int edge = cells / kChunkCells;
  const int32_t chunk = world.settings().finest_cell * kChunkCells;
  const int first = 96 * 1024 / chunk - edge / 2;
  for (int i = 0; i < edge * edge * edge; ++i) {
    load.jobs.push_back(
        jobOf(world, {{0, first + i % edge, first + i / edge % edge, first + i / (edge * edge)}, 0, Neighbourhood{}}));
  }
  load.distinct = load.jobs.size();
  return load;
}

/// The batches of a load, whose programs stay in GPU memory.
class Resident {
 public:
  Resident(cuda::Device& device, const cuda::Room& room, const Load& load)
      : device_(device), mesher_(must(cuda::Mesher::create(device, room))) {
    for (std::span<const ChunkJob> left(load.jobs); !left.empty();) {
      auto part = std::make_unique<Part>();
      left = left.subspan(planBatch(left, room, part->plan));
      if (part->plan.chunks.empty()) continue;
      part->batch = must(mesher_->load(part->plan, part->memory));
      check(part->memory.stream->wait());
      parts_.push_back(std::move(part));
    }
  }

  /// Launches all kernels of all batches `repeats` times. Each batch has its own stream, in which its kernels run in
  /// order.
  void run(int repeats) {
    for (int i = 0; i < repeats; ++i) {
      for (const auto& part : parts_) {
        check(mesher_->clear(part->plan, part->memory));
        check(cuda::Mesher::run(*part->memory.stream, mesher_->launches(part->batch), part->batch));
      }
    }
    for (const auto& part : parts_) check(part->memory.stream->wait());
  }

  /// Returns the time of each kernel run alone, including the launch and the wait.
  std::vector<double> eachKernel() {
    std::vector<double> times(static_cast<size_t>(cuda::Kernel::count));
    for (const auto& part : parts_) {
      check(mesher_->clear(part->plan, part->memory));
      check(part->memory.stream->wait());
      for (const cuda::Mesher::Launch& launch : mesher_->launches(part->batch)) {
        if (launch.blocks == 0) continue;
        const double start = now();
        check(part->memory.stream->launch(launch.kernel, launch.blocks, part->batch));
        check(part->memory.stream->wait());
        times[static_cast<size_t>(launch.kernel)] += now() - start;
      }
    }
    return times;
  }

  /// Meshes the load including uploads and downloads. Returns the sum of the parts' content hashes.
  ContentHash whole() {
    ContentHash hash;
    for (const auto& part : parts_) check(mesher_->submit(part->plan, part->memory));
    for (const auto& part : parts_) {
      check(part->memory.stream->wait());
      const cuda::Mesher::Output output = must(mesher_->read(part->plan, part->memory));
      for (uint32_t p = 0; p < part->plan.part_count; ++p) {
        if (output.parts[p].first_vertex == cuda::kNone) throw std::runtime_error("a mesh has found no room");
        hash.a += output.parts[p].hash[0];
        hash.b += output.parts[p].hash[1];
      }
    }
    return hash;
  }

 private:
  struct Part {
    cuda::Plan plan{heap};
    cuda::Batch batch{};
    cuda::BatchMemory memory;
  };
  cuda::Device& device_;
  std::unique_ptr<cuda::Mesher> mesher_;
  std::vector<std::unique_ptr<Part>> parts_;
};

/// Returns the memory bandwidth of a copy within device memory, in bytes read and written per second.
double copyBandwidth(cuda::Device& device) {
  const auto stream = must(device.makeStream());
  const size_t bytes = std::min<uint64_t>(device.info().memory / 8, size_t{1} << 30);
  cuda::Memory from, to;
  check(from.grow(*stream, cuda::MemoryKind::device, bytes));
  check(to.grow(*stream, cuda::MemoryKind::device, bytes));
  const auto copy = [&] {
    check(stream->copy(to.data(), from.data(), bytes));
    check(stream->wait());
  };
  return 2e3 * static_cast<double>(bytes) / bench::timed(kWarm, kRuns, copy).least;
}

/// Returns the milliseconds that a minimal submission to the device and the wait for it take.
double leastWait(cuda::Device& device) {
  const auto stream = must(device.makeStream());
  cuda::Memory some;
  check(some.grow(*stream, cuda::MemoryKind::device, 256));
  const auto clear = [&] {
    check(stream->clear(some.data(), 256));
    check(stream->wait());
  };
  return bench::timed(kWarm, 100, clear).median;
}

/// Returns the device's peak number of additions, subtractions or products per second. It is half of the manufacturer's
/// figure, which counts a fused multiply-add as two operations; the arithmetic contract forbids these.
double floatRate(const cuda::DeviceInfo& info) {
  const int capability = 10 * info.capability_major + info.capability_minor;
  const double lanes = capability < 86 ? 64 : 128;  // number of single-precision lanes of a multiprocessor
  return lanes * info.processors * info.clock * 1e3;
}

constexpr const char* kKernelNames[] = {
    "prune",         "sample",     "census of bodies", "census of seams", "allocate", "body vertices",
    "seam vertices", "list cells", "body triangles",   "seam triangles",  "sums"};
static_assert(std::size(kKernelNames) == static_cast<size_t>(cuda::Kernel::count));

/// Returns the minimum number of bytes that meshing must transfer: it reads each sample once and writes each index
/// once. With `vertices`, it also writes the packed vertices, but without normals, which need the field again.
double meshingBytes(const Load& load, bool vertices) {
  return static_cast<double>(load.jobs.size() * cuda::kSamples * sizeof(int32_t) + load.indices * sizeof(uint32_t) +
                             (vertices ? load.vertices * sizeof(Vertex) : 0));
}

void measure(cuda::Device& device, Load& load, double bandwidth) {
  finish(load);
  cuda::Room room;
  room.scratch_bytes = std::min<uint64_t>(device.info().memory / 8, uint64_t{4} << 30);
  Resident resident(device, room, load);
  const ContentHash hash = resident.whole();
  if (hash.a != load.hash.a || hash.b != load.hash.b) throw std::runtime_error("the meshes differ from the CPU's");
  const double all = bench::timed(kWarm, kRuns, [&] { resident.run(kRepeats); }).median / kRepeats;
  const double back = bench::timed(kWarm, kRuns, [&] { resident.whole(); }).median;
  std::vector<double> kernels(std::size(kKernelNames));
  for (int i = 0; i < kRuns; ++i) {
    const std::vector<double> times = resident.eachKernel();
    for (size_t k = 0; k < times.size(); ++k) kernels[k] = i == 0 ? times[k] : std::min(kernels[k], times[k]);
  }
  std::printf("\n%s: %zu, %zu with a surface, %zu triangles\n", load.name.c_str(), load.jobs.size(), load.with_surface,
              load.indices / 3);
  std::printf("  from resident programs: %.3f ms, %.0f surface chunks a second; with the way there and back %.3f ms\n",
              all, 1e3 * static_cast<double>(load.with_surface) / all, back);
  const auto of = [&kernels](cuda::Kernel kernel) { return kernels[static_cast<size_t>(kernel)]; };
  double sum = 0;
  for (size_t k = 0; k < kernels.size(); ++k) {
    std::printf("  %-18s %9.4f ms\n", kKernelNames[k], kernels[k]);
    sum += kernels[k];
  }
  const double vertices = of(cuda::Kernel::BodyVertices) + of(cuda::Kernel::SeamVertices);
  const double before = of(cuda::Kernel::Prune) + of(cuda::Kernel::Sample);
  const double sampling = of(cuda::Kernel::Sample);
  std::printf("  each by itself     %9.4f ms, %.3f times all together\n", sum, sum / all);
  std::printf("  sampling: %.3f million field operations, %.2f Gop/s; %.1f million of floats (and %.1f million others)",
              static_cast<double>(load.fields) / 1e6, static_cast<double>(load.fields) / sampling / 1e6,
              static_cast<double>(load.floats.arithmetic) / 1e6, static_cast<double>(load.floats.others) / 1e6);
  std::printf(", %.1f %% of the float rate\n",
              1e5 * static_cast<double>(load.floats.arithmetic) / sampling / floatRate(device.info()));
  for (const bool with : {false, true}) {
    const double bytes = meshingBytes(load, with), time = sum - before - (with ? 0 : vertices);
    std::printf("  meshing %s vertices: %.1f GB/s, %.1f %% of a copy's\n", with ? "with" : "without",
                bytes / time / 1e6, 1e5 * bytes / time / bandwidth);
  }
}

void measureAll(const char* grammar, int32_t cell) {
  WorldFieldSettings settings = bench::settingsOf(grammar, 3);
  settings.finest_cell = cell;
  const WorldField world(settings, heap);
  const cuda::DriverTable driver = must(cuda::openDriver());
  const std::unique_ptr<cuda::Device> device = must(cuda::openDevice(driver, cuda::kernelImage()));
  const cuda::DeviceInfo& info = device->info();
  const double bandwidth = copyBandwidth(*device);
  std::printf("%s, compute capability %d.%d, %u multiprocessors of %.0f MHz at most, driver for CUDA %d.%d\n",
              info.name.c_str(), info.capability_major, info.capability_minor, info.processors, info.clock / 1e3,
              info.driver / 1000, info.driver % 1000 / 10);
  std::printf("a copy on it: %.1f GB/s, read and written; %.1f Gop/s of floats at most; launch and wait %.4f ms\n",
              bandwidth / 1e9, floatRate(info) / 1e9, leastWait(*device));
  std::vector<Load> loads;
  for (const size_t batches : {size_t{1}, size_t{3}, size_t{8}}) loads.push_back(surfaceLoad(world, batches));
  for (const int cells : {64, 256}) loads.push_back(cubeLoad(world, cells));
  for (Load& load : loads) measure(*device, load, bandwidth);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    measureAll(argc > 1 ? argv[1] : SGM_BENCH_CAVE, argc > 2 ? std::atoi(argv[2]) : 512);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sgm_bench_kernels: %s\n", error.what());
    return 1;
  }
  return 0;
}
