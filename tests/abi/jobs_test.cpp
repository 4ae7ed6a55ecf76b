// Tests that the library works with any job system that fulfils the contract, however it schedules jobs.

#include <chrono>
#include <deque>
#include <mutex>
#include <thread>

#include "fixture.h"

namespace {

struct Job {
  void (*function)(void*);
  void* argument;
};

/// A job system with one thread that takes a job now and then, the newest first. If it supports help, waiting callers
/// run the other jobs.
struct Lazy {
  std::mutex mutex;
  std::deque<Job> waiting;
  bool helps;
  bool stopping = false;
  std::thread thread{[this] { work(); }};

  explicit Lazy(bool helps_in) : helps(helps_in) {}
  ~Lazy() {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
    }
    thread.join();
    CHECK(waiting.empty());
  }
  bool runOne() {
    Job job{};
    {
      const std::lock_guard lock(mutex);
      if (waiting.empty()) return false;
      job = waiting.back();
      waiting.pop_back();
    }
    job.function(job.argument);
    return true;
  }
  void work() {
    for (;;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const bool ran = runOne();
      const std::lock_guard lock(mutex);
      if (stopping && !ran && waiting.empty()) return;
    }
  }
};

sgm_job_system table(Lazy& lazy) {
  return {[](void*) -> uint32_t { return 4; },
          [](void* user, void (*function)(void*), void* argument, int32_t) -> int32_t {
            auto& l = *static_cast<Lazy*>(user);
            const std::lock_guard lock(l.mutex);
            l.waiting.push_back({function, argument});
            return 1;
          },
          [](void* user) -> int32_t {
            auto& l = *static_cast<Lazy*>(user);
            return l.helps && l.runOne() ? 1 : 0;
          },
          &lazy};
}

/// Returns the hash of a surface; 0 if a call fails. Makes no assertions, because Catch2 supports them on one thread at
/// a time only.
uint64_t gridHash(sgm_runtime* runtime) {
  std::vector<float> values(40 * 40 * 40);
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 97) - 50.0f;
  sgm_grid_desc grid = SGM_GRID_DESC_INIT;
  grid.values = values.data();
  for (uint32_t& size : grid.size) size = 40;
  sgm_surface* surface = nullptr;
  if (sgm_surface_from_grid(runtime, &grid, &surface, nullptr) != SGM_OK) return 0;
  const uint64_t hash = sgm_surface_hash(surface);
  sgm_surface_destroy(surface);
  return hash;
}

/// Calls every function that submits jobs; returns the hash of all results.
uint64_t workOn(sgm_runtime* runtime) {
  const GrammarOwner grammar = compile(runtime, kBall);
  const FieldOwner field = makeField(runtime, grammar.get());
  uint64_t hash = 0;
  for (const MeshOwner& mesh :
       meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 63), chunkAt({1, 0, 0, 0}, 63), chunkAt({0, 1, 0, 0})}))
    hash = hash * 31 + viewOf(mesh).hash;
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  for (int axis = 0; axis < 3; ++axis) {
    region.minimum[axis] = -1;
    region.maximum[axis] = 8192;
  }
  sgm_surface* surface = nullptr;
  REQUIRE(sgm_surface_from_region(field.get(), &region, &surface, nullptr) == SGM_OK);
  hash = hash * 31 + sgm_surface_hash(surface);
  sgm_surface_destroy(surface);
  const uint64_t grid = gridHash(runtime);
  REQUIRE(grid != 0);
  hash = hash * 31 + grid;
  return hash;
}

uint64_t expectedHash() {
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.threads = 1;
  RuntimeOwner runtime = makeRuntime(&desc);
  return workOn(runtime.get());
}

uint64_t hashWith(const sgm_job_system& jobs) {
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.jobs = &jobs;
  RuntimeOwner runtime = makeRuntime(&desc);
  return workOn(runtime.get());
}

}  // namespace

TEST_CASE("a job system that runs its jobs late and in reverse, with help and without", "[threads]") {
  const uint64_t expected = expectedHash();
  for (const bool helps : {false, true}) {
    Lazy lazy(helps);
    CHECK(hashWith(table(lazy)) == expected);
  }
}

TEST_CASE("a job system without help", "[threads]") {
  Lazy lazy(false);
  sgm_job_system jobs = table(lazy);
  jobs.help = nullptr;
  CHECK(hashWith(jobs) == expectedHash());
}

