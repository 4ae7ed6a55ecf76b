#include "backend/vulkan/vulkan_backend.h"

#include <utility>

#include "backend/device_batch.h"
#include "backend/vulkan/read_meshes.h"

namespace sgm {

namespace vulkan {
namespace {

/// Number of chunks per batch, on hardware and on software devices. A GPU needs large batches to fill its many
/// invocations. A software device has only a few CPU threads, so a larger batch would only take longer.
constexpr uint32_t kBatch = 64, kSoftwareBatch = 8;

struct Slot final : DeviceSlot {
  explicit Slot(std::pmr::memory_resource* resource) : plan(resource) {}
  BatchPlan plan;
  BatchBuffers buffers;
  uint64_t value = 0;  ///< the device uses the slot until the queue's timeline reaches this value
};

class Session final : public DeviceSession, public std::enable_shared_from_this<Session> {
 public:
  static Result<std::shared_ptr<DeviceSession>> open(const VulkanBackendOptions& options,
                                                     std::pmr::memory_resource* memory, const Profiler& profiler) {
    const auto session = std::make_shared<Session>(options.room, memory);
    if (const Result<void> made = session->make(options, profiler); !made) return made.error();
    return std::shared_ptr<DeviceSession>(session);
  }

  Session(const BatchRoom& room, std::pmr::memory_resource* resource) : room_(room), resource_(resource) {}
  ~Session() override {
    if (queue_) queue_->drain();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  BackendCapabilities capabilities() const override {
    const DeviceInfo& info = device_->info();
    return {BackendKind::vulkan, info.name, info.exact, kBatch, info.software(), device_->borrowed()};
  }
  uint32_t batch() const override {
    if (kernels_->making()) return 1;
    return device_->info().software() ? kSoftwareBatch : kBatch;
  }

  std::unique_ptr<DeviceSlot> takeSlot() override {
    return slots_.take([this] { return std::make_unique<Slot>(resource_); });
  }
  void release(std::unique_ptr<DeviceSlot> slot) noexcept override { slots_.give(std::move(slot)); }
  size_t plan(std::span<const ChunkJob> jobs, DeviceSlot& slot) override {
    return planBatch(jobs, room_, mesher_->maxScratchWords(), static_cast<Slot&>(slot).plan);
  }
  std::span<const uint32_t> uniform(const DeviceSlot& slot) const override {
    return static_cast<const Slot&>(slot).plan.uniform;
  }
  bool hasWork(const DeviceSlot& slot) const override { return !static_cast<const Slot&>(slot).plan.chunks.empty(); }
  bool ready(const DeviceSlot& slot) noexcept override {
    return kernels_->ready(static_cast<const Slot&>(slot).plan.kinds);
  }

  Result<void> submit(DeviceSlot& base) override {
    auto& slot = static_cast<Slot&>(base);
    // Waits until the downloads of the slot's previous batch have ended. Usually read() has waited already, but it
    // gives up if the driver runs out of memory.
    if (Result<void> brought = reach(slot.buffers.reading); !brought) {
      slot.stuck = true;
      return brought;
    }
    const Result<uint64_t> value = mesher_->submit(slot.plan, slot.buffers);
    if (!value) return value.error();
    slot.value = *value;
    slot.submitted = true;
    return {};
  }
  Result<bool> ended(DeviceSlot& slot) override {
    const Result<uint64_t> reached = queue_->reached();
    if (!reached) return reached.error();
    return *reached >= static_cast<Slot&>(slot).value;
  }
  Result<void> await(DeviceSlot& slot) override { return reach(static_cast<Slot&>(slot).value); }

  Result<bool> read(DeviceSlot& base, std::span<const ChunkJob> jobs, std::span<ChunkMesh> meshes,
                    const std::function<bool(size_t)>& done) override {
    auto& slot = static_cast<Slot&>(base);
    const Result<Mesher::Output> output = mesher_->read(slot.plan, slot.buffers);
    if (!output) return output.error();
    std::vector<size_t> staying;
    std::vector<PartSources> sources;
    for (size_t c = 0; c < slot.plan.chunks.size(); ++c) {
      const size_t job = slot.plan.chunks[c].job;
      if (!readMesh(slot.plan, *output, c, jobs[job], meshes[job])) continue;
      if (kept_ && jobs[job].resident && !jobs[job].sums_only) {
        staying.push_back(job);
        sources.push_back(sourcesOf(slot.plan, *output, c, slot.buffers));
      }
      if (!done(job)) return false;
    }
    if (staying.empty()) return false;
    // After a failure, the caller uploads the parts later, provided that they are to be on the device.
    Result<KeptParts> kept = kept_->keep(shared_from_this(), sources);
    if (!kept) return kept.error();
    for (size_t i = 0; i < staying.size(); ++i) meshes[staying[i]].on_device = std::move(kept->chunks[i]);
    slot.value = kept->value;
    return slot.value > 0;
  }

  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    return kept_ ? kept_->upload(shared_from_this(), parts) : DeviceSession::upload(parts);
  }
  uint64_t resident() const override { return kept_ ? kept_->bytes() : 0; }

