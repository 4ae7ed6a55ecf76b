#include "cuda/cuda_backend.h"

#include <atomic>
#include <new>
#include <utility>

#include "backend/device_batch.h"
#include "backend/read_chunk.h"
#include "cuda/kept_meshes.h"
#include "cuda/mesher.h"
#include "cuda/placed_meshes.h"

namespace sgm {

namespace cuda {
namespace {

struct Slot final : DeviceSlot {
  explicit Slot(std::pmr::memory_resource* resource) : plan(resource) {}
  Plan plan;
  BatchMemory memory;
  /// the stream to wait for: memory.stream for a batch, memory.reading for copies that are made later
  Stream* awaited = nullptr;
  std::unique_ptr<MeshPlacement> placed;  ///< the memory on the rendering device to which this slot's copies write
};

uint32_t partOf(const Plan::Parts& parts, size_t number) { return number == 0 ? parts.body : parts.seams[number - 1]; }

class Session final : public DeviceSession, public std::enable_shared_from_this<Session> {
 public:
  static Result<std::shared_ptr<DeviceSession>> open(const CudaBackendOptions& options,
                                                     std::pmr::memory_resource* memory) {
    auto session = std::make_shared<Session>(options, memory);
    Result<std::unique_ptr<Device>> device = options.open();
    if (!device) return device.error();
    session->device_ = std::move(*device);
    Result<std::unique_ptr<Mesher>> mesher = Mesher::create(*session->device_, options.room);
    if (!mesher) return mesher.error();
    session->mesher_ = std::move(*mesher);
    if (options.store) {
      Result<std::unique_ptr<PlacedMeshes>> placed = PlacedMeshes::create(*session->device_, options.store);
      if (!placed) return placed.error();
      session->placed_ = std::move(*placed);
    } else if (session->device_->borrowed()) {
      Result<std::unique_ptr<KeptMeshes>> kept = KeptMeshes::create(*session->device_, options.resident_cap);
      if (!kept) return kept.error();
      session->kept_ = std::move(*kept);
    }
    return std::shared_ptr<DeviceSession>(std::move(session));
  }

  Session(const CudaBackendOptions& options, std::pmr::memory_resource* memory)
      : room_(options.room), warn_(options.warn), memory_(memory) {}
  BackendCapabilities capabilities() const override {
    return {BackendKind::cuda, device_->info().name, true, kMaxChunks, false, placed_ || kept_};
  }
  uint32_t batch() const override { return kMaxChunks; }

  std::unique_ptr<DeviceSlot> takeSlot() override {
    return slots_.take([this] { return std::make_unique<Slot>(memory_); });
  }
  void release(std::unique_ptr<DeviceSlot> slot) noexcept override {
    static_cast<Slot&>(*slot).placed.reset();
    slots_.give(std::move(slot));
  }
  size_t plan(std::span<const ChunkJob> jobs, DeviceSlot& slot) override {
    return planBatch(jobs, room_, static_cast<Slot&>(slot).plan);
  }
  std::span<const uint32_t> uniform(const DeviceSlot& slot) const override {
    return static_cast<const Slot&>(slot).plan.uniform;
  }
  bool hasWork(const DeviceSlot& slot) const override { return !static_cast<const Slot&>(slot).plan.chunks.empty(); }

  Result<void> submit(DeviceSlot& base) override {
    auto& slot = static_cast<Slot&>(base);
    // Until submit() succeeds or the stream is idle, the slot counts as stuck: after a failure or exception, work in
    // the stream may still be running, so the slot must not be reused.
    slot.stuck = true;
    Result<void> submitted = mesher_->submit(slot.plan, slot.memory);
    if (submitted) slot.submitted = true;
    slot.awaited = slot.memory.stream.get();
    slot.stuck = !submitted && (!slot.memory.stream || !slot.memory.stream->wait());
    return submitted;
  }
  Result<bool> ended(DeviceSlot& slot) override { return static_cast<Slot&>(slot).awaited->ended(); }
  Result<void> await(DeviceSlot& base) override {
    auto& slot = static_cast<Slot&>(base);
    if (Result<void> waited = slot.awaited->wait(); !waited) return waited;
    // If publishing fails, the meshes are missing on the rendering device, but the CUDA device is not lost: only warn.
    if (const std::unique_ptr<MeshPlacement> placed = std::move(slot.placed)) {
      if (const Result<void> published = placed_->store().publish(*placed); !published) tell(published.error());
    }
    return {};
  }

