// parallelFor over job systems that keep the contract in unkind ways.

#include <atomic>
#include <stdexcept>
#include <vector>

#include "base/jobs.h"
#include "catch.h"

using namespace sgm;

namespace {

// Accepts everything and runs nothing until it is told to.
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

// Runs every job inside submit().
class ImmediateJobs final : public JobSystem {
 public:
  unsigned concurrency() const override { return 3; }
  void submit(void (*function)(void*), void* argument, int) override { function(argument); }
  bool help() override { return false; }
};

}  // namespace

TEST_CASE("every index is run once, on any number of threads", "[threads]") {
  for (unsigned threads : {1u, 2u, 7u}) {
    const auto jobs = makeThreadPool(threads);
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
  const auto jobs = makeThreadPool(4);
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
  const auto jobs = makeThreadPool(2);
  std::atomic<int> sum{0};
  parallelFor(*jobs, 8, [&](size_t) { parallelFor(*jobs, 8, [&](size_t) { ++sum; }); });
  CHECK(sum == 64);
}
