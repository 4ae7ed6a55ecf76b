#include "backend/vulkan/vulkan_backend.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>

#include "backend/vulkan/read_meshes.h"
#include "backend/vulkan/session.h"

namespace sgm {

namespace {

using vulkan::Mesher;
using vulkan::Session;
using vulkan::Slot;

/// What the many invocations of a device take; where they run on few threads, each batch only takes longer.
constexpr uint32_t kBatch = 64, kSoftwareBatch = 8;

struct Counters {
  std::atomic<uint64_t> chunks{0}, on_cpu{0}, device_lost{0}, batches{0};
};

/// What batches share with the backend, which they must not outlive.
struct Shared {
  VulkanBackendOptions options;
  std::unique_ptr<Backend> cpu;
  std::pmr::memory_resource* memory;
  Profiler profiler;
  Counters counters;
  std::atomic<bool> warned{false};  ///< that pipelines cannot be kept; once is enough
  std::mutex mutex;
  std::shared_ptr<Session> session;  ///< null: lost, and not open again
  std::atomic<bool> open{true};      ///< there is one; for who must not wait while it is opened
};

class VulkanBatch final : public ChunkBatch {
 public:
  VulkanBatch(Shared& shared, std::shared_ptr<Session> session, std::vector<ChunkJob> jobs, AfterChunk after_chunk)
      : shared_(shared), session_(std::move(session)), jobs_(std::move(jobs)), after_chunk_(std::move(after_chunk)) {
    meshes_.reserve(jobs_.size());
    for (size_t i = 0; i < jobs_.size(); ++i) meshes_.emplace_back(shared.memory);
    done_.resize(jobs_.size());
  }
  ~VulkanBatch() override {
    cancel();
    rest_.reset();
    for (std::unique_ptr<Slot>& slot : slots_) {
      if (!slot) continue;
      (void)awaitSlot(*slot);
      session_->release(slot);
    }
  }

  /// Hands the jobs to the device, as many as it takes; the CPU does the rest when the batch is waited for.
  void submit() {
    const ProfileScope scope(shared_.profiler, zone::kMesh);
    size_t first = 0;
    while (session_ && first < jobs_.size()) {
      // Whatever is thrown, the slot goes back by our end: the device may be at work in it.
      slots_.reserve(slots_.size() + 1);
      slots_.push_back(session_->takeSlot(shared_.memory));
      Slot& slot = *slots_.back();
      slot.first = first;
      const auto rest = std::span<const ChunkJob>(jobs_).subspan(first);
      first += planBatch(rest, shared_.options.room, session_->mesher->mostScratchWords(), slot.plan);
      if (slot.plan.chunks.empty()) continue;
      if (const Result<void> submitted = submitSlot(slot); !submitted) {
        note(submitted.error());
        session_->release(slots_.back());
        slots_.pop_back();
        break;
      }
    }
    keepPipelines();
  }

  bool poll() override {
    // Whoever waits holds the lock until the end.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    if (ended_) return true;
    if (!read_) {
      for (const std::unique_ptr<Slot>& slot : slots_) {
        if (slot->value == 0) continue;
        const Result<uint64_t> reached = session_->queue->reached();
        if (reached && *reached < slot->value) return false;
      }
      guarded([&] { readSlots(); });
    }
    if (rest_ && !rest_->poll()) return false;
    if (const Result<uint64_t> reached = session_ ? session_->queue->reached() : kept_; reached && *reached < kept_) {
      return false;
    }
    guarded([&] { end(); });
    return true;
  }
  void wait() override {
    const std::scoped_lock lock(mutex_);
    if (ended_) return;
    guarded([&] {
      if (!read_) readSlots();
      if (rest_) rest_->wait();
      // Whoever draws these meshes does not wait for what was submitted between them and their copies.
      if (kept_ > 0) static_cast<void>(session_->reach(kept_));
    });
    guarded([&] { end(); });
  }
  void cancel() override { cancelled_.store(true); }
  Result<std::vector<ChunkMesh>> take() override {
    if (error_) {
      try {
        std::rethrow_exception(error_);
      } catch (const std::bad_alloc&) {
        return Error{Code::out_of_memory, "out of memory while meshing chunks"};
      }
    }
    if (skipped_) return Error{Code::cancelled, "meshing was cancelled"};
    return std::move(meshes_);
  }

