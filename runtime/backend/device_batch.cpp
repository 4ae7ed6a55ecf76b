#include "backend/device_batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>

namespace sgm {

namespace {

struct DeviceCounters {
  std::atomic<uint64_t> chunks{0}, on_cpu{0}, device_lost{0}, batches{0};
};

/// After this many failures in a row, the device is not opened again: each attempt to open it takes longer than a
/// batch.
constexpr unsigned kMaxFailures = 8;

/// State that the backend shares with its batches. It must outlive the batches.
struct DeviceShared {
  OpenSession open;
  std::unique_ptr<Backend> cpu;
  std::pmr::memory_resource* memory;
  Profiler profiler;
  DeviceCounters counters;
  std::mutex mutex;
  /// the open device; null after a loss, until the next batch opens the device again
  std::shared_ptr<DeviceSession> session;
  WarnOf warn;
  std::string name;
  /// The number of losses and failed openings since the last batch that succeeded.
  std::atomic<unsigned> in_vain{0};

  /// Gives up a session whose device is lost, so that the next batch opens the device again.
  void leave(const std::shared_ptr<DeviceSession>& lost, const Error& why) noexcept {
    {
      const std::scoped_lock lock(mutex);
      if (session != lost) return;
      session = nullptr;
      counters.device_lost.fetch_add(1);
      ++in_vain;
    }
    if (!warn) return;
    try {
      warn(name + " was lost, and the CPU continues: " + why.message);
      if (in_vain.load() == kMaxFailures) warn(name + " is no longer used: it was lost repeatedly");
    } catch (const std::bad_alloc&) {
      // There is not enough memory for the message, so no warning is sent; the counter still records the loss.
    }
  }
};

class DeviceBatch final : public ChunkBatch {
 public:
  DeviceBatch(DeviceShared& shared, std::shared_ptr<DeviceSession> session, std::vector<ChunkJob> jobs,
              AfterChunk after_chunk)
      : shared_(shared), session_(std::move(session)), jobs_(std::move(jobs)), after_chunk_(std::move(after_chunk)) {
    meshes_.reserve(jobs_.size());
    for (size_t i = 0; i < jobs_.size(); ++i) meshes_.emplace_back(shared.memory);
    done_.resize(jobs_.size());
  }
  ~DeviceBatch() override {
    cancel();
    rest_.reset();
    releaseSlots();
  }

  /// Submits as many jobs as the device accepts; the CPU does the rest when a thread waits for the batch.
  void submit() {
    const ProfileScope scope(shared_.profiler, zone::kMesh);
    const bool prompt = std::any_of(jobs_.begin(), jobs_.end(), [](const ChunkJob& job) { return job.prompt; });
    size_t first = 0;
    while (session_ && first < jobs_.size()) {
      // Stores the slot in slots_ first. If anything throws later, the destructor waits for the device and returns the
      // slot.
      slots_.reserve(slots_.size() + 1);
      slots_.push_back(session_->takeSlot());
      DeviceSlot& slot = *slots_.back();
      slot.first = first;
      first += session_->plan(std::span<const ChunkJob>(jobs_).subspan(first), slot);
      if (!session_->hasWork(slot)) continue;
      if (prompt && !session_->ready(slot)) break;
      if (const Result<void> submitted = session_->submit(slot); !submitted) {
        note(submitted.error());
        break;
      }
      shared_.counters.batches.fetch_add(1);
    }
  }

