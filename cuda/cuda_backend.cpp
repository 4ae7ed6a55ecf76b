#include "cuda/cuda_backend.h"

#include <bit>
#include <utility>

#include "backend/device_batch.h"
#include "cuda/kept_meshes.h"
#include "cuda/mesher.h"
#include "mesh/vertex_keys.h"

namespace sgm {

namespace cuda {
namespace {

struct Slot final : DeviceSlot {
  explicit Slot(std::pmr::memory_resource* resource) : plan(resource) {}
  Plan plan;
  BatchMemory memory;
};

/// Fills a part from the batch's.
void readPart(const Mesher::Output& output, uint32_t number, const ChunkJob& job, int part_of_chunk, MeshPart& part) {
  const Part& from = output.parts[number];
  part.vertices.assign(output.vertices + from.first_vertex, output.vertices + from.first_vertex + from.vertices);
  part.indices.assign(output.indices + from.first_index, output.indices + from.first_index + from.indices);
  part.hash = {from.hash[0], from.hash[1]};
  deriveKeys(job.grid, part_of_chunk, job.coarser, part);
}

/// What signs say of a chunk; whether anything is to be drawn.
bool readSigns(const uint64_t* signs, const ChunkJob& job, ChunkMesh& mesh) {
  constexpr uint64_t kLower = (uint64_t{1} << kChunkCells) - 1;
  uint32_t all = 0;
  for (uint32_t row = 0; row < kRows; ++row) {
    all += static_cast<uint32_t>(std::popcount(signs[row]));
    const bool lower = row % kSide < kChunkCells && row / kSide < kChunkCells;
    if (lower) mesh.solid_samples += static_cast<uint32_t>(std::popcount(signs[row] & kLower));
  }
  mesh.uniform = all == 0 || all == kSamples;
  if (job.signs && !mesh.uniform) mesh.signs.assign(signs, signs + kRows);
  return !mesh.uniform;
}

class Session final : public DeviceSession, public std::enable_shared_from_this<Session> {
 public:
  static Result<std::shared_ptr<DeviceSession>> open(const CudaBackendOptions& options,
                                                     std::pmr::memory_resource* memory) {
    auto session = std::make_shared<Session>(options.room, memory);
    Result<std::unique_ptr<Device>> device = options.open();
    if (!device) return device.error();
    session->device_ = std::move(*device);
    Result<std::unique_ptr<Mesher>> mesher = Mesher::create(*session->device_, options.room);
    if (!mesher) return mesher.error();
    session->mesher_ = std::move(*mesher);
    if (session->device_->borrowed()) {
      Result<std::unique_ptr<KeptMeshes>> kept = KeptMeshes::create(*session->device_, options.resident_cap);
      if (!kept) return kept.error();
      session->kept_ = std::move(*kept);
    }
    return std::shared_ptr<DeviceSession>(std::move(session));
  }

  Session(const Room& room, std::pmr::memory_resource* memory) : room_(room), memory_(memory) {}
  BackendCapabilities capabilities() const override {
    return {BackendKind::cuda, device_->info().name, true, kMostChunks, false, device_->borrowed()};
  }
  uint32_t batch() const override { return kMostChunks; }

  std::unique_ptr<DeviceSlot> takeSlot() override {
    return slots_.take([this] { return std::make_unique<Slot>(memory_); });
  }
  void release(std::unique_ptr<DeviceSlot> slot) noexcept override { slots_.give(std::move(slot)); }
  size_t plan(std::span<const ChunkJob> jobs, DeviceSlot& slot) override {
    return planBatch(jobs, room_, static_cast<Slot&>(slot).plan);
  }
  std::span<const uint32_t> uniform(const DeviceSlot& slot) const override {
    return static_cast<const Slot&>(slot).plan.uniform;
  }
  bool hasWork(const DeviceSlot& slot) const override { return !static_cast<const Slot&>(slot).plan.chunks.empty(); }

  Result<void> submit(DeviceSlot& base) override {
    auto& slot = static_cast<Slot&>(base);
    // What was given to the stream before something fails, or is thrown, may run still: the slot is not used again.
    slot.stuck = true;
    Result<void> submitted = mesher_->submit(slot.plan, slot.memory);
    if (submitted) slot.submitted = true;
    slot.stuck = !submitted && (!slot.memory.stream || !slot.memory.stream->wait());
    return submitted;
  }
  Result<bool> ended(DeviceSlot& slot) override { return static_cast<Slot&>(slot).memory.stream->ended(); }
  Result<void> await(DeviceSlot& slot) override { return static_cast<Slot&>(slot).memory.stream->wait(); }

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
      if (kept_ && jobs[parts.job].resident) {
        staying.push_back(parts.job);
        sources.push_back(sourcesOf(*output, parts, slot.memory));
      }
      if (!done(parts.job)) return false;
    }
    if (staying.empty()) return false;
    Result<std::vector<DeviceParts>> kept = kept_->keep(shared_from_this(), *slot.memory.stream, sources);
    if (!kept) return kept.error();
    for (size_t i = 0; i < staying.size(); ++i) meshes[staying[i]].on_device = std::move((*kept)[i]);
    return true;
  }

  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    return kept_ ? kept_->upload(shared_from_this(), parts) : DeviceSession::upload(parts);
  }
  uint64_t resident() const override { return kept_ ? kept_->bytes() : 0; }

 private:
  static bool haveRoom(const Mesher::Output& output, const Plan::Parts& parts) {
    const auto hasRoom = [&](uint32_t part) { return part == kNone || output.parts[part].first_vertex != kNone; };
    bool all = hasRoom(parts.body);
    for (const uint32_t seam : parts.seams) all = all && hasRoom(seam);
    return all;
  }

  static PartSources sourcesOf(const Mesher::Output& output, const Plan::Parts& parts, const BatchMemory& memory) {
    PartSources sources{};
    for (size_t p = 0; p < sources.size(); ++p) {
      const uint32_t number = p == 0 ? parts.body : parts.seams[p - 1];
      if (number == kNone) continue;
      const Part& from = output.parts[number];
      sources[p].vertices = reinterpret_cast<const Vertex*>(memory.vertices.data()) + from.first_vertex;
      sources[p].indices = reinterpret_cast<const uint32_t*>(memory.indices.data()) + from.first_index;
      sources[p].vertex_count = from.vertices;
      sources[p].index_count = from.indices;
    }
    return sources;
  }

  void readMesh(const Mesher::Output& output, const Plan::Parts& parts, const uint64_t* signs, const ChunkJob& job,
                ChunkMesh& mesh) const {
    if (job.body && readSigns(signs, job, mesh)) readPart(output, parts.body, job, 0, mesh.body);
    if (job.seams == 0) return;
    mesh.seams.reserve(6);
    for (size_t face = 0; face < 6; ++face) {
      MeshPart& seam = mesh.seams.emplace_back(memory_);
      const uint32_t number = parts.seams[face];
      if (number == kNone || output.parts[number].vertices == 0) continue;
      readPart(output, number, job, 1 + static_cast<int>(face), seam);
    }
  }

  const Room room_;
  std::pmr::memory_resource* const memory_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Mesher> mesher_;
  std::unique_ptr<KeptMeshes> kept_;  // null where nobody could draw them
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