  Result<bool> read(DeviceSlot& base, std::span<const ChunkJob> jobs, std::span<ChunkMesh> meshes,
                    const std::function<bool(size_t)>& done) override {
    auto& slot = static_cast<Slot&>(base);
    const Result<Mesher::Output> output = mesher_->read(slot.plan, slot.memory);
    if (!output) return output.error();
    std::vector<size_t> staying;
    std::vector<PartSources> sources;
    for (size_t c = 0; c < slot.plan.chunks_of.size(); ++c) {
      const Plan::Parts& parts = slot.plan.chunks_of[c];
      if (!haveRoom(*output, parts)) continue;
      readMesh(*output, parts, output->signs + c * kRows, jobs[parts.job], meshes[parts.job]);
      if ((placed_ || kept_) && jobs[parts.job].resident && !jobs[parts.job].sums_only) {
        staying.push_back(parts.job);
        sources.push_back(sourcesOf(*output, parts, slot.memory));
      }
      if (!done(parts.job)) return false;
    }
    if (staying.empty()) return false;
    const Result<Stream*> reading = mesher_->reading(slot.memory);
    if (!reading) return reading.error();
    slot.awaited = *reading;
    Result<std::vector<DeviceParts>> kept = keep(slot, **reading, sources);
    if (!kept) return kept.error();
    for (size_t i = 0; i < staying.size(); ++i) meshes[staying[i]].on_device = std::move((*kept)[i]);
    return true;
  }

  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    if (placed_) return placed_->store().upload(parts);
    return kept_ ? kept_->upload(shared_from_this(), parts) : DeviceSession::upload(parts);
  }
  uint64_t resident() const override { return placed_ ? placed_->store().bytes() : kept_ ? kept_->bytes() : 0; }

 private:
  Result<std::vector<DeviceParts>> keep(Slot& slot, Stream& stream, std::span<const PartSources> sources) {
    if (!placed_) return kept_->keep(shared_from_this(), stream, sources);
    Result<std::unique_ptr<MeshPlacement>> placed = placed_->keep(stream, sources);
    if (!placed) return placed.error();
    slot.placed = std::move(*placed);
    return slot.placed->chunks;
  }

  static bool haveRoom(const Mesher::Output& output, const Plan::Parts& parts) {
    for (size_t p = 0; p < kMeshParts; ++p) {
      const uint32_t number = partOf(parts, p);
      if (number != kNone && output.parts[number].first_vertex == kNone) return false;
    }
    return true;
  }

  static PartSources sourcesOf(const Mesher::Output& output, const Plan::Parts& parts, const BatchMemory& memory) {
    PartSources sources{};
    for (size_t p = 0; p < sources.size(); ++p) {
      const uint32_t number = partOf(parts, p);
      if (number == kNone) continue;
      const Part& from = output.parts[number];
      sources[p].vertices = reinterpret_cast<const Vertex*>(memory.vertices.data()) + from.first_vertex;
      sources[p].indices = reinterpret_cast<const uint32_t*>(memory.indices.data()) + from.first_index;
      sources[p].vertex_count = from.vertices;
      sources[p].index_count = from.indices;
    }
    return sources;
  }

  static PartSums sumsOf(const Part& part, const Sums& made) {
    PartSums sums;
    sums.triangles = part.indices / 3;
    sums.area = static_cast<int64_t>(made.area);
    for (size_t axis = 0; axis < 3; ++axis) sums.cross[axis] = static_cast<int64_t>(made.cross[axis]);
    sums.six_volumes = static_cast<int64_t>(made.six_volumes);
    return sums;
  }

  static void readMesh(const Mesher::Output& output, const Plan::Parts& parts, const uint64_t* signs,
                       const ChunkJob& job, ChunkMesh& mesh) {
    const auto made = [&](size_t p) -> MadePart {
      const uint32_t number = partOf(parts, p);
      if (number == kNone) return {};
      const Part& part = output.parts[number];
      if (job.sums_only) return {nullptr, nullptr, 0, 0, {}, sumsOf(part, output.sums[number])};
      return {output.vertices + part.first_vertex,
              output.indices + part.first_index,
              part.vertices,
              part.indices,
              {part.hash[0], part.hash[1]},
              {}};
    };
    readChunk(
        job, [signs](uint32_t row) { return signs[row]; }, made, mesh);
  }

  /// Warns, once only, that meshes cannot be moved to the rendering device.
  void tell(const Error& why) noexcept {
    if (!warn_ || told_.exchange(true)) return;
    try {
      warn_("the meshes of CUDA cannot be moved to the drawing device: " + why.message);
    } catch (const std::bad_alloc&) {
      // Memory for the message is missing, so do not warn. The failure still shows: the meshes have no parts on the
      // rendering device.
    }
  }

  const Room room_;
  const std::function<void(const std::string&)> warn_;
  std::atomic<bool> told_{false};
  std::pmr::memory_resource* const memory_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Mesher> mesher_;
  // The storage of meshes that stay on a device: placed_ copies them to the rendering device, kept_ keeps them in the
  // engine's CUDA context. At most one of the two is set.
  std::unique_ptr<PlacedMeshes> placed_;
  std::unique_ptr<KeptMeshes> kept_;
  IdleSlots slots_;
};

}  // namespace
}  // namespace cuda

Result<std::unique_ptr<Backend>> makeCudaBackend(const CudaBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                 std::pmr::memory_resource* memory, const Profiler& profiler) {
  return makeDeviceBackend([options, memory] { return cuda::Session::open(options, memory); }, std::move(cpu), memory,
                           profiler, options.warn);
}

}  // namespace sgm
