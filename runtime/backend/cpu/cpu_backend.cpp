#include "backend/cpu/cpu_backend.h"

#include <atomic>
#include <exception>
#include <new>

#include "backend/cpu/instruction_sets.h"
#include "backend/cpu/mesh_chunk.h"
#include "base/share_priority.h"

namespace sgm {

namespace {

// Working memory that is reused from chunk to chunk: once every thread has some, a chunk allocates only its mesh.
class ScratchPool {
 public:
  explicit ScratchPool(std::pmr::memory_resource* memory) : memory_(memory) {}
  std::unique_ptr<ChunkScratch> take() {
    std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<ChunkScratch>(memory_);
    std::unique_ptr<ChunkScratch> scratch = std::move(free_.back());
    free_.pop_back();
    return scratch;
  }
  void give(std::unique_ptr<ChunkScratch> scratch) {
    std::lock_guard lock(mutex_);
    free_.push_back(std::move(scratch));
  }

 private:
  std::pmr::memory_resource* memory_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ChunkScratch>> free_;
};

// State that the batch shares with its submitted jobs; the last owner destroys it.
struct BatchState {
  BatchState(const ChunkKernels& kernels_in, std::shared_ptr<ScratchPool> pool_in, std::vector<ChunkJob> jobs_in,
             AfterChunk after_chunk_in, unsigned workers_in, std::pmr::memory_resource* memory_in,
             const Profiler& profiler_in)
      : kernels(kernels_in),
        profiler(profiler_in),
        pool(std::move(pool_in)),
        jobs(std::move(jobs_in)),
        after_chunk(std::move(after_chunk_in)),
        count(jobs.size()),
        workers(workers_in) {
    meshes.reserve(jobs.size());
    for (size_t i = 0; i < count; ++i) meshes.emplace_back(memory_in);
  }

  // Meshes chunks until none is left. Returns at once if enough other threads are working on the batch.
  void run() {
    if (working.fetch_add(1) < workers) {
      for (size_t i; (i = next.fetch_add(1)) < count;) {
        if (cancelled.load(std::memory_order_relaxed)) {
          skipped.store(true);
        } else {
          mesh(i);
        }
        if (ended.fetch_add(1) + 1 == count) {
          std::lock_guard lock(mutex);
          done.notify_all();
        }
      }
    }
    working.fetch_sub(1);
  }

  // Must not throw: an exception would pass through the caller's job system, which may be written in C.
  void mesh(size_t i) noexcept {
    try {
      std::unique_ptr<ChunkScratch> scratch = pool->take();
      {
        const ProfileScope scope(profiler, zone::kMesh);
        meshChunk(kernels, jobs[i], *scratch, meshes[i]);
      }
      pool->give(std::move(scratch));
      // Each thread releases the programs of the chunks that it has meshed; otherwise one thread would release all at
      // the end.
      jobs[i].field.reset();
      jobs[i].coarse.reset();
      if (after_chunk && !after_chunk()) cancelled.store(true);
    } catch (...) {
      std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      cancelled.store(true);
    }
  }

  const ChunkKernels kernels;
  const Profiler profiler;
  std::shared_ptr<ScratchPool> pool;
  std::vector<ChunkJob> jobs;
  AfterChunk after_chunk;
  const size_t count;
  const unsigned workers;
  std::vector<ChunkMesh> meshes;
  std::atomic<size_t> next{0}, ended{0};
  std::atomic<unsigned> working{0};
  std::atomic<bool> cancelled{false}, skipped{false};
  std::exception_ptr error;  // the first exception that a job has thrown
  std::mutex mutex;
  std::condition_variable done;
};

void runShare(void* argument) noexcept {
  const std::unique_ptr<std::shared_ptr<BatchState>> share(static_cast<std::shared_ptr<BatchState>*>(argument));
  (*share)->run();
}

class CpuBatch final : public ChunkBatch {
 public:
  CpuBatch(std::shared_ptr<BatchState> state, JobSystem& jobs) : state_(std::move(state)), jobs_(jobs) {}
  ~CpuBatch() override {
    cancel();
    wait();
    // The job system may start some of the batch's worker jobs only later. They then find no chunk to mesh, but keep
    // the state alive until then, so the memory of its contents is freed now.
    state_->jobs.clear();
    state_->meshes.clear();
    state_->pool.reset();
    state_->after_chunk = {};
  }
  bool poll() override { return state_->ended.load() == state_->count; }
  void wait() override {
    state_->run();
    std::unique_lock lock(state_->mutex);
    helpUntil(jobs_, lock, state_->done, [this] { return poll(); });
  }
  void cancel() override { state_->cancelled.store(true); }
  Result<std::vector<ChunkMesh>> take() override {
    if (state_->error) {
      try {
        std::rethrow_exception(state_->error);
      } catch (const std::bad_alloc&) {
        return Error{Code::out_of_memory, "out of memory while meshing chunks"};
      }
    }
    if (state_->skipped.load()) return Error{Code::cancelled, "meshing was cancelled"};
    return std::move(state_->meshes);
  }

 private:
  std::shared_ptr<BatchState> state_;
  JobSystem& jobs_;
};

class CpuBackend final : public Backend {
 public:
  CpuBackend(const ChunkKernels& kernels, JobSystem& jobs, std::pmr::memory_resource* memory, const Profiler& profiler)
      : kernels_(kernels),
        jobs_(jobs),
        memory_(memory),
        profiler_(profiler),
        pool_(std::make_shared<ScratchPool>(memory)) {
    capabilities_ = {BackendKind::cpu, kernels.field.name, true, jobs.concurrency()};
  }
  const BackendCapabilities& capabilities() const override { return capabilities_; }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk) override {
    const unsigned workers = jobs_.concurrency();
    auto state = std::make_shared<BatchState>(kernels_, pool_, std::move(jobs), std::move(after_chunk), workers,
                                              memory_, profiler_);
    const size_t shares = std::min<size_t>(workers, state->jobs.size());
    auto batch = std::make_unique<CpuBatch>(state, jobs_);
    try {
      for (size_t i = 0; i < shares; ++i) {
        auto share = std::make_unique<std::shared_ptr<BatchState>>(state);
        jobs_.submit(runShare, share.get(), kSharePriority);
        share.release();
      }
    } catch (const std::bad_alloc&) {
      // Memory to submit more worker jobs is missing. So fewer threads mesh this batch; the thread that waits for the
      // batch meshes too.
    }
    return std::unique_ptr<ChunkBatch>(std::move(batch));
  }

 private:
  const ChunkKernels kernels_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  const Profiler profiler_;
  std::shared_ptr<ScratchPool> pool_;
  BackendCapabilities capabilities_;
};

}  // namespace

Result<std::unique_ptr<Backend>> makeCpuBackend(std::string_view instruction_set, JobSystem& jobs,
                                                std::pmr::memory_resource* memory, const Profiler& profiler) {
  const FieldKernels* kernels = instruction_set.empty() ? &bestKernels() : findKernels(instruction_set);
  if (!kernels) {
    std::string known;
    for (const InstructionSet& set : instructionSets()) {
      if (set.runs_here) known += (known.empty() ? "" : ", ") + std::string(set.kernels->name);
    }
    return Error{Code::unsupported, "the CPU backend does not support the instruction set '" +
                                        std::string(instruction_set) + "' on this machine; it supports " + known};
  }
  return std::unique_ptr<Backend>(
      std::make_unique<CpuBackend>(ChunkKernels{*kernels, *findMeshKernels(kernels->name)}, jobs, memory, profiler));
}

}  // namespace sgm
