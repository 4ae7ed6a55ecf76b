#include "api/runtime.h"

#include "api/barrier.h"
#include "base/short_text.h"

namespace sgm::api {
namespace {

constexpr uint32_t kMaxThreads = 1024;

sgm_result checkVersion(uint32_t version, sgm_error* error) {
  const uint32_t major = version / 1'000'000, minor = version / 1'000 % 1'000;
  const bool same_minor = minor == SGM_VERSION_MINOR;
  const bool known_minor = minor < SGM_VERSION_MINOR + 1;
  if (major == SGM_VERSION_MAJOR && (major == 0 ? same_minor : known_minor)) return SGM_OK;
  return fail(error, SGM_ERR_VERSION,
              "the program was built with header " + std::to_string(major) + "." + std::to_string(minor) +
                  " and runs with library " + sgm_version_string() + ": rebuild it with this library's sgm/sgm.h");
}

sgm_result checkRuntimeDesc(const sgm_runtime_desc& desc, sgm_error* error) {
  if (sgm_result r = checkVersion(desc.api_version, error); r != SGM_OK) return r;
  if (desc.threads > kMaxThreads)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "threads is above " + std::to_string(kMaxThreads));
  if (desc.allocator != nullptr && (desc.allocator->allocate == nullptr || desc.allocator->release == nullptr))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "the allocator needs both allocate and release");
  if (desc.jobs != nullptr && (desc.jobs->concurrency == nullptr || desc.jobs->submit == nullptr))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "the job system needs concurrency and submit");
  if (desc.log != nullptr && desc.log->write == nullptr) return nullArgument(error, "log->write");
  if (desc.profiler != nullptr && (desc.profiler->begin == nullptr || desc.profiler->end == nullptr))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "the profiler needs both begin and end");
  return SGM_OK;
}

}  // namespace

void* CallerMemory::do_allocate(size_t size, size_t alignment) {
  // std containers may request zero bytes, which the caller's allocator need not support.
  const size_t bytes = size == 0 ? 1 : size;
  const uint64_t live = live_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  void* memory = limit_ != 0 && live > limit_ ? nullptr : allocator_.allocate(allocator_.user, bytes, alignment);
  if (memory == nullptr) {
    live_.fetch_sub(bytes, std::memory_order_relaxed);
    throw std::bad_alloc();
  }
  uint64_t peak = peak_.load(std::memory_order_relaxed);
  while (live > peak && !peak_.compare_exchange_weak(peak, live, std::memory_order_relaxed)) {
  }
  return memory;
}

void CallerMemory::do_deallocate(void* memory, size_t size, size_t alignment) {
  const size_t bytes = size == 0 ? 1 : size;
  allocator_.release(allocator_.user, memory, bytes, alignment);
  live_.fetch_sub(bytes, std::memory_order_relaxed);
}

unsigned CallerJobs::concurrency() const {
  const uint32_t count = jobs_.concurrency(jobs_.user);
  return count == 0 ? 1 : count;
}

void CallerJobs::runAccepted(void* argument) {
  const std::unique_ptr<Accepted> job(static_cast<Accepted*>(argument));
  job->function(job->argument);
  CallerJobs& owner = *job->owner;
  const std::lock_guard lock(owner.mutex_);
  if (--owner.waiting_ == 0) owner.ended_.notify_all();
}

void CallerJobs::submit(void (*function)(void*), void* argument, int priority) {
  std::unique_ptr<Accepted> job(new (std::nothrow) Accepted{this, function, argument});
  if (job == nullptr) {
    function(argument);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    ++waiting_;
  }
  if (jobs_.submit(jobs_.user, runAccepted, job.get(), priority) != 0) {
    static_cast<void>(job.release());  // runAccepted now owns the job, and may already have deleted it
  } else {
    runAccepted(job.release());
  }
}

CallerJobs::~CallerJobs() {
  std::unique_lock lock(mutex_);
  helpUntil(*this, lock, ended_, [this] { return waiting_ == 0; });
}

bool CallerJobs::help() { return jobs_.help != nullptr && jobs_.help(jobs_.user) != 0; }

