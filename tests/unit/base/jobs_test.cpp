// Tests parallelFor with job systems that satisfy the contract in unfavourable ways.

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/jobs.h"
#include "catch.h"
#include "scarce_threads.h"

using namespace sgm;

namespace {

// A job system that accepts all jobs, and runs none until runAll() is called.
class LateJobs final : public JobSystem {
 public:
  unsigned concurrency() const override { return 4; }
  void submit(void (*function)(void*), void* argument, int) override { waiting_.emplace_back(function, argument); }
  bool help() override { return false; }
  size_t runAll() {
    for (auto [function, argument] : waiting_) function(argument);
    return waiting_.size();
  }

 private:
  std::vector<std::pair<void (*)(void*), void*>> waiting_;
};

// A job system that runs every job inside submit().
class ImmediateJobs final : public JobSystem {
 public:
  unsigned concurrency() const override { return 3; }
  void submit(void (*function)(void*), void* argument, int) override { function(argument); }
  bool help() override { return false; }
};

// A job system that accepts one job, which runs on a thread of its own; records whether help() was called.
class OneJobJobs final : public JobSystem {
 public:
  ~OneJobJobs() override {
    if (thread_.joinable()) thread_.join();
  }
  unsigned concurrency() const override { return 2; }
  void submit(void (*function)(void*), void* argument, int) override { thread_ = std::thread(function, argument); }
  bool help() override {
    helped = true;
    return false;
  }
  std::atomic<bool> helped{false};

 private:
  std::thread thread_;
};

}  // namespace

TEST_CASE("who waits for a loop helps the job system meanwhile", "[threads]") {
  OneJobJobs jobs;
  std::atomic<int> begun{0};
  bool in_time = false;
  const std::thread::id caller = std::this_thread::get_id();
  parallelFor(jobs, 2, [&](size_t) {
    // The two indices run on two threads. The caller's index ends at once; the other index waits until the caller calls
    // help().
    ++begun;
    while (begun < 2) std::this_thread::yield();
    if (std::this_thread::get_id() == caller) return;
    for (int i = 0; i < 60'000 && !jobs.helped; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    in_time = jobs.helped;
  });
  CHECK(in_time);
}

#if defined(SGM_SCARCE_THREADS)
TEST_CASE("a pool is made of the threads that start, or is an error", "[threads]") {
  {
    const FailingThreads none(0);
    const auto jobs = makeThreadPool(1024);
    REQUIRE_FALSE(jobs);
    CHECK(jobs.error().code == Code::limit);
    CHECK(jobs.error().message.find("thread") != std::string::npos);
  }
  const auto few = [] {
    const FailingThreads three(3);
    return makeThreadPool(1024);
  }();
  REQUIRE(few);
  CHECK((*few)->concurrency() >= 2);
  CHECK((*few)->concurrency() <= 8);
  std::atomic<int> runs{0};
  parallelFor(**few, 100, [&](size_t) { ++runs; });
  CHECK(runs == 100);
}
#endif

TEST_CASE("a pool of N is N workers, the caller among them", "[threads]") {
  for (unsigned threads : {1u, 2u, 4u}) {
    const auto jobs = *makeThreadPool(threads);
    std::atomic<unsigned> now{0}, most{0};
    parallelFor(*jobs, 40, [&](size_t) {
      const unsigned mine = ++now;
      for (unsigned seen = most; seen < mine && !most.compare_exchange_weak(seen, mine);) continue;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --now;
    });
    CHECK(most <= threads);
  }
}

TEST_CASE("every index is run once, on any number of threads", "[threads]") {
  for (unsigned threads : {1u, 2u, 7u}) {
    const auto jobs = *makeThreadPool(threads);
    CHECK(jobs->concurrency() == threads);
    for (size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> runs(count);
      parallelFor(*jobs, count, [&](size_t i) { ++runs[i]; });
      size_t wrong = 0;
      for (const auto& r : runs) wrong += r != 1;
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("a job system that runs jobs late does not hold the caller up", "[threads]") {
  LateJobs jobs;
  int runs = 0;
  parallelFor(jobs, 50, [&](size_t) { ++runs; });
  CHECK(runs == 50);
  CHECK(jobs.runAll() == 3);
  CHECK(runs == 50);
  ImmediateJobs now;
  parallelFor(now, 50, [&](size_t) { ++runs; });
  CHECK(runs == 100);
}

TEST_CASE("the first exception comes back after all have ended", "[threads]") {
  const auto jobs = *makeThreadPool(4);
  std::atomic<int> running{0};
  CHECK_THROWS_AS(parallelFor(*jobs, 1000,
                              [&](size_t i) {
                                ++running;
                                if (i == 20) {
                                  --running;
                                  throw std::runtime_error("stop");
                                }
                                --running;
                              }),
                  std::runtime_error);
  CHECK(running == 0);
}

TEST_CASE("loops within loops do not wait for each other", "[threads]") {
  const auto jobs = *makeThreadPool(2);
  std::atomic<int> sum{0};
  parallelFor(*jobs, 8, [&](size_t) { parallelFor(*jobs, 8, [&](size_t) { ++sum; }); });
  CHECK(sum == 64);
}