 private:
  Result<void> make(const VulkanBackendOptions& options, const Profiler& profiler) {
    Result<std::unique_ptr<Device>> device = options.open();
    if (!device) return device.error();
    device_ = std::move(*device);
    auto queue = Queue::create(*device_);
    if (!queue) return queue.error();
    queue_ = std::move(*queue);
    memory_ = std::make_unique<Memory>(*device_, options.memory);
    auto ring = CommandRing::create(*queue_);
    if (!ring) return ring.error();
    ring_ = std::move(*ring);
    if (!options.pipeline_folder.empty()) {
      // If the cache cannot be created, pipelines are compiled in each run; everything else works.
      if (auto cache = PipelineCache::create(*device_, options.pipeline_folder)) {
        cache_ = std::move(*cache);
      } else if (options.warn) {
        options.warn("compiled pipelines are not cached: " + cache.error().message);
      }
    }
    kernels_ = std::make_unique<Kernels>(*device_, cache_.get(), profiler, KernelNews{options.inform, options.warn});
    auto mesher = Mesher::create(*queue_, *memory_, *ring_, *kernels_);
    if (!mesher) return mesher.error();
    mesher_ = std::move(*mesher);
    if (!device_->borrowed()) return {};
    MemoryOptions kept = options.memory;
    kept.cap = options.resident_cap;
    kept.families = device_->readers();
    kept_memory_ = std::make_unique<Memory>(*device_, kept);
    kept_ = std::make_unique<DeviceMeshes>(*queue_, *kept_memory_, *memory_, *ring_);
    return {};
  }

  /// Waits until the queue has reached the timeline value. Tries twice, since the driver may have been out of memory.
  Result<void> reach(uint64_t value) const {
    if (queue_->wait(value)) return {};
    const Result<bool> reached = queue_->wait(value);
    if (!reached) return reached.error();
    return {};
  }

  const BatchRoom room_;
  std::pmr::memory_resource* const resource_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Queue> queue_;
  std::unique_ptr<Memory> memory_;
  std::unique_ptr<CommandRing> ring_;
  std::unique_ptr<PipelineCache> cache_;  // null: pipelines are not cached
  std::unique_ptr<Kernels> kernels_;
  std::unique_ptr<Mesher> mesher_;
  // memory for meshes that stay on the device; null if the device is not the engine's
  std::unique_ptr<Memory> kept_memory_;
  std::unique_ptr<DeviceMeshes> kept_;  // the meshes that stay on the device; null if the device is not the engine's
  IdleSlots slots_;
};

}  // namespace
}  // namespace vulkan

Result<std::unique_ptr<Backend>> makeVulkanBackend(const VulkanBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler) {
  return makeDeviceBackend([options, memory, profiler] { return vulkan::Session::open(options, memory, profiler); },
                           std::move(cpu), memory, profiler, options.warn);
}

}  // namespace sgm