  bool poll() override {
    // Only tries to lock: a thread in wait() holds the lock until the end of the batch.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    if (ended_) return true;
    if (!read_) {
      if (!slotsEnded()) return false;
      guarded([&] { readSlots(); });
    }
    if ((rest_ && !rest_->poll()) || !slotsEnded()) return false;
    guarded([&] { end(); });
    return true;
  }
  void wait() override {
    const std::scoped_lock lock(mutex_);
    if (ended_) return;
    guarded([&] {
      if (!read_) readSlots();
      if (rest_) rest_->wait();
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
  void note(const Error& error) {
    if (error.code == Code::device_lost) shared_.leave(session_, error);
  }

  /// Runs `work`. An exception is stored, and take() reports it later: callers of poll() and wait() cannot catch
  /// exceptions.
  template <class Work>
  void guarded(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      if (!error_) error_ = std::current_exception();
    }
  }

  /// Waits for the device to finish the slot. Returns true if the results may be read; if false, the device may still
  /// be using the slot.
  bool awaitSlot(DeviceSlot& slot) {
    if (!slot.submitted) return false;
    const Result<void> ended = session_->await(slot);
    if (!ended) shared_.leave(session_, ended.error());
    slot.stuck = !ended;
    return !slot.stuck;
  }

  bool slotsEnded() {
    for (const std::unique_ptr<DeviceSlot>& slot : slots_) {
      if (!slot || !slot->submitted) continue;
      const Result<bool> ended = session_->ended(*slot);
      // If the query fails, wait() will report the error.
      if (ended && !*ended) return false;
    }
    return true;
  }
  void releaseSlots() {
    for (std::unique_ptr<DeviceSlot>& slot : slots_) {
      if (!slot) continue;
      (void)awaitSlot(*slot);
      session_->release(std::move(slot));
    }
    slots_.clear();
  }

  void readSlots() {
    const ProfileScope scope(shared_.profiler, zone::kMesh);
    read_ = true;
    for (std::unique_ptr<DeviceSlot>& slot : slots_) {
      fillUniform(*slot);
      const bool goes_on = awaitSlot(*slot) && !cancelled_.load() && readSlot(*slot);
      if (!goes_on) session_->release(std::move(slot));
    }
    std::erase(slots_, nullptr);
    startRest();
  }

  void finished(size_t job) {
    done_[job] = true;
    shared_.counters.chunks.fetch_add(1);
    if (after_chunk_ && !after_chunk_()) cancelled_.store(true);
  }

  void fillUniform(const DeviceSlot& slot) {
    for (const uint32_t number : session_->uniform(slot)) {
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

  /// Reads the results of a slot. Returns true if the device has begun further work in the slot: it copies the meshes
  /// that stay on a device.
  bool readSlot(DeviceSlot& slot) {
    const auto done = [&](size_t job) {
      finished(slot.first + job);
      return !cancelled_.load();
    };
    const Result<bool> read = session_->read(slot, std::span<const ChunkJob>(jobs_).subspan(slot.first),
                                             std::span<ChunkMesh>(meshes_).subspan(slot.first), done);
    if (read) shared_.in_vain.store(0);
    if (!read) note(read.error());
    return read && *read;
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

  /// Ends the batch: waits for the device, and takes the meshes that the CPU has made for the other jobs.
  void end() {
    ended_ = true;
    // Waits for the copies of meshes that stay on the device, then returns the slots for use by other batches.
    releaseSlots();
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

  DeviceShared& shared_;
  std::shared_ptr<DeviceSession> session_;
  std::vector<ChunkJob> jobs_;
  AfterChunk after_chunk_;
  std::vector<ChunkMesh> meshes_;
  std::vector<bool> done_;
  /// slots of this batch; after reading, only those in which the device still works
  std::vector<std::unique_ptr<DeviceSlot>> slots_;
  std::unique_ptr<ChunkBatch> rest_;  ///< batch of the CPU, with the jobs that the device has not done
  std::vector<size_t> numbers_;       ///< for each job of rest_: its index in this batch
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  bool read_ = false, ended_ = false, skipped_ = false;
  std::exception_ptr error_;
};

class DeviceBackend final : public Backend {
 public:
  DeviceBackend(OpenSession open, std::shared_ptr<DeviceSession> session, std::unique_ptr<Backend> cpu,
                std::pmr::memory_resource* memory, const Profiler& profiler, WarnOf warn)
      : capabilities_(session->capabilities()) {
    shared_.open = std::move(open);
    shared_.warn = std::move(warn);
    shared_.name = capabilities_.device;
    shared_.cpu = std::move(cpu);
    shared_.memory = memory;
    shared_.profiler = profiler;
    shared_.session = std::move(session);
  }
  const BackendCapabilities& capabilities() const override { return capabilities_; }
  BackendCounters counters() const override {
    const DeviceCounters& c = shared_.counters;
    std::shared_ptr<DeviceSession> session;
    {
      const std::scoped_lock lock(shared_.mutex);
      session = shared_.session;
    }
    const uint64_t resident = session ? session->resident() : 0;
    return {c.chunks.load(), c.on_cpu.load(), c.device_lost.load(), c.batches.load(), resident};
  }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk) override {
    auto batch = std::make_unique<DeviceBatch>(shared_, session(), std::move(jobs), std::move(after_chunk));
    batch->submit();
    return std::unique_ptr<ChunkBatch>(std::move(batch));
  }
  uint32_t batch() const override {
    // The lock is only tried, not awaited: another thread may hold it for a long time, while it opens the device.
    const std::unique_lock lock(shared_.mutex, std::try_to_lock);
    return lock && shared_.session ? shared_.session->batch() : 1;
  }
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    const std::shared_ptr<DeviceSession> current = session();
    if (!current) return Error{Code::device_lost, "the GPU was lost and could not be opened again"};
    auto brought = current->upload(parts);
    if (!brought && brought.error().code == Code::device_lost) shared_.leave(current, brought.error());
    return brought;
  }

 private:
  /// Returns the session; after a loss, opens a new one. Null if the device cannot be opened.
  std::shared_ptr<DeviceSession> session() {
    const std::scoped_lock lock(shared_.mutex);
    if (shared_.session || shared_.in_vain.load() >= kMaxFailures) return shared_.session;
    if (Result<std::shared_ptr<DeviceSession>> opened = shared_.open()) {
      shared_.session = std::move(*opened);
    } else {
      ++shared_.in_vain;
    }
    return shared_.session;
  }

  mutable DeviceShared shared_;
  const BackendCapabilities capabilities_;
};

}  // namespace

Result<std::unique_ptr<Backend>> makeDeviceBackend(OpenSession open, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler,
                                                   WarnOf warn) {
  Result<std::shared_ptr<DeviceSession>> session = open();
  if (!session) return session.error();
  return std::unique_ptr<Backend>(std::make_unique<DeviceBackend>(std::move(open), std::move(*session), std::move(cpu),
                                                                  memory, profiler, std::move(warn)));
}

}  // namespace sgm
