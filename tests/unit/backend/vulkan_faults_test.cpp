// Tests failures of the device: calls fail, the device is lost, its memory is short, or batches are not awaited. The
// meshes must always be the same, because the CPU makes those that the device does not make, and the next batch must
// find a device again.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <thread>

#include "faulty.h"
#include "rounds.h"
#include "scarce_threads.h"
#include "spheres.h"
#include "temporary_folder.h"
#include "vulkan_machine.h"

using namespace sgm;
using vulkan::Faults;
namespace fs = std::filesystem;

namespace {

bool haveDevice() { return static_cast<bool>(VulkanMachine()); }

/// Loses the device at each Vulkan call in turn: all meshes must be made, and the next batch must use a device again.
void loseDevices(Faulty& faulty) {
  Faults& faults = faulty.faults;
  const VulkanMachine machine = faulty.machine();
  REQUIRE(machine);
  const std::vector<ChunkJob> jobs = spheres(1, 5);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  checkSame(expected, meshesOf(*machine.vulkan, jobs));
  REQUIRE(machine.vulkan->counters().on_cpu == 0);
  constexpr uint32_t kSeed = 20'260'101;
  std::cout << "losing devices, seed " << kSeed << std::endl;
  std::mt19937 random(kSeed);
  uint64_t losses = 0;
  for (uint32_t tries = 0; losses < rounds(100); ++tries) {
    REQUIRE(tries < 20 * rounds(100));
    static const char* const kCalls[] = {"vkQueueSubmit", "vkWaitSemaphores", "vkGetSemaphoreCounterValue"};
    const char* const call = kCalls[random() % 3];
    const auto nth = 1 + static_cast<unsigned>(random() % 3);
    const bool polls = random() % 2 == 0;
    CAPTURE(tries, call, nth, polls);
    const BackendCounters before = machine.vulkan->counters();
    faults.arm(call, nth, VK_ERROR_DEVICE_LOST);
    checkSame(expected, polls ? polled(*machine.vulkan, jobs) : meshesOf(*machine.vulkan, jobs));
    const bool struck = faults.struck();
    faults.disarm();
    const BackendCounters after = machine.vulkan->counters();
    REQUIRE(after.chunks == before.chunks + jobs.size());
    // If the query of the progress fails, the backend waits for the device instead. This wait detects that the device
    // is lost.
    REQUIRE(after.device_lost == before.device_lost + struck);
    REQUIRE(after.on_cpu == before.on_cpu + (struck ? jobs.size() : 0));
    losses += struck;
    if (!struck) continue;
    checkSame(expected, meshesOf(*machine.vulkan, jobs));
    const BackendCounters again = machine.vulkan->counters();
    REQUIRE(again.on_cpu == after.on_cpu);
    REQUIRE(again.batches == after.batches + 1);
  }
}

/// Makes Vulkan calls fail for lack of memory: the CPU must mesh the affected chunks.
void failCalls(Faulty& faulty) {
  static const std::pair<const char*, VkResult> kFailures[] = {
      {"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY},
      {"vkCreateBuffer", VK_ERROR_OUT_OF_HOST_MEMORY},
      {"vkCreateComputePipelines", VK_ERROR_OUT_OF_DEVICE_MEMORY},
      {"vkAllocateDescriptorSets", VK_ERROR_OUT_OF_POOL_MEMORY},
      {"vkEndCommandBuffer", VK_ERROR_OUT_OF_DEVICE_MEMORY},
      {"vkQueueSubmit", VK_ERROR_OUT_OF_DEVICE_MEMORY},
      {"vkWaitSemaphores", VK_ERROR_OUT_OF_HOST_MEMORY},
      {"vkGetSemaphoreCounterValue", VK_ERROR_OUT_OF_HOST_MEMORY},
  };
  Faults& faults = faulty.faults;
  const std::vector<ChunkJob> jobs = spheres(2, 3);
  std::mt19937 random(7);
  uint64_t on_cpu = 0;
  for (const auto& [call, failure] : kFailures) {
    for (uint32_t round = 0; round < rounds(5); ++round) {
      // Each failing call needs a new machine, because a machine creates its pipelines and buffers only once.
      const VulkanMachine machine = faulty.machine();
      REQUIRE(machine);
      const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
      const auto nth = 1 + static_cast<unsigned>(random() % 4);
      CAPTURE(call, nth, round);
      faults.arm(call, nth, failure);
      checkSame(expected, meshesOf(*machine.vulkan, jobs));
      faults.disarm();
      on_cpu += machine.vulkan->counters().on_cpu;
      checkSame(expected, meshesOf(*machine.vulkan, jobs));
      const uint64_t before = machine.vulkan->counters().on_cpu;
      checkSame(expected, meshesOf(*machine.vulkan, jobs));
      CHECK(machine.vulkan->counters().on_cpu == before);
    }
  }
  CHECK(on_cpu > 0);
}

/// Makes the buffers too small: chunks that do not fit must be meshed by the CPU, and counted.
void leaveNoRoom(Faulty& faulty) {
  static constexpr BatchRoom kScarce[] = {{64, 36'864, 6144}, {6144, 384, 6144}, {6144, 36'864, 64}};
  for (const BatchRoom& room : kScarce) {
    const VulkanMachine machine = faulty.machine(room);
    REQUIRE(machine);
    CAPTURE(room.vertices, room.indices, room.cells);
    const std::vector<ChunkJob> jobs = spheres(3, 12);
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.vulkan, jobs));
    const BackendCounters counters = machine.vulkan->counters();
    CHECK(counters.on_cpu > 0);
    CHECK(counters.chunks == jobs.size());
    CHECK(counters.device_lost == 0);
  }
}

