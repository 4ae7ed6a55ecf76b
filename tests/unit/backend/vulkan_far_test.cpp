// Tests a device that shares no memory with the host: uploads, downloads, and meshes that stay on the device.

#include <algorithm>
#include <iostream>
#include <random>
#include <string>
#include <thread>

#include "backend/vulkan/device_meshes.h"
#include "far_device.h"
#include "faulty.h"
#include "on_device.h"
#include "rounds.h"
#include "spheres.h"

using namespace sgm;
using vulkan::FarDevice;

namespace {

VulkanMachine farMachine(Faulty& faulty, const BatchRoom& room = {}) {
  VulkanBackendOptions options;
  options.room = room;
  options.memory.apart = true;
  options.open = [&faulty] {
    vulkan::BorrowedDevice external = faulty.engine.lend();
    FarDevice::wrap(external);
    external.replace_calls = [](vulkan::DeviceTable& table) {
      vulkan::KeptPipelines::wrap(table);
      FarDevice::wrap(table);
      vulkan::Faults::wrap(table);
    };
    return vulkan::Device::borrow(external);
  };
  return VulkanMachine(options);
}

/// Meshes batches of growing and shrinking sizes in the same buffers; host memory must be invalidated before each batch
/// is read.
void compareFar(Faulty& faulty) {
  const VulkanMachine machine = farMachine(faulty);
  REQUIRE(machine);
  std::mt19937 random(11);
  for (uint32_t seed = 100; seed < 100 + rounds(6); ++seed) {
    CAPTURE(seed);
    const std::vector<ChunkJob> jobs = spheres(seed, 1 + static_cast<uint32_t>(random() % 12));
    const unsigned before = FarDevice::invalidations();
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.vulkan, jobs));
    CHECK(FarDevice::invalidations() >= before + 4);
  }
  CHECK(machine.vulkan->counters().on_cpu == 0);
}

void overflowFar(Faulty& faulty) {
  static constexpr BatchRoom kScarce[] = {{64, 36'864, 6144}, {6144, 384, 6144}, {6144, 36'864, 64}};
  for (const BatchRoom& room : kScarce) {
    const VulkanMachine machine = farMachine(faulty, room);
    REQUIRE(machine);
    const std::vector<ChunkJob> jobs = spheres(3, 12);
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.vulkan, jobs));
    CHECK(machine.vulkan->counters().on_cpu > 0);
    auto batch = machine.vulkan->submit(jobs);
    REQUIRE(batch);
    (*batch)->cancel();
    (*batch)->wait();
    CHECK_FALSE((*batch)->take());
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.vulkan, jobs));
  }
}

/// Injects failures into the calls that submit work or wait for it, both for the batch and for its download.
void failFar(Faulty& faulty) {
  const std::vector<ChunkJob> jobs = spheres(1, 5);
  uint64_t on_cpu = 0;
  for (const char* call : {"vkQueueSubmit", "vkWaitSemaphores"}) {
    for (const VkResult failure : {VK_ERROR_DEVICE_LOST, VK_ERROR_OUT_OF_HOST_MEMORY}) {
      for (unsigned nth = 1; nth <= 3; ++nth) {
        CAPTURE(call, failure, nth);
        const VulkanMachine machine = farMachine(faulty);
        REQUIRE(machine);
        const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
        faulty.faults.arm(call, nth, failure);
        checkSame(expected, meshesOf(*machine.vulkan, jobs));
        faulty.faults.disarm();
        on_cpu += machine.vulkan->counters().on_cpu;
        for (int again = 0; again < 2; ++again) checkSame(expected, meshesOf(*machine.vulkan, jobs));
      }
    }
  }
  CHECK(on_cpu > 0);
}

/// Checks that meshes stay on the device, both meshes made there and meshes uploaded from the host, and that failures
/// do no harm.
void stayFar(Faulty& faulty) {
  std::vector<ChunkJob> jobs = spheres(5, 4);
  for (ChunkJob& job : jobs) job.resident = true;
  for (const unsigned nth : {0u, 1u, 2u, 3u}) {
    CAPTURE(nth);
    const VulkanMachine machine = farMachine(faulty);
    REQUIRE(machine);
    const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
    if (nth > 0) faulty.faults.arm("vkQueueSubmit", nth, VK_ERROR_OUT_OF_DEVICE_MEMORY);
    const std::vector<ChunkMesh> found = meshesOf(*machine.vulkan, jobs);
    faulty.faults.disarm();
    checkSame(expected, found);
    size_t parts = 0;
    for (const ChunkMesh& mesh : found) {
      if (!mesh.on_device[0]) continue;
      ++parts;
      checkOnDevice(faulty.engine, {{mesh.on_device[0].get(), &mesh.body}});
    }
    CHECK((parts > 0) == (nth == 0));
    REQUIRE(!expected[0].body.indices.empty());
    faulty.faults.arm("vkQueueSubmit", 1, VK_ERROR_OUT_OF_DEVICE_MEMORY);
    const MeshPart* const body = &expected[0].body;
    CHECK_FALSE(machine.vulkan->upload({&body, 1}));
    faulty.faults.disarm();
    const auto uploaded = machine.vulkan->upload({&body, 1});
    REQUIRE(uploaded);
    REQUIRE(uploaded->front() != nullptr);
    checkOnDevice(faulty.engine, {{uploaded->front().get(), body}});
  }
}

