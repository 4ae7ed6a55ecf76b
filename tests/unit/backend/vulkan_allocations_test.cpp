// Tests the host memory that a device backend allocates for a batch once its buffers and pipelines exist: the meshes,
// and small blocks whose number depends on the number of batches, not of chunks.

#include <atomic>

#include "backend/cpu/cpu_backend.h"
#include "mesh_jobs.h"
#include "unit/vulkan/counted_heap.h"
#include "vulkan_machine.h"

using namespace sgm;

namespace {

class CountingMemory final : public std::pmr::memory_resource {
 public:
  uint64_t taken() const { return taken_; }

 private:
  void* do_allocate(size_t size, size_t alignment) override {
    ++taken_;
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* memory, size_t size, size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::atomic<uint64_t> taken_{0};
};

/// Jobs with balls, and empty jobs. All jobs have random seams, and every second one requests the signs of its samples.
std::vector<ChunkJob> ballsAndVoid(uint32_t seed, size_t count) {
  std::mt19937 random(seed);
  std::vector<ChunkJob> jobs;
  for (size_t i = 0; i < count; ++i) {
    const auto program = [&] {
      ProgramBuilder b(512, false, makeLabel(1, 0));
      const auto radius = static_cast<float>(1000 + random() % 4000);
      if (i % 8 != 7) (void)b.group(b.sphere({}, radius, makeLabel(2, 1)), IntBox::everything(), 0, false);
      return shared(b.finish());
    };
    ChunkJob& job = jobs.emplace_back();
    job.grid = gridAround({}, 256);
    job.field = program();
    job.coarse = program();
    job.seams = static_cast<uint8_t>(1 + random() % 63);
    job.coarser = neighboursAcross(job.seams);
    job.signs = i % 2 == 0;
  }
  return jobs;
}

struct Taken {
  uint64_t memory = 0;  ///< number of allocations from the backend's memory resource, without the meshes' arrays
  uint64_t heap = 0;    ///< number of allocations from this thread's heap, without the meshes' lists of seams
};

Taken takenBy(Backend& backend, const CountingMemory& memory, std::vector<ChunkJob> jobs) {
  const size_t count = jobs.size();
  const uint64_t memory_before = memory.taken();
  const int heap_before = vulkan::allocationsOfThread();
  std::unique_ptr<ChunkBatch> batch = *backend.submit(std::move(jobs));
  batch->wait();
  const std::vector<ChunkMesh> meshes = *batch->take();
  const auto heap = static_cast<uint64_t>(vulkan::allocationsOfThread() - heap_before);
  const uint64_t all = memory.taken() - memory_before;
  REQUIRE(meshes.size() == count);
  uint64_t arrays = 0, lists = 0;
  const auto unlessEmpty = [](const auto& list) { return list.empty() ? uint64_t{0} : uint64_t{1}; };
  const auto add = [&](const MeshPart& part) {
    arrays += unlessEmpty(part.vertices) + unlessEmpty(part.indices) + unlessEmpty(part.keys);
  };
  for (const ChunkMesh& mesh : meshes) {
    add(mesh.body);
    for (const MeshPart& seam : mesh.seams) add(seam);
    arrays += unlessEmpty(mesh.signs);
    lists += unlessEmpty(mesh.seams);
  }
  CAPTURE(count, all, arrays, heap, lists);
  REQUIRE(arrays > 4 * count);
  REQUIRE(all >= arrays);
  // The memory resource allocates from the heap, so its allocations also count in `heap`.
  REQUIRE(heap >= all + lists);
  return {all - arrays, heap - all - lists};
}

}  // namespace

TEST_CASE("once warm, a batch takes no memory for its chunks but for their meshes", "[vulkan]") {
  CountingMemory memory;
  // The validation layer is off, because it allocates much memory itself.
  VulkanBackendOptions options;
  options.open = [] {
    vulkan::OwnDevice device;
    device.software = true;
    return vulkan::Device::open(device);
  };
  const auto jobs = *makeThreadPool(1);
  Result<std::unique_ptr<Backend>> made =
      makeVulkanBackend(options, *makeCpuBackend("", *jobs, &memory, {}), &memory, {});
  if (!made) {
    INFO(made.error().message);
    REQUIRE(std::getenv("SGM_REQUIRE_VULKAN") == nullptr);
    std::fprintf(stderr, "SKIPPED: %s\n", made.error().message.c_str());
    return;
  }
  Backend& backend = **made;
  constexpr uint32_t kSeed = 20'260'101;
  CAPTURE(kSeed);
  for (int warming = 0; warming < 2; ++warming) (void)takenBy(backend, memory, ballsAndVoid(kSeed, 64));
  const Taken few = takenBy(backend, memory, ballsAndVoid(kSeed, 16));
  const Taken many = takenBy(backend, memory, ballsAndVoid(kSeed, 64));
  CHECK(few.memory == 0);
  CHECK(many.memory == 0);
  CHECK(many.heap == few.heap);
  CHECK(many.heap < 16);
  CHECK(backend.counters().on_cpu == 0);
}