/// Cancels batches in every state: each must end without meshes.
void cancelBatches(Faulty& faulty) {
  const VulkanMachine machine = faulty.machine({64, 384, 64});
  REQUIRE(machine);
  const std::vector<ChunkJob> jobs = spheres(4, 12);
  const auto cancelled = [](ChunkBatch& batch) {
    batch.wait();
    const auto meshes = batch.take();
    return !meshes && meshes.error().code == Code::cancelled;
  };
  auto batch = machine.vulkan->submit(jobs);
  REQUIRE(batch);
  (*batch)->cancel();
  CHECK(cancelled(**batch));
  // The progress callback cancels the batch; the CPU meshes the first chunk, because the device's buffers have no room
  // for any chunk.
  std::atomic<int> told{0};
  batch = machine.vulkan->submit(jobs, [&] { return ++told < 3; });
  REQUIRE(batch);
  CHECK(cancelled(**batch));
  CHECK(told >= 3);
  // The batch is destroyed while the device works on it.
  batch = machine.vulkan->submit(jobs);
  REQUIRE(batch);
  batch->reset();
  checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.vulkan, jobs));
}

/// Cancels batches from another thread at any time: each batch must end with all of its meshes or none, and the next
/// batch must be complete.
void cancelAnywhere(Faulty& faulty) {
  using Clock = std::chrono::steady_clock;
  const VulkanMachine roomy = faulty.machine(), scarce = faulty.machine({6144, 384, 6144});
  REQUIRE((roomy && scarce));
  const std::vector<ChunkJob> jobs = spheres(8, 12);
  const std::vector<ChunkMesh> expected = meshesOf(*roomy.scalar, jobs);
  constexpr uint32_t kSeed = 20'260'102;
  std::cout << "cancelling, seed " << kSeed << std::endl;
  std::mt19937 random(kSeed);
  unsigned cancelled = 0, whole = 0;
  for (const VulkanMachine* machine : {&roomy, &scarce}) {
    checkSame(expected, meshesOf(*machine->vulkan, jobs));
    const auto before = Clock::now();
    checkSame(expected, meshesOf(*machine->vulkan, jobs));
    const auto took = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - before).count();
    for (uint32_t round = 0; round < rounds(20); ++round) {
      // The batch is cancelled immediately, or at any time up to its usual duration.
      const auto wait = round == 0 ? 0 : static_cast<int64_t>(random() % static_cast<uint64_t>(took + 1));
      const bool polls = random() % 2 == 0;
      CAPTURE(round, wait, polls);
      auto batch = machine->vulkan->submit(jobs);
      REQUIRE(batch);
      std::thread other;
      if (round == 0) (*batch)->cancel();
      if (round > 1) {
        other = std::thread([&] {
          std::this_thread::sleep_for(std::chrono::microseconds(wait));
          (*batch)->cancel();
        });
      }
      if (polls) {
        while (!(*batch)->poll()) std::this_thread::sleep_for(std::chrono::microseconds(200));
      } else {
        (*batch)->wait();
      }
      if (other.joinable()) other.join();
      if (round == 1) (*batch)->cancel();
      const auto meshes = (*batch)->take();
      ++(meshes ? whole : cancelled);
      if (meshes) checkSame(expected, *meshes);
      if (!meshes) REQUIRE(meshes.error().code == Code::cancelled);
      checkSame(expected, meshesOf(*machine->vulkan, jobs));
    }
  }
  CAPTURE(cancelled, whole);
  CHECK(cancelled >= 2);
  CHECK(whole >= 2);
}

