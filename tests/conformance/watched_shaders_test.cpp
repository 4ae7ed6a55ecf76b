// Runs the mesher's shaders under GPU-assisted validation, which checks each memory access: none may exceed its buffer.
// Another test shows that the layer does report such accesses (tests/unit/vulkan).

#include "catch.h"
#include "compare_meshes.h"
#include "mesh_jobs.h"
#include "vulkan_machine.h"

using namespace sgm;

namespace {

/// Makes jobs whose fields have two layers of spheres, which add, cut and blend. Some jobs have seams to chunks with
/// another program. The fields use few kinds of instructions, because each kind must be compiled with the validation's
/// checks.
std::vector<ChunkJob> layeredBalls(uint32_t seed, size_t count) {
  std::mt19937 random(seed);
  std::vector<ChunkJob> jobs;
  for (size_t i = 0; i < count; ++i) {
    const Int3 centre = kTestCentres[i % 3];
    const auto near = [&] {
      Int3 at = centre;
      for (int axis = 0; axis < 3; ++axis) at[axis] += static_cast<int32_t>(random() % 2000);
      return shared(layered(at));
    };
    ChunkJob& job = jobs.emplace_back();
    job.grid = gridAround(centre, 256 << random() % 2);
    job.field = near();
    job.seams = static_cast<uint8_t>(i == 0 ? 63 : i == 1 ? 0 : random() % 64);
    if (job.seams != 0) job.coarse = near();
    job.coarser = neighboursAcross(job.seams);
    job.signs = i % 2 == 0;
    job.body = i % 5 != 4;
  }
  return jobs;
}

}  // namespace

TEST_CASE("no shader reaches beyond its buffers, in batches that find room and in those that do not") {
  constexpr uint32_t kSeed = 20'260'101;
  CAPTURE(kSeed);
  const auto log = std::make_shared<vulkan::MessageLog>();
  VulkanBackendOptions options;
  options.open = [log] { return vulkan::Device::open(VulkanMachine::watched(log, vulkan::Validation::gpu_assisted)); };
  // GPU-assisted validation checks the bounds of whole VkBuffers only, so give each of our buffers a VkBuffer of its
  // own.
  options.memory.first_block = options.memory.largest_block = 256;
  // The output has room for at least eight chunks: enough for a batch of 4 of these jobs, but not for a batch of 20.
  options.room = {900, 5400, 900};
  const VulkanMachine machine(options);
  if (!machine) return;
  for (const size_t count : {size_t{4}, size_t{20}}) {
    const std::vector<ChunkJob> jobs = layeredBalls(kSeed, count);
    const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
    const uint64_t before = machine.vulkan->counters().on_cpu;
    const std::vector<ChunkMesh> found = meshesOf(*machine.vulkan, jobs);
    const uint64_t on_cpu = machine.vulkan->counters().on_cpu - before;
    size_t triangles = 0, in_seams = 0;
    for (size_t i = 0; i < count; ++i) {
      CAPTURE(i);
      CHECK(differenceOf(expected[i], found[i]) == "");
      triangles += expected[i].body.indices.size() / 3;
      for (const MeshPart& seam : expected[i].seams) in_seams += seam.indices.size() / 3;
    }
    CAPTURE(count, triangles, in_seams, on_cpu);
    CHECK(triangles > 300 * count);
    CHECK(in_seams > 10 * count);
    CHECK((on_cpu > 0) == (count == 20));
    CHECK(on_cpu < count);
  }
  CHECK(VulkanMachine::silent(log->texts()));
}