/// Tests that if the memory for resident meshes runs out, the meshes are still returned, and later meshes stay on the
/// device again.
void stayWithoutMemory(Faulty& faulty) {
  std::vector<ChunkJob> jobs = spheres(5, 4);
  for (ChunkJob& job : jobs) job.resident = true;
  const VulkanMachine machine = farMachine(faulty);
  REQUIRE(machine);
  std::vector<ChunkJob> passing = jobs;
  for (ChunkJob& job : passing) job.resident = false;
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  checkSame(expected, meshesOf(*machine.vulkan, passing));
  // The batch already has its buffers, so only resident meshes allocate memory. After VK_ERROR_UNKNOWN, the backend
  // does not retry with a smaller block.
  const auto staying = [&] {
    const std::vector<ChunkMesh> found = meshesOf(*machine.vulkan, jobs);
    checkSame(expected, found);
    size_t parts = 0;
    for (const ChunkMesh& mesh : found) {
      for (const auto& part : mesh.on_device) parts += part != nullptr;
    }
    return parts;
  };
  faulty.faults.arm("vkAllocateMemory", 1, VK_ERROR_UNKNOWN);
  const size_t fewer = staying();
  CHECK(faulty.faults.struck());
  faulty.faults.disarm();
  CHECK(staying() > fewer);
  CHECK(machine.vulkan->counters().on_cpu == 0);
}

/// Destroys resident parts in any order, on any thread, during or after their copying, and after the backend and its
/// device are gone.
void endAnywhere(Faulty& faulty) {
  constexpr uint32_t kSeed = 20'260'103;
  std::cout << "ending parts, seed " << kSeed << std::endl;
  std::mt19937 random(kSeed);
  std::vector<std::shared_ptr<const DevicePart>> held;
  {
    const VulkanMachine machine = farMachine(faulty);
    REQUIRE(machine);
    for (uint32_t round = 0; round < rounds(8); ++round) {
      CAPTURE(round);
      // Batches of varying sizes: buffers grow while parts are copied out of them.
      std::vector<ChunkJob> jobs = spheres(kSeed + round, 1 + static_cast<uint32_t>(random() % 12));
      for (ChunkJob& job : jobs) job.resident = true;
      std::vector<ChunkMesh> found = meshesOf(*machine.vulkan, jobs);
      // When a batch has ended, its resident parts can be used without waiting.
      for (const ChunkMesh& mesh : found) {
        for (const auto& part : mesh.on_device) {
          if (!part) continue;
          const vulkan::DeviceMemory& memory = static_cast<const vulkan::VulkanPart&>(*part).memory();
          REQUIRE(*memory.meshes().queue().reached() >= memory.value());
        }
      }
      checkSame(meshesOf(*machine.scalar, jobs), found);
      std::vector<std::shared_ptr<const DevicePart>> ending;
      for (ChunkMesh& mesh : found) {
        for (auto& part : mesh.on_device) {
          if (part) (random() % 3 == 0 ? held : ending).push_back(std::move(part));
        }
      }
      std::shuffle(ending.begin(), ending.end(), random);
      std::shuffle(held.begin(), held.end(), random);
      std::vector<std::shared_ptr<const DevicePart>> others;
      for (size_t i = ending.size() / 2; i > 0; --i) {
        others.push_back(std::move(ending.back()));
        ending.pop_back();
      }
      std::thread other([&others] { others.clear(); });
      ending.clear();
      if (held.size() > 8) held.resize(8);
      other.join();
    }
    // The device is lost while mesh parts in its memory are still referenced.
    faulty.faults.arm("vkQueueSubmit", 1, VK_ERROR_DEVICE_LOST);
    const std::vector<ChunkJob> jobs = spheres(kSeed, 3);
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.vulkan, jobs));
    faulty.faults.disarm();
    CHECK(machine.vulkan->counters().device_lost == 1);
    REQUIRE(!held.empty());
    for (const auto& part : held) {
      CHECK(static_cast<const vulkan::VulkanPart&>(*part).memory().meshes().queue().lost());
    }
  }
  held.clear();
}

/// Once the backend knows the usual size of a batch's result, it downloads that many bytes together with the batch.
void repeatFar(Faulty& faulty) {
  const VulkanMachine machine = farMachine(faulty);
  REQUIRE(machine);
  const std::vector<ChunkJob> jobs = spheres(5, 4);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  for (const unsigned submissions : {2u, 1u, 1u}) {
    faulty.faults.disarm();
    checkSame(expected, meshesOf(*machine.vulkan, jobs));
    CHECK(faulty.faults.counts().at("vkQueueSubmit") == submissions);
  }
}

}  // namespace

void sgm::checkFarDevice(Faulty& faulty) {
  compareFar(faulty);
  overflowFar(faulty);
  failFar(faulty);
  stayFar(faulty);
  stayWithoutMemory(faulty);
  endAnywhere(faulty);
  repeatFar(faulty);
}
