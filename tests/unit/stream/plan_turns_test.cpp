// Tests how worlds share workers between planning and meshing, in simulated time.

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <random>
#include <vector>

#include "catch.h"
#include "rounds.h"
#include "stream/plan/plan_turns.h"

using namespace sgm;

namespace {

using Clock = PlanTurns::Clock;

class CountedJobs final : public JobSystem {
 public:
  explicit CountedJobs(unsigned workers) : workers_(workers) {}
  unsigned concurrency() const override { return workers_ + 1; }  // the workers, and the engine's thread
  void submit(void (*)(void*), void*, int) override {}
  bool help() override { return false; }

 private:
  unsigned workers_;
};

/// Worlds whose viewers move continuously, and which always have chunks to mesh; the workers prefer plans to chunks.
class Simulation {
 public:
  struct World {
    PlanTurns::Member member;
    double plan_cost = 0, chunk_cost = 0;  ///< seconds of work that one plan takes, and that one chunk takes
    bool waits = false, plans = false, again = false;
    double waits_since = 0, longest_wait = 0;
    uint64_t planned = 0, meshed = 0;
    Simulation* simulation = nullptr;
  };

  Simulation(unsigned workers, size_t worlds, double updates_per_second)
      : jobs_(workers), turns_(jobs_), rate_(updates_per_second), worlds_(worlds) {
    busy_until_.assign(workers, 0);
    at_work_.assign(workers, {});
    for (World& world : worlds_) {
      world.simulation = this;
      world.member.owner = std::shared_ptr<void>(std::shared_ptr<void>(), &world);
      world.member.begin = [](const std::shared_ptr<void>& owner) noexcept {
        World& of = *static_cast<World*>(owner.get());
        of.simulation->begin(of);
      };
      turns_.join(world.member);
    }
  }
  ~Simulation() {
    for (World& world : worlds_) turns_.leave(world.member);
  }

  std::vector<World>& worlds() { return worlds_; }

  void run(double seconds) {
    for (World& world : worlds_) mesh(world);
    double next_update = 0;
    while (now_ < seconds) {
      assign();
      now_ = next_update;
      for (size_t i = 0; i < at_work_.size(); ++i) {
        if (at_work_[i].world != nullptr) now_ = std::min(now_, busy_until_[i]);
      }
      for (size_t i = 0; i < at_work_.size(); ++i) {
        if (at_work_[i].world != nullptr && busy_until_[i] <= now_) finish(std::exchange(at_work_[i], {}));
      }
      if (now_ < next_update) continue;
      next_update += 1 / rate_;
      for (World& world : worlds_) want(world);
    }
  }

  double planShare() const { return planning_ / (planning_ + meshing_); }
  uint64_t meshed() const {
    uint64_t all = 0;
    for (const World& world : worlds_) all += world.meshed;
    return all;
  }

 private:
  struct Job {
    World* world = nullptr;
    bool plan = false;
  };

  Clock::time_point time() const {
    return Clock::time_point() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 + now_));
  }
  void want(World& world) {
    if (world.plans) world.again = true;
    if (!world.waits && !world.plans) request(world);
    turns_.startDue(time());
  }
  void request(World& world) {
    world.waits = true;
    world.waits_since = now_;
    turns_.request(world.member);
  }
  void begin(World& world) {
    REQUIRE(world.waits);
    world.waits = false;
    world.plans = true;
    world.longest_wait = std::max(world.longest_wait, now_ - world.waits_since);
    plans_.push_back(&world);
  }
  void mesh(World& world) {
    turns_.setMeshJobs(world.member, 1);
    meshes_.push_back(&world);
  }
  void assign() {
    for (size_t i = 0; i < at_work_.size(); ++i) {
      if (at_work_[i].world != nullptr) continue;
      std::deque<World*>& from = plans_.empty() ? meshes_ : plans_;
      if (from.empty()) return;
      at_work_[i] = {from.front(), !plans_.empty()};
      from.pop_front();
      busy_until_[i] = now_ + (at_work_[i].plan ? at_work_[i].world->plan_cost : at_work_[i].world->chunk_cost);
    }
  }
  void finish(const Job& job) {
    World& world = *job.world;
    if (job.plan) {
      planning_ += world.plan_cost;
      ++world.planned;
      turns_.endPlan(world.member, world.plan_cost);
      world.plans = false;
      if (std::exchange(world.again, false)) request(world);
    } else {
      meshing_ += world.chunk_cost;
      ++world.meshed;
      turns_.earn(world.chunk_cost);
      mesh(world);
    }
    turns_.startDue(time());
  }

  CountedJobs jobs_;
  PlanTurns turns_;
  double rate_, now_ = 0, planning_ = 0, meshing_ = 0;
  std::vector<World> worlds_;
  std::deque<World*> plans_, meshes_;
  std::vector<double> busy_until_;
  std::vector<Job> at_work_;
};

}  // namespace