TEST_CASE("a job system that refuses every job, and one that runs each at once", "[threads]") {
  sgm_job_system refuses{};
  refuses.concurrency = [](void*) -> uint32_t { return 0; };
  refuses.submit = [](void*, void (*)(void*), void*, int32_t) -> int32_t { return 0; };
  CHECK(hashWith(refuses) == expectedHash());
  sgm_job_system at_once{};
  at_once.concurrency = [](void*) -> uint32_t { return 1000; };
  at_once.submit = [](void*, void (*function)(void*), void* argument, int32_t) -> int32_t {
    function(argument);
    return 1;
  };
  CHECK(hashWith(at_once) == expectedHash());
}

TEST_CASE("a job system without threads, which runs its jobs in help alone", "[threads]") {
  struct Helped {
    std::mutex mutex;
    std::deque<Job> waiting;
    size_t ran = 0;
  } helped;
  const sgm_job_system jobs{[](void*) -> uint32_t { return 4; },
                            [](void* user, void (*function)(void*), void* argument, int32_t) -> int32_t {
                              auto& h = *static_cast<Helped*>(user);
                              const std::lock_guard lock(h.mutex);
                              h.waiting.push_back({function, argument});
                              return 1;
                            },
                            [](void* user) -> int32_t {
                              auto& h = *static_cast<Helped*>(user);
                              Job job{};
                              {
                                const std::lock_guard lock(h.mutex);
                                if (h.waiting.empty()) return 0;
                                job = h.waiting.front();
                                h.waiting.pop_front();
                                ++h.ran;
                              }
                              job.function(job.argument);
                              return 1;
                            },
                            &helped};
  {
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.jobs = &jobs;
    RuntimeOwner runtime = makeRuntime(&desc);
    const uint64_t expected = expectedHash();
    CHECK(workOn(runtime.get()) == expected);
    // Two concurrent calls: while one waits, it may run jobs of the other.
    const uint64_t grid = gridHash(runtime.get());
    CHECK(grid != 0);
    uint64_t other = 0;
    std::thread thread([&] { other = gridHash(runtime.get()); });
    const uint64_t mine = gridHash(runtime.get());
    thread.join();
    CHECK(mine == grid);
    CHECK(other == grid);
  }
  // All jobs must have run before the runtime was destroyed, including late ones that found no work left.
  CHECK(helped.waiting.empty());
  CHECK(helped.ran > 0);
}

TEST_CASE("a job system with a thread for each job", "[threads]") {
  struct Threads {
    std::mutex mutex;
    std::vector<std::thread> all;
  } threads;
  const sgm_job_system jobs{[](void*) -> uint32_t { return 3; },
                            [](void* user, void (*function)(void*), void* argument, int32_t) -> int32_t {
                              auto& t = *static_cast<Threads*>(user);
                              const std::lock_guard lock(t.mutex);
                              t.all.emplace_back(function, argument);
                              return 1;
                            },
                            nullptr, &threads};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.jobs = &jobs;
  RuntimeOwner runtime = makeRuntime(&desc);
  CHECK(workOn(runtime.get()) == expectedHash());
  for (std::thread& thread : threads.all) thread.join();
}

TEST_CASE("calls from several threads on one field agree", "[threads]") {
  const auto hashes = [](sgm_field* field) {
    const sgm_chunk_request request = chunkAt({0, 0, 0, 0}, 63);
    sgm_chunks_desc desc = SGM_CHUNKS_DESC_INIT;
    desc.requests = &request;
    desc.count = 1;
    sgm_mesh* mesh = nullptr;
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    uint64_t hash = 0;
    if (sgm_mesh_chunks(field, &desc, &mesh, nullptr) == SGM_OK && sgm_mesh_get_view(mesh, &view, nullptr) == SGM_OK)
      hash = view.hash;
    sgm_mesh_release(mesh);
    return hash;
  };
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  std::vector<uint64_t> found(4);
  std::vector<std::thread> threads;
  for (uint64_t& hash : found) threads.emplace_back([&hash, &field, &hashes] { hash = hashes(field.get()); });
  for (std::thread& thread : threads) thread.join();
  CHECK(found[0] != 0);
  for (const uint64_t hash : found) CHECK(hash == found[0]);
}