 private:
  Result<void> submitSlot(Slot& slot) {
    // Also what was given up to wait for, when the driver was out of memory.
    if (const Result<bool> copied = session_->reach(std::max(slot.kept, slot.buffers.reading)); !copied) {
      slot.stuck = true;
      return copied.error();
    }
    const Result<uint64_t> value = session_->mesher->submit(slot.plan, slot.buffers);
    if (!value) return value.error();
    slot.value = *value;
    shared_.counters.batches.fetch_add(1);
    return {};
  }
  void note(const Error& error) {
    if (error.code == Code::device_lost) leave();
  }
  /// Where they are new, and at once: whoever ends the process later would lose them.
  void keepPipelines() {
    if (!session_ || !session_->cache || !session_->mesher->madePipelines()) return;
    const Result<void> saved = session_->cache->save();
    if (saved || !shared_.options.warn || shared_.warned.exchange(true)) return;
    shared_.options.warn("compiled pipelines are not kept: " + saved.error().message);
  }
  /// The next batch opens the device anew.
  void leave() {
    const std::scoped_lock lock(shared_.mutex);
    if (shared_.session == session_) {
      shared_.session = nullptr;
      shared_.open.store(false);
      shared_.counters.device_lost.fetch_add(1);
    }
  }

  /// poll() and wait() are called where there is nobody to catch anything.
  template <class Work>
  void guarded(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      if (!error_) error_ = std::current_exception();
    }
  }

  /// Waits for the slot; whether what the device has left in it may be read. Where not, it may be in use still.
  bool awaitSlot(Slot& slot) {
    if (slot.value == 0) return false;
    const Result<bool> ended = session_->reach(slot.value);
    if (!ended) leave();
    slot.stuck = !ended;
    return !slot.stuck;
  }

  void readSlots() {
    const ProfileScope scope(shared_.profiler, zone::kMesh);
    read_ = true;
    for (std::unique_ptr<Slot>& slot : slots_) {
      fillUniform(*slot);
      if (awaitSlot(*slot) && !cancelled_.load()) readSlot(*slot);
      session_->release(slot);
    }
    slots_.clear();
    startRest();
  }

  void finished(size_t job) {
    done_[job] = true;
    shared_.counters.chunks.fetch_add(1);
    if (after_chunk_ && !after_chunk_()) cancelled_.store(true);
  }

  void fillUniform(const Slot& slot) {
    for (const uint32_t number : slot.plan.uniform) {
      if (cancelled_.load()) return;
      const ChunkJob& job = jobs_[slot.first + number];
      ChunkMesh& mesh = meshes_[slot.first + number];
      if (job.body) {
        mesh.uniform = true;
        mesh.solid_samples = job.field->initial < 0 ? kChunkCells * kChunkCells * kChunkCells : 0;
      }
      if (job.seams != 0) mesh.seams.reserve(6);
      for (int face = 0; job.seams != 0 && face < 6; ++face) mesh.seams.emplace_back(shared_.memory);
      finished(slot.first + number);
    }
  }

  void readSlot(Slot& slot) {
    const Result<Mesher::Output> output = session_->mesher->read(slot.buffers);
    if (!output) return note(output.error());
    for (size_t c = 0; c < slot.plan.chunks.size() && !cancelled_.load(); ++c) {
      const size_t job = slot.first + slot.plan.chunks[c].job;
      if (!vulkan::readMesh(slot.plan, *output, c, jobs_[job], meshes_[job])) continue;
      finished(job);
    }
    if (!cancelled_.load()) keepMeshes(slot, *output);
  }

  /// Copies what is to stay to its own place on the device. What cannot be, is uploaded by whoever wants it there.
  void keepMeshes(Slot& slot, const Mesher::Output& output) {
    if (!session_->kept) return;
    std::vector<size_t> of;
    std::vector<vulkan::PartSources> sources;
    for (size_t c = 0; c < slot.plan.chunks.size(); ++c) {
      const size_t job = slot.first + slot.plan.chunks[c].job;
      if (!jobs_[job].resident || !done_[job]) continue;
      of.push_back(job);
      sources.push_back(vulkan::sourcesOf(slot.plan, output, c, slot.buffers));
    }
    if (of.empty()) return;
    Result<vulkan::KeptParts> kept = session_->kept->keep(session_, sources);
    if (!kept) return note(kept.error());
    kept_ = slot.kept = kept->value;
    for (size_t i = 0; i < of.size(); ++i) meshes_[of[i]].on_device = std::move(kept->chunks[i]);
  }

