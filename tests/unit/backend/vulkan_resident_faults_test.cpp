// Tests failures of the device while meshes stay on it or are uploaded to it. The meshes must be the same, meshes that
// could not stay must be reported as absent, and the meshes of the next batch must stay on the device again.

#include <chrono>
#include <iostream>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "backend/cpu/cpu_backend.h"
#include "backend/open/open_backend.h"
#include "faulty.h"
#include "on_device.h"
#include "rounds.h"
#include "spheres.h"

using namespace sgm;

namespace {

const MeshPart& partAt(const ChunkMesh& mesh, size_t part) {
  static const MeshPart none;
  if (part == 0) return mesh.body;
  return mesh.seams.empty() ? none : mesh.seams[part - 1];
}

/// The device parts of all meshes, kMeshParts for each mesh; null if a part is not on the device.
using Drawn = std::vector<std::shared_ptr<const DevicePart>>;

Drawn drawnOf(const std::vector<ChunkMesh>& meshes) {
  Drawn drawn;
  for (const ChunkMesh& mesh : meshes) drawn.insert(drawn.end(), mesh.on_device.begin(), mesh.on_device.end());
  return drawn;
}

struct Stayed {
  size_t wanted = 0, there = 0;  ///< number of parts with triangles, and number of parts on a device
  size_t lost = 0;               ///< number of parts on a lost device
  uint64_t bytes = 0;            ///< bytes of the device memory that holds parts, without lost devices
};

/// Compares the bytes of all parts on the device. whole: requires that all parts of a chunk are there, or none.
Stayed checkStayed(vulkan::Engine& engine, const std::vector<ChunkMesh>& expected, const Drawn& drawn, bool whole) {
  REQUIRE(drawn.size() == expected.size() * kMeshParts);
  Stayed stayed;
  std::vector<PartOnDevice> readable;
  std::set<const vulkan::DeviceMemory*> memories;
  for (size_t c = 0; c < expected.size(); ++c) {
    size_t wanted = 0, there = 0;
    for (size_t p = 0; p < kMeshParts; ++p) {
      CAPTURE(c, p);
      const MeshPart& part = partAt(expected[c], p);
      const DevicePart* const on_device = drawn[c * kMeshParts + p].get();
      wanted += !part.indices.empty();
      if (on_device == nullptr) continue;
      REQUIRE_FALSE(part.indices.empty());
      ++there;
      const vulkan::DeviceMemory& memory = static_cast<const vulkan::VulkanPart*>(on_device)->memory();
      if (memory.meshes().queue().lost()) {
        ++stayed.lost;
        continue;
      }
      readable.emplace_back(on_device, &part);
      if (memories.insert(&memory).second) stayed.bytes += memory.buffer().size();
    }
    CAPTURE(c, wanted, there);
    REQUIRE((!whole || there == 0 || there == wanted));
    stayed.wanted += wanted;
    stayed.there += there;
  }
  checkOnDevice(engine, readable);
  return stayed;
}

struct Failure {
  const char* call;
  VkResult result;
};

constexpr Failure kRefusals[] = {
    {"vkQueueSubmit", VK_ERROR_DEVICE_LOST},
    {"vkQueueSubmit", VK_ERROR_OUT_OF_DEVICE_MEMORY},
    {"vkWaitSemaphores", VK_ERROR_DEVICE_LOST},
    {"vkWaitSemaphores", VK_ERROR_OUT_OF_HOST_MEMORY},
    {"vkGetSemaphoreCounterValue", VK_ERROR_DEVICE_LOST},
    {"vkGetSemaphoreCounterValue", VK_ERROR_OUT_OF_HOST_MEMORY},
    {"vkBeginCommandBuffer", VK_ERROR_OUT_OF_HOST_MEMORY},
    {"vkEndCommandBuffer", VK_ERROR_OUT_OF_DEVICE_MEMORY},
    {"vkResetCommandPool", VK_ERROR_OUT_OF_DEVICE_MEMORY},
    {"vkCreateBuffer", VK_ERROR_OUT_OF_HOST_MEMORY},
    {"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY},
    {"vkAllocateMemory", VK_ERROR_UNKNOWN},  // for this error, the backend does not try a smaller block
    {"vkMapMemory", VK_ERROR_MEMORY_MAP_FAILED},
};

/// Runs batches whose meshes stay on the device, while Vulkan calls fail from time to time.
class Strikes {
 public:
  Strikes(Faulty& faulty, uint32_t seed) : faulty_(faulty), random_(seed) {
    for (ChunkJob& job : jobs_) job.resident = true;
    renew(UINT64_MAX);
    expected_ = meshesOf(*machine_->scalar, jobs_);
    const Drawn drawn = drawnOf(meshesOf(*machine_->vulkan, jobs_));
    all_ = checkStayed(faulty_.engine, expected_, drawn, true);
    REQUIRE(all_.there == all_.wanted);
    REQUIRE(machine_->vulkan->counters().resident == all_.bytes);
    for (size_t c = 0; c < jobs_.size(); ++c) {
      const auto& body = static_cast<const vulkan::VulkanPart&>(*drawn[c * kMeshParts]);
      largest_ = std::max<uint64_t>(largest_, body.memory().buffer().size());
    }
  }

  /// Runs a batch, or uploads its meshes, while one call may fail. scarce: there is memory for some of the meshes only.
  void one(bool scarce) {
    // Only a backend that has no memory blocks yet allocates memory, so a new backend is made from time to time.
    if (scarce != (cap_ != UINT64_MAX) || random_() % 3 == 0)
      renew(scarce ? largest_ + random_() % (all_.bytes - largest_) : UINT64_MAX);
    const Failure failure = kRefusals[random_() % std::size(kRefusals)];
    const auto nth = 1 + static_cast<unsigned>(random_() % 4);
    const bool brings = random_() % 3 == 0, polls = random_() % 2 == 0;
    CAPTURE(cap_, failure.call, failure.result, nth, brings, polls);
    const BackendCounters before = counters();
    REQUIRE(before.resident == 0);
    faulty_.faults.arm(failure.call, nth, failure.result);
    const Drawn drawn = brings ? brought(failure) : meshed(polls);
    const bool struck = faulty_.faults.struck();
    faulty_.faults.disarm();

    const Stayed stayed = checkStayed(faulty_.engine, expected_, drawn, !brings);
    const BackendCounters after = countersOnceOnlyThese(stayed.bytes);
    const bool lost = struck && failure.result == VK_ERROR_DEVICE_LOST;
    CAPTURE(struck, stayed.there, stayed.lost, all_.wanted);
    REQUIRE((struck || scarce || stayed.there == all_.wanted));
    REQUIRE((struck || stayed.there > 0));
    REQUIRE(stayed.lost == (lost ? stayed.there : 0));
    REQUIRE(after.resident == stayed.bytes);
    REQUIRE(after.resident <= cap_);
    REQUIRE(after.device_lost == before.device_lost + lost);
    REQUIRE(after.chunks == before.chunks + (brings ? 0 : jobs_.size()));
    const uint64_t on_cpu = after.on_cpu - before.on_cpu;
    REQUIRE((on_cpu == 0 || (struck && on_cpu == jobs_.size() && stayed.there == 0)));
    losses += lost;
    in_vain += struck && on_cpu == 0 && stayed.there == 0;
    partly += stayed.there > 0 && stayed.there < all_.wanted;
  }
  /// Checks that the next batch finds a device that works and has memory.
  void again() {
    const BackendCounters before = counters();
    REQUIRE(before.resident == 0);
    const Stayed stayed = checkStayed(faulty_.engine, expected_, meshed(false), true);
    REQUIRE(stayed.there > 0);
    REQUIRE((cap_ != UINT64_MAX || stayed.there == all_.wanted));
    REQUIRE(stayed.lost == 0);
    REQUIRE(counters().on_cpu == before.on_cpu);
    REQUIRE(counters().device_lost == before.device_lost);
  }

  unsigned losses = 0;   ///< number of lost devices
  unsigned in_vain = 0;  ///< number of rounds in which the device did its work, but no mesh stayed on it
  unsigned partly = 0;   ///< number of rounds in which only some meshes stayed on the device

 private:
  /// Waits until only `bytes` are resident, for at most 120 s. After a failed wait for the device, the memory of a part
  /// is freed only when the copy into it has ended.
  BackendCounters countersOnceOnlyThese(uint64_t bytes) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (counters().resident != bytes && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    return counters();
  }
  BackendCounters counters() const { return machine_->vulkan->counters(); }
  void renew(uint64_t cap) {
    VulkanBackendOptions options;
    options.resident_cap = cap_ = cap;
    machine_.reset(new VulkanMachine(faulty_.machine(options)));
    REQUIRE(*machine_);
  }
  Drawn meshed(bool polls) {
    const std::vector<ChunkMesh> found = polls ? polled(*machine_->vulkan, jobs_) : meshesOf(*machine_->vulkan, jobs_);
    checkSame(expected_, found);
    return drawnOf(found);
  }
  Drawn brought(const Failure& failure) {
    std::vector<const MeshPart*> parts;
    for (const ChunkMesh& mesh : expected_) {
      for (size_t p = 0; p < kMeshParts; ++p) parts.push_back(&partAt(mesh, p));
    }
    auto found = machine_->vulkan->upload(parts);
    if (found) return std::move(*found);
    CAPTURE(found.error().message);
    REQUIRE(faulty_.faults.struck());
    REQUIRE((found.error().code == Code::device_lost) == (failure.result == VK_ERROR_DEVICE_LOST));
    return Drawn(parts.size());
  }

  Faulty& faulty_;
  std::mt19937 random_;
  std::unique_ptr<VulkanMachine> machine_;
  uint64_t cap_ = UINT64_MAX;
  std::vector<ChunkJob> jobs_ = spheres(1, 5);
  std::vector<ChunkMesh> expected_;
  Stayed all_;
  uint64_t largest_ = 0;  ///< size in bytes of the largest chunk's memory
};

/// Makes random Vulkan calls fail while meshes are kept on the device or uploaded to it: first with enough memory, then
/// with memory for only some of the meshes.
void strikeMeshesThatStay(Faulty& faulty) {
  constexpr uint32_t kSeed = 20'260'104;
  std::cout << "striking meshes that stay, seed " << kSeed << std::endl;
  for (const bool scarce : {false, true}) {
    Strikes strikes(faulty, kSeed + scarce);
    for (uint32_t round = 0; round < rounds(60); ++round) {
      CAPTURE(scarce, round);
      strikes.one(scarce);
      strikes.again();
    }
    CHECK(strikes.losses > 0);
    CHECK(strikes.in_vain > 0);
    CHECK((!scarce || strikes.partly > 0));
  }
}

/// Tests that an engine's device is not used again after its loss: the CPU meshes from then on.
void loseForGood(Faulty& faulty) {
  BackendRequest request;
  request.kind = BackendKind::vulkan;
  request.external = std::make_shared<const vulkan::BorrowedDevice>(faulty.lend());
  const auto jobs = *makeThreadPool(2);
  const auto scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::vector<ChunkJob> chunks = spheres(1, 5);
  for (ChunkJob& job : chunks) job.resident = true;
  const std::vector<ChunkMesh> expected = meshesOf(*scalar, chunks);
  const MeshPart* const body = &expected[0].body;
  // The device is lost while it meshes, or while meshes are uploaded.
  for (const bool brings : {false, true}) {
    CAPTURE(brings);
    auto made = makeBackend(request, *jobs, std::pmr::get_default_resource());
    REQUIRE(made);
    Backend& backend = **made;
    checkSame(expected, meshesOf(backend, chunks));
    REQUIRE(backend.counters().on_cpu == 0);
    faulty.faults.arm("vkQueueSubmit", 1, VK_ERROR_DEVICE_LOST);
    if (brings) {
      const auto brought = backend.upload({&body, 1});
      REQUIRE_FALSE(brought);
      CHECK(brought.error().code == Code::device_lost);
    } else {
      checkSame(expected, meshesOf(backend, chunks));
    }
    REQUIRE(faulty.faults.struck());
    const BackendCounters lost = backend.counters();
    CHECK(lost.device_lost == 1);
    CHECK(lost.on_cpu == (brings ? 0 : chunks.size()));
    faulty.faults.disarm();
    for (unsigned batch = 1; batch <= 3; ++batch) {
      const std::vector<ChunkMesh> found = meshesOf(backend, chunks);
      checkSame(expected, found);
      for (const auto& part : drawnOf(found)) CHECK(part == nullptr);
      CHECK(backend.counters().on_cpu == lost.on_cpu + batch * chunks.size());
      const auto brought = backend.upload({&body, 1});
      REQUIRE_FALSE(brought);
      CHECK(brought.error().code == Code::device_lost);
    }
    CHECK(backend.counters().device_lost == 1);
    CHECK(backend.counters().batches == lost.batches);
    CHECK(backend.counters().resident == 0);
    CHECK(backend.batch() == 1);
    CHECK(faulty.faults.counts().empty());
  }
}

}  // namespace

void sgm::checkMeshesThatStay(Faulty& faulty) {
  strikeMeshesThatStay(faulty);
  loseForGood(faulty);
}