/// Checks that the next backend finds cached pipelines, replaces damaged ones, and works if they cannot be stored.
void keepPipelines(Faulty& faulty) {
  const TemporaryFolder folder;
  const std::vector<ChunkJob> jobs = spheres(6, 2);
  const auto warningsWith = [&](const fs::path& where) {
    const VulkanMachine machine = faulty.machine({}, where);
    REQUIRE(machine);
    const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
    for (int again = 0; again < 2; ++again) checkSame(expected, meshesOf(*machine.vulkan, jobs));
    CHECK(machine.vulkan->counters().on_cpu == 0);
    return machine.warnings;
  };
  const std::vector<std::string> none;
  const fs::path kept = folder.path / "a" / "b";
  CHECK(warningsWith(kept) == none);
  REQUIRE(std::distance(fs::directory_iterator(kept), {}) == 1);
  const fs::path file = fs::directory_iterator(kept)->path();
  const std::string content = contentOf(file);
  CHECK(content.size() > 24);
  // If the pipelines in the file suffice, the file is not written again.
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(file, long_ago);
  CHECK(warningsWith(kept) == none);
  CHECK(fs::last_write_time(file) == long_ago);

  std::string damaged = content;
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  std::ofstream(file, std::ios::binary) << damaged;
  CHECK(warningsWith(kept) == none);
  CHECK(contentOf(file) == content);

  const std::vector<std::string> warnings = warningsWith(file / "folder");
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("compiled pipelines are not cached") != std::string::npos);
  CHECK(warnings[0].find((file / "folder").string()) != std::string::npos);
  CHECK(contentOf(file) == content);
}

#ifdef SGM_SCARCE_THREADS
/// If no thread can be started to compile the shaders in the background, the first batch must wait for the shaders.
void failThreads(Faulty& faulty) {
  std::vector<ChunkJob> jobs = spheres(7, 3);
  for (ChunkJob& job : jobs) job.prompt = true;
  // The driver's own threads may fail to start as well. Here they are not needed: earlier tests have already made the
  // driver compile this device's pipelines.
  const VulkanMachine machine = faulty.machine();
  REQUIRE(machine);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  const FailingThreads scarce(0);
  checkSame(expected, meshesOf(*machine.vulkan, jobs));
  CHECK(machine.vulkan->counters().on_cpu == 0);
}
#endif

}  // namespace

TEST_CASE("whatever the device refuses, the meshes are right, and the next batch finds a device", "[vulkan]") {
  if (!haveDevice()) return;
  Faulty faulty;
  loseDevices(faulty);
  failCalls(faulty);
  leaveNoRoom(faulty);
  cancelBatches(faulty);
  cancelAnywhere(faulty);
  keepPipelines(faulty);
  checkMeshesThatStay(faulty);
  checkFarDevice(faulty);
#ifdef SGM_SCARCE_THREADS
  failThreads(faulty);
#endif
}

TEST_CASE("a device of our own is opened anew once it is lost", "[vulkan]") {
  Faults faults;
  const auto log = std::make_shared<vulkan::MessageLog>();
  {
    const VulkanMachine machine({}, [log] {
      vulkan::OwnDevice own = VulkanMachine::watched(log);
      own.replace_calls = [](vulkan::DeviceTable& table) { Faults::wrap(table); };
      return vulkan::Device::open(own);
    });
    if (!machine) return;
    const std::vector<ChunkJob> jobs = spheres(5, 2);
    const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
    faults.arm("vkWaitSemaphores", 1, VK_ERROR_DEVICE_LOST);
    checkSame(expected, meshesOf(*machine.vulkan, jobs));
    faults.disarm();
    checkSame(expected, meshesOf(*machine.vulkan, jobs));
    CHECK(machine.vulkan->counters().device_lost == 1);
    CHECK(machine.vulkan->counters().on_cpu == jobs.size());
  }
  // The validation layer also checks for leaks when the device is destroyed.
  CHECK(VulkanMachine::silent(log->texts()));
}