  void startRest() {
    std::vector<ChunkJob> rest;
    for (size_t i = 0; i < jobs_.size(); ++i) {
      if (done_[i]) continue;
      rest.push_back(jobs_[i]);
      numbers_.push_back(i);
    }
    if (rest.empty()) return;
    skipped_ = cancelled_.load();
    if (skipped_) return;
    Result<std::unique_ptr<ChunkBatch>> batch = shared_.cpu->submit(
        std::move(rest), [this] { return (!after_chunk_ || after_chunk_()) && !cancelled_.load(); });
    if (!batch) throw std::bad_alloc();
    rest_ = std::move(*batch);
  }

  /// Takes what the CPU has made of the rest.
  void end() {
    ended_ = true;
    const std::unique_ptr<ChunkBatch> rest = std::move(rest_);
    if (!rest) return;
    Result<std::vector<ChunkMesh>> meshes = rest->take();
    if (!meshes && meshes.error().code == Code::out_of_memory) throw std::bad_alloc();
    skipped_ = !meshes;
    if (skipped_) return;
    for (size_t i = 0; i < numbers_.size(); ++i) meshes_[numbers_[i]] = std::move((*meshes)[i]);
    shared_.counters.chunks.fetch_add(numbers_.size());
    shared_.counters.on_cpu.fetch_add(numbers_.size());
  }

  Shared& shared_;
  std::shared_ptr<Session> session_;
  std::vector<ChunkJob> jobs_;
  AfterChunk after_chunk_;
  std::vector<ChunkMesh> meshes_;
  std::vector<bool> done_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::unique_ptr<ChunkBatch> rest_;  ///< what the device has not done, on the CPU
  std::vector<size_t> numbers_;       ///< of the rest's jobs
  uint64_t kept_ = 0;                 ///< of the queue: all parts that stay are at their places then
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  bool read_ = false, ended_ = false, skipped_ = false;
  std::exception_ptr error_;
};

class VulkanBackend final : public Backend {
 public:
  VulkanBackend(const VulkanBackendOptions& options, std::unique_ptr<Backend> cpu, std::pmr::memory_resource* memory,
                const Profiler& profiler, std::shared_ptr<Session> session) {
    shared_.options = options;
    shared_.cpu = std::move(cpu);
    shared_.memory = memory;
    shared_.profiler = profiler;
    const vulkan::DeviceInfo& info = session->device->info();
    capabilities_ = {BackendKind::vulkan, info.name, info.exact, 64, info.software(), session->device->borrowed()};
    shared_.session = std::move(session);
  }
  const BackendCapabilities& capabilities() const override { return capabilities_; }
  BackendCounters counters() const override {
    const Counters& c = shared_.counters;
    const std::scoped_lock lock(shared_.mutex);
    const bool keeps = shared_.session && shared_.session->kept;
    return {c.chunks.load(), c.on_cpu.load(), c.device_lost.load(), c.batches.load(),
            keeps ? shared_.session->kept->bytes() : 0};
  }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk) override {
    auto batch = std::make_unique<VulkanBatch>(shared_, session(), std::move(jobs), std::move(after_chunk));
    batch->submit();
    return std::unique_ptr<ChunkBatch>(std::move(batch));
  }
  uint32_t batch() const override {
    if (!shared_.open.load()) return 1;
    return capabilities_.software ? kSoftwareBatch : kBatch;
  }
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    const std::shared_ptr<Session> current = session();
    if (!current) return Error{Code::device_lost, "the GPU was lost, and could not be opened again"};
    if (!current->kept) return Backend::upload(parts);
    return current->kept->upload(current, parts);
  }

 private:
  /// The one there is, or after a loss a new one; null where there is none to be had.
  std::shared_ptr<Session> session() {
    const std::scoped_lock lock(shared_.mutex);
    if (shared_.session) return shared_.session;
    if (Result<std::shared_ptr<Session>> opened = Session::open(shared_.options)) shared_.session = std::move(*opened);
    shared_.open.store(shared_.session != nullptr);
    return shared_.session;
  }

  mutable Shared shared_;
  BackendCapabilities capabilities_;
};

}  // namespace

Result<std::unique_ptr<Backend>> makeVulkanBackend(const VulkanBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler) {
  Result<std::shared_ptr<Session>> session = Session::open(options);
  if (!session) return session.error();
  return std::unique_ptr<Backend>(
      std::make_unique<VulkanBackend>(options, std::move(cpu), memory, profiler, std::move(*session)));
}

}  // namespace sgm