sgm_result refuseEnded(const HandleHead& head, const char* function) noexcept {
  ShortText<128> message;  // stack buffer, because memory may be exhausted
  message.add(function).add(": this handle was already destroyed; nothing was done");
  head.runtime.log(SGM_LOG_ERROR, message.c_str());
  return SGM_ERR_INVALID_ARGUMENT;
}

}  // namespace sgm::api

using namespace sgm::api;

sgm_result sgm_runtime_create(const sgm_runtime_desc* desc, sgm_runtime** out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out == nullptr) return nullArgument(error, "out");
    *out = nullptr;
    const sgm_runtime_desc defaults = SGM_RUNTIME_DESC_INIT;
    if (desc == nullptr) desc = &defaults;
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (sgm_result r = checkRuntimeDesc(*desc, error); r != SGM_OK) return r;

    const bool own_memory = desc->allocator == nullptr;
    const sgm_allocator allocator = own_memory ? systemAllocator() : *desc->allocator;
    void* memory = allocator.allocate(allocator.user, sizeof(sgm_runtime), alignof(sgm_runtime));
    if (memory == nullptr) return fail(error, SGM_ERR_OUT_OF_MEMORY, "out of memory");
    auto release = [&allocator](sgm_runtime* runtime) {
      runtime->~sgm_runtime();
      allocator.release(allocator.user, runtime, sizeof(sgm_runtime), alignof(sgm_runtime));
    };
    std::unique_ptr<sgm_runtime, decltype(release)> runtime(
        new (memory) sgm_runtime(allocator, desc->memory_limit, own_memory), release);
    if (desc->log != nullptr) runtime->sink = *desc->log;
    if (const sgm_profiler* p = desc->profiler; p != nullptr)
      runtime->profiler = {p->begin, p->end, p->thread, p->plot, p->user};
    runtime->pipeline_folder = pathOf(desc->pipeline_folder);
    if (desc->jobs != nullptr) {
      runtime->jobs = std::make_unique<CallerJobs>(*desc->jobs);
    } else {
      sgm::Result<std::unique_ptr<sgm::JobSystem>> pool = sgm::makeThreadPool(desc->threads, runtime->profiler);
      if (!pool) return fail(error, pool.error());
      runtime->jobs = std::move(*pool);
    }
    runtime->plan_turns = std::make_shared<sgm::PlanTurns>(*runtime->jobs);
    runtime->log(SGM_LOG_INFO, sgm_build_info());
    if (desc->jobs == nullptr && runtime->jobs->concurrency() < desc->threads)
      runtime->log(SGM_LOG_WARNING, "this machine lets only " + std::to_string(runtime->jobs->concurrency()) + " of " +
                                        std::to_string(desc->threads) + " threads run");
    *out = runtime.release();
    return SGM_OK;
  });
}

sgm_result sgm_runtime_destroy(sgm_runtime* runtime) {
  if (runtime == nullptr) return SGM_OK;
  if (const uint64_t alive = runtime->children.load(std::memory_order_acquire); alive != 0) {
    sgm::ShortText<128> message;  // stack buffer, because memory may be exhausted
    message.add("sgm_runtime_destroy: handles of this runtime that were not destroyed: ").add(alive);
    runtime->log(SGM_LOG_ERROR, message.c_str());
    return SGM_ERR_BUSY;
  }
  const sgm_allocator allocator = runtime->allocator;
  runtime->~sgm_runtime();
  allocator.release(allocator.user, runtime, sizeof(sgm_runtime), alignof(sgm_runtime));
  return SGM_OK;
}

sgm_result sgm_runtime_memory(const sgm_runtime* runtime, uint64_t* live, uint64_t* peak) {
  if (runtime == nullptr) return SGM_ERR_INVALID_ARGUMENT;
  if (live != nullptr) {
    // Both counters may change between the two reads, so a negative difference is clamped to 0.
    const uint64_t ended = runtime->ended.bytes(), held = runtime->memory.live();
    *live = held > ended ? held - ended : 0;
  }
  if (peak != nullptr) *peak = runtime->memory.peak();
  return SGM_OK;
}
