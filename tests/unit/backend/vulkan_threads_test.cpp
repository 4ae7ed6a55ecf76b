// Tests threads that share a backend on an engine's device: they mesh, keep meshes there, upload others and destroy
// them, while the device is lost.

#include <atomic>
#include <iostream>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "kept_pipelines.h"
#include "rounds.h"
#include "spheres.h"
#include "vulkan_machine.h"

using namespace sgm;

namespace {

/// Passes parts between threads, so that a part is destroyed by a different thread than the one that made it.
class Exchanged {
 public:
  using Part = std::shared_ptr<const DevicePart>;
  /// Stores these parts, and destroys the parts that were stored before.
  void pass(std::vector<Part> parts) {
    const std::scoped_lock lock(mutex_);
    std::swap(parts, parts_);
  }

 private:
  std::mutex mutex_;
  std::vector<Part> parts_;
};

/// Makes one of the device's submissions fail with a lost device. It uses no lock, which would order the threads and
/// hide races.
class LosingSubmit {
 public:
  static void wrap(vulkan::DeviceTable& table) {
    real() = table.vkQueueSubmit;
    table.vkQueueSubmit = submit;
  }
  /// From now on, makes the nth submission fail, counted from 1.
  static void arm(int nth) { left().store(nth); }

 private:
  static PFN_vkQueueSubmit& real() {
    static PFN_vkQueueSubmit one = nullptr;
    return one;
  }
  static std::atomic<int>& left() {
    static std::atomic<int> one{0};
    return one;
  }
  static VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo* info, VkFence fence) {
    if (left().fetch_sub(1, std::memory_order_relaxed) == 1) return VK_ERROR_DEVICE_LOST;
    return real()(queue, count, info, fence);
  }
};

/// Results of the threads as counts, because only one thread at a time may use Catch's assertions.
struct Found {
  std::atomic<unsigned> batches{0}, left{0}, wrong{0}, refused{0}, resident{0}, brought{0};
};

void work(Backend& backend, const std::vector<ChunkJob>& jobs, const std::vector<ChunkMesh>& expected, uint32_t seed,
          Exchanged& exchanged, Found& all) {
  std::mt19937 random(seed);
  for (uint32_t round = 0; round < rounds(20); ++round) {
    Result<std::unique_ptr<ChunkBatch>> batch = backend.submit(jobs);
    const auto how = random() % 3;
    if (how == 0) {
      // The batch may be destroyed while parts are still being copied.
      for (auto polls = random() % 1000; polls > 0 && !(*batch)->poll(); --polls) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
      ++all.left;
      continue;
    }
    if (how == 1) {
      while (!(*batch)->poll()) std::this_thread::yield();
    } else {
      (*batch)->wait();
    }
    Result<std::vector<ChunkMesh>> meshes = (*batch)->take();
    if (!meshes) {
      ++all.refused;
      continue;
    }
    ++all.batches;
    std::vector<Exchanged::Part> parts;
    for (size_t i = 0; i < meshes->size(); ++i) {
      if (!differenceOf(expected[i], (*meshes)[i]).empty()) ++all.wrong;
      for (auto& part : (*meshes)[i].on_device) {
        if (!part) continue;
        ++all.resident;
        parts.push_back(std::move(part));
      }
    }
    const MeshPart* const body = &expected[0].body;
    if (auto brought = backend.upload({&body, 1})) {
      if (brought->front()) ++all.brought;
      parts.push_back(std::move(brought->front()));
    }
    (void)backend.counters();
    exchanged.pass(std::move(parts));
  }
}

}  // namespace

TEST_CASE("threads share what stays on a lent device, and its loss", "[vulkan][threads]") {
  if (!VulkanMachine()) return;
  // The validation layer is off, because its locks would hide data races.
  vulkan::KeptEngine kept(vulkan::Validation::none);
  // After a loss, the lost device and the new one, both borrowed from the engine, exist together for a while. They
  // share the engine's queue, which this mutex guards.
  std::mutex queue;
  std::optional<vulkan::DeviceTable> replaced;
  VulkanBackendOptions options;
  options.open = [&] {
    vulkan::BorrowedDevice external = kept.engine.lend();
    external.lock = [](void* user) { static_cast<std::mutex*>(user)->lock(); };
    external.unlock = [](void* user) { static_cast<std::mutex*>(user)->unlock(); };
    external.user = &queue;
    external.replace_calls = [&](vulkan::DeviceTable& table) {
      // The functions are replaced only once, because other threads may already be calling them.
      if (!replaced) {
        vulkan::KeptPipelines::wrap(table);
        LosingSubmit::wrap(table);
        replaced = table;
      }
      table = *replaced;
    };
    return vulkan::Device::borrow(external);
  };
  Exchanged exchanged;
  const VulkanMachine machine(options);
  REQUIRE(machine);
  std::vector<ChunkJob> jobs = spheres(5, 3);
  for (ChunkJob& job : jobs) job.resident = true;
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  checkSame(expected, meshesOf(*machine.vulkan, jobs));
  constexpr uint32_t kSeed = 20'260'105;
  std::cout << "sharing a device, seed " << kSeed << std::endl;
  Found found;
  constexpr unsigned kThreads = 3;
  const auto share = [&](uint32_t seed) {
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] { work(*machine.vulkan, jobs, expected, seed + t, exchanged, found); });
    }
    for (std::thread& thread : threads) thread.join();
  };
  share(kSeed);
  CHECK(machine.vulkan->counters().on_cpu == 0);
  CHECK(machine.vulkan->counters().device_lost == 0);
  exchanged.pass({});
  CHECK(machine.vulkan->counters().resident == 0);
  LosingSubmit::arm(10);
  share(kSeed + kThreads);
  LosingSubmit::arm(0);
  CHECK(machine.vulkan->counters().device_lost == 1);
  CHECK(found.batches + found.left == 2 * kThreads * rounds(20));
  CHECK(found.wrong == 0);
  CHECK(found.refused == 0);
  CHECK(found.resident > 0);
  CHECK(found.brought > 0);
}
