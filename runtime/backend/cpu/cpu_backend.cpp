#include "backend/cpu/cpu_backend.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>

#include "backend/cpu/instruction_sets.h"
#include "backend/cpu/mesh_chunk.h"

namespace sgm {

namespace {

// Scratch goes from job to job: a chunk allocates nothing but its mesh once every thread has had one.
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

// Shared by the batch and the jobs that it has submitted: the last of them ends it.
struct BatchState {
  BatchState(const FieldKernels& kernels_in, std::shared_ptr<ScratchPool> pool_in, std::vector<ChunkJob> jobs_in,
             std::pmr::memory_resource* memory_in)
      : kernels(kernels_in), pool(std::move(pool_in)), jobs(std::move(jobs_in)), count(jobs.size()) {
    meshes.reserve(jobs.size());
    for (size_t i = 0; i < count; ++i) meshes.emplace_back(memory_in);
  }

  // Takes jobs until none is left; any number of threads.
  void run() {
    for (size_t i; (i = next.fetch_add(1)) < count;) {
      if (cancelled.load(std::memory_order_relaxed)) {
        skipped.store(true);
      } else {
        try {
          std::unique_ptr<ChunkScratch> scratch = pool->take();
          meshChunk(kernels, jobs[i], *scratch, meshes[i]);
          pool->give(std::move(scratch));
        } catch (const std::bad_alloc&) {
          no_memory.store(true);
        }
      }
      if (ended.fetch_add(1) + 1 == count) {
        std::lock_guard lock(mutex);
        done.notify_all();
      }
    }
  }

  const FieldKernels& kernels;
  std::shared_ptr<ScratchPool> pool;
  std::vector<ChunkJob> jobs;
  const size_t count;
  std::vector<ChunkMesh> meshes;
  std::atomic<size_t> next{0}, ended{0};
  std::atomic<bool> cancelled{false}, skipped{false}, no_memory{false};
  std::mutex mutex;
  std::condition_variable done;
};

void runShare(void* argument) {
  const std::unique_ptr<std::shared_ptr<BatchState>> share(static_cast<std::shared_ptr<BatchState>*>(argument));
  (*share)->run();
}

class CpuBatch final : public ChunkBatch {
 public:
  explicit CpuBatch(std::shared_ptr<BatchState> state) : state_(std::move(state)) {}
  ~CpuBatch() override {
    cancel();
    wait();
    // A share that the job system runs later still holds the state, but finds nothing to do: its memory goes now.
    state_->jobs.clear();
    state_->meshes.clear();
    state_->pool.reset();
  }
  bool poll() override { return state_->ended.load() == state_->count; }
  void wait() override {
    state_->run();
    std::unique_lock lock(state_->mutex);
    state_->done.wait(lock, [this] { return poll(); });
  }
  void cancel() override { state_->cancelled.store(true); }
  Result<std::vector<ChunkMesh>> take() override {
    if (state_->no_memory.load()) return Error{Code::out_of_memory, "out of memory while meshing chunks"};
    if (state_->skipped.load()) return Error{Code::cancelled, "meshing was cancelled"};
    return std::move(state_->meshes);
  }

 private:
  std::shared_ptr<BatchState> state_;
};

class CpuBackend final : public Backend {
 public:
  CpuBackend(const FieldKernels& kernels, JobSystem& jobs, std::pmr::memory_resource* memory)
      : kernels_(kernels), jobs_(jobs), memory_(memory), pool_(std::make_shared<ScratchPool>(memory)) {
    capabilities_ = {BackendKind::cpu, kernels.name, true, jobs.concurrency()};
  }
  const BackendCapabilities& capabilities() const override { return capabilities_; }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs) override {
    auto state = std::make_shared<BatchState>(kernels_, pool_, std::move(jobs), memory_);
    const size_t shares = std::min<size_t>(jobs_.concurrency(), state->jobs.size());
    auto batch = std::make_unique<CpuBatch>(state);
    try {
      for (size_t i = 0; i < shares; ++i) {
        auto share = std::make_unique<std::shared_ptr<BatchState>>(state);
        jobs_.submit(runShare, share.get(), 0);
        share.release();
      }
    } catch (const std::bad_alloc&) {
      // Fewer threads then: the one that waits does what is left.
    }
    return std::unique_ptr<ChunkBatch>(std::move(batch));
  }

 private:
  const FieldKernels& kernels_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  std::shared_ptr<ScratchPool> pool_;
  BackendCapabilities capabilities_;
};

}  // namespace

Result<std::unique_ptr<Backend>> makeCpuBackend(std::string_view instruction_set, JobSystem& jobs,
                                                std::pmr::memory_resource* memory) {
  const FieldKernels* kernels = instruction_set.empty() ? &bestKernels() : findKernels(instruction_set);
  if (!kernels) {
    std::string known;
    for (const InstructionSet& set : instructionSets()) {
      if (set.runs_here) known += (known.empty() ? "" : ", ") + std::string(set.kernels->name);
    }
    return Error{Code::unsupported,
                 "the CPU backend has no instruction set '" + std::string(instruction_set) + "' here; it has " + known};
  }
  return std::unique_ptr<Backend>(std::make_unique<CpuBackend>(*kernels, jobs, memory));
}

}  // namespace sgm
