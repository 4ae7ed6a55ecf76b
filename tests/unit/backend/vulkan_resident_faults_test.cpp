// The device fails, is lost or has no room where meshes stay on it or are brought to it: the meshes are the same, what
// could not stay is not there, and the next batch stays again.

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

/// What draws parts, in the order of the meshes that they were asked for: kMeshParts each.
using Drawn = std::vector<std::shared_ptr<const DevicePart>>;

Drawn drawnOf(const std::vector<ChunkMesh>& meshes) {
  Drawn drawn;
  for (const ChunkMesh& mesh : meshes) drawn.insert(drawn.end(), mesh.on_device.begin(), mesh.on_device.end());
  return drawn;
}

struct Stayed {
  size_t wanted = 0, there = 0;  ///< parts with triangles; of these, on a device
  size_t lost = 0;               ///< of those, on one that was lost
  uint64_t bytes = 0;            ///< on one that was not
};

/// Whatever is there has the right bytes; where whole, all of a chunk is there or nothing.
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
    {"vkAllocateMemory", VK_ERROR_UNKNOWN},  // of which nothing smaller is tried
    {"vkMapMemory", VK_ERROR_MEMORY_MAP_FAILED},
};

/// Meshes that are to stay, on machines that fail once in a while.
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

  /// A batch, or the bringing of its meshes, of which one call may fail.
  void one(bool scarce) {
    // Memory is asked for by those alone that have none yet.
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
  /// The next batch finds a device, and room on it.
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

  unsigned losses = 0;   ///< of devices
  unsigned in_vain = 0;  ///< the device did its work, and yet nothing stayed
  unsigned partly = 0;   ///< some stayed, and some did not

 private:
  /// What was being copied when a wait failed is given back once the copying has ended.
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
  uint64_t largest_ = 0;  ///< bytes of a chunk
};

/// Any call of keeping and of bringing fails, with room enough and with room for some.
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

/// A lent device that was lost is not asked again: the CPU meshes from then on.
void loseForGood(Faulty& faulty) {
  BackendRequest request;
  request.kind = BackendKind::vulkan;
  request.lent = std::make_shared<const vulkan::BorrowedDevice>(faulty.lend());
  const auto jobs = *makeThreadPool(2);
  const auto scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::vector<ChunkJob> chunks = spheres(1, 5);
  for (ChunkJob& job : chunks) job.resident = true;
  const std::vector<ChunkMesh> expected = meshesOf(*scalar, chunks);
  const MeshPart* const body = &expected[0].body;
  // Lost while it meshes, and while meshes are brought.
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