TEST_CASE("planning takes a quarter of the workers' time at most, and no world waits for long") {
  for (uint32_t seed = 1; seed <= rounds(60); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto between = [&random](double low, double high) {
      return std::exp(std::uniform_real_distribution<>(std::log(low), std::log(high))(random));
    };
    const auto workers = static_cast<unsigned>(between(1, 9));
    // Each world has a meshing job, so that no worker is ever idle.
    Simulation simulation(workers, workers + random() % 40, between(2, 1000));
    double plans = 0;
    for (Simulation::World& world : simulation.worlds()) {
      world.plan_cost = between(1e-4, 0.05);
      world.chunk_cost = between(1e-4, 0.005);
      plans += world.plan_cost;
    }
    simulation.run(30 * plans + 5);
    CAPTURE(workers, simulation.worlds().size(), plans);
    CHECK(simulation.planShare() <= 0.27);
    for (const Simulation::World& world : simulation.worlds()) {
      CHECK(world.planned > 2);
      CHECK(world.meshed > 2);
      // Planning gets a quarter of the meshing time, and all worlds take turns. So between two plans of a world, every
      // world plans once, for which 4 * plans seconds of meshing are needed.
      CHECK(world.longest_wait <= 8 * plans + 0.1);
    }
  }
}

TEST_CASE("to update more often does not mesh less") {
  std::vector<uint64_t> meshed;
  for (const double rate : {10.0, 125.0, 2000.0}) {
    Simulation simulation(1, 32, rate);
    for (Simulation::World& world : simulation.worlds()) {
      world.plan_cost = 0.00074;
      world.chunk_cost = 0.0005;
    }
    simulation.run(8);
    meshed.push_back(simulation.meshed());
    CHECK(meshed.back() >= 11'500);
    CHECK(meshed.back() >= meshed.front() * 95 / 100);
  }
}

TEST_CASE("a worker without work plans at once, whatever is owed") {
  CountedJobs jobs(2);
  PlanTurns turns(jobs);
  PlanTurns::Member member, other;
  int begun = 0;
  for (PlanTurns::Member* of : {&member, &other}) {
    of->owner = std::shared_ptr<void>(std::shared_ptr<void>(), &begun);
    of->begin = [](const std::shared_ptr<void>& owner) noexcept { ++*static_cast<int*>(owner.get()); };
    turns.join(*of);
  }
  const Clock::time_point now = Clock::time_point() + std::chrono::hours(1);
  turns.startDue(now);
  CHECK(begun == 0);  // no plan was requested
  for (int i = 1; i <= 5; ++i) {
    turns.request(member);
    turns.startDue(now);
    CHECK(begun == i);
    turns.endPlan(member, 10);
    CHECK(std::abs(turns.credit() + 10) < 1e-6);  // a plan on an idle worker lowers the credit to no less than -10 s
  }
  // From here on, both workers are busy: they mesh chunks, or are about to. The 10 s that the last plan took must be
  // earned by 40 s of meshing.
  turns.setMeshJobs(other, 2);
  turns.request(member);
  turns.startDue(now);
  CHECK(begun == 5);
  turns.earn(39.9);
  turns.startDue(now);
  CHECK(begun == 5);
  turns.earn(0.2);
  turns.startDue(now);
  CHECK(begun == 6);
  turns.endPlan(member, 10);
  // The last plan has lowered the credit to -10 s. While nothing is meshed, each second adds 1/20 s, so the credit is 0
  // again after 200 s. It does not rise above 0.
  turns.request(member);
  turns.startDue(now + std::chrono::seconds(190));
  CHECK(begun == 6);
  turns.startDue(now + std::chrono::seconds(210));
  CHECK(begun == 7);
  turns.endPlan(member, 10);
  turns.startDue(now + std::chrono::hours(100));
  CHECK(std::abs(turns.credit()) < 1e-6);
  // If a job system never executes a plan, other plans wait for a while, but not for ever.
  turns.request(member);
  turns.startDue(now + std::chrono::hours(100));
  CHECK(begun == 8);
  turns.request(other);
  turns.startDue(now + std::chrono::hours(100));
  CHECK(begun == 8);
  turns.startDue(now + std::chrono::hours(101));
  CHECK(begun == 9);
  turns.endPlan(member, 0);
  turns.endPlan(other, 0);
  // When a world leaves, its mesh jobs no longer count: a worker becomes idle, so the waiting plan begins.
  turns.request(member);
  turns.leave(other);
  turns.startDue(now + std::chrono::hours(101));
  CHECK(begun == 10);
  turns.leave(member);
}
