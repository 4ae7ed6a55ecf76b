// Tests worlds that share workers, one of which keeps the workers busy: the other worlds must be planned nevertheless.

#include <chrono>
#include <deque>
#include <thread>

#include "catch.h"
#include "stream/plan/plan_turns.h"
#include "streaming_support.h"

using namespace sgm;

namespace {

/// A job system that runs its jobs in the order of submission, and only when help() is called.
class HeldJobs final : public JobSystem {
 public:
  ~HeldJobs() override {
    while (help()) {
    }
  }
  unsigned concurrency() const override { return 2; }
  void submit(void (*function)(void*), void* argument, int) override { jobs_.emplace_back(function, argument); }
  bool help() override {
    if (jobs_.empty()) return false;
    const auto [function, argument] = jobs_.front();
    jobs_.pop_front();
    function(argument);
    return true;
  }
  size_t waiting() const { return jobs_.size(); }

 private:
  std::deque<std::pair<void (*)(void*), void*>> jobs_;
};

/// Two worlds on one worker. The first has a plan, and waits for the worker to mesh its chunks; the second has
/// requested a plan.
struct TwoWorlds {
  TwoWorlds() : scene(std::make_unique<HeldJobs>()), jobs(static_cast<HeldJobs&>(*scene.jobs)) {
    auto turns = std::make_shared<PlanTurns>(jobs);
    for (std::unique_ptr<World>* world : {&first, &second}) {
      *world = std::move(
          *World::create(external(scene.field), *scene.backend, jobs, scene.settings, scene.field.memory(), turns));
      move(**world);
      if (world == &first) REQUIRE(jobs.help());
    }
    REQUIRE(first->stats().plans == 1);
    REQUIRE(jobs.waiting() == 1);
  }

  void move(World& world) {
    const Viewer viewer = viewerAt(96 + 0.01 * ++moves, 96, 96);
    REQUIRE(world.setViewers({&viewer, 1}));
    REQUIRE(world.update(1 << 20));
  }

  Scene scene;
  HeldJobs& jobs;
  std::unique_ptr<World> first, second;
  int moves = 0;
};

}  // namespace

TEST_CASE("a world plans as soon as another one has left with jobs that never began") {
  TwoWorlds worlds;
  worlds.first = nullptr;
  while (worlds.jobs.help()) {
  }
  CHECK(worlds.second->stats().plans > 0);
}

TEST_CASE("a world whose viewers move all the time plans though nothing is meshed") {
  const auto begun_at = std::chrono::steady_clock::now();
  TwoWorlds worlds;
  // No job meshes chunks here, so only elapsed time is credited for plans: a twentieth of it (PlanTurns::kTrickle). So
  // the second world's plan begins after 20 times the duration of the first world's plan, which ran in the constructor
  // of `worlds`. The limit is 40 times the duration of the constructor, and a minute as a margin.
  const auto at_most = begun_at + std::chrono::minutes(1) + 40 * (std::chrono::steady_clock::now() - begun_at);
  while (worlds.jobs.waiting() == 1 && std::chrono::steady_clock::now() < at_most) {
    worlds.move(*worlds.second);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(worlds.jobs.waiting() == 2);
}
