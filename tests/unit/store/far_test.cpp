// Worlds whose store is far away: no job waits for it, and no chunk for long.

#include <atomic>
#include <set>
#include <thread>

#include "rounds.h"
#include "store_support.h"
#include "stream/awaited_items.h"
#include "streaming_support.h"

using namespace sgm;

namespace {

thread_local int jobs_running = 0;

/// Marks the threads that run its jobs, while they do.
class MarkedJobs final : public JobSystem {
 public:
  explicit MarkedJobs(std::unique_ptr<JobSystem> jobs) : jobs_(std::move(jobs)) {}
  unsigned concurrency() const override { return jobs_->concurrency(); }
  bool help() override { return jobs_->help(); }
  void submit(void (*function)(void*), void* argument, int priority) override {
    auto job = std::make_unique<Job>(Job{function, argument});
    jobs_->submit(
        [](void* marked) {
          const std::unique_ptr<Job> own(static_cast<Job*>(marked));
          ++jobs_running;
          own->function(own->argument);
          --jobs_running;
        },
        job.get(), priority);
    static_cast<void>(job.release());
  }

 private:
  struct Job {
    void (*function)(void*);
    void* argument;
  };
  std::unique_ptr<JobSystem> jobs_;
};

/// A folder that is said to be far, and takes its time.
class FarFolder final : public BakedParts {
 public:
  explicit FarFolder(std::shared_ptr<BakedParts> parts) : parts_(std::move(parts)) {}

  /// Milliseconds of an answer, at most; below 0: it takes until reading is stopped.
  std::atomic<int> slowness = 0;
  std::atomic<size_t> answers = 0, asked_by_jobs = 0;

  DiskKey worldOf(std::span<const std::byte> inputs) const override { return parts_->worldOf(inputs); }
  std::optional<BakedPart> get(const DiskKey& world, const ChunkKey& chunk, int part,
                               std::pmr::memory_resource* memory) override {
    asked_by_jobs += jobs_running > 0;
    {
      std::unique_lock lock(mutex_);
      if (slowness < 0) {
        stopping_.wait(lock, [this] { return stopped_; });
      } else if (slowness > 0) {
        const auto time = std::chrono::microseconds(random_() % (1000 * static_cast<unsigned>(slowness)));
        stopping_.wait_for(lock, time, [this] { return stopped_; });
      }
      if (stopped_) return std::nullopt;
    }
    ++answers;
    std::optional<BakedPart> found = parts_->get(world, chunk, part, memory);
    if (found) found->is_far = true;
    return found;
  }
  void reject(const DiskKey& world, const ChunkKey& chunk, int part) override { parts_->reject(world, chunk, part); }
  bool isFar() const override { return true; }
  void stop() noexcept override {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    stopping_.notify_all();
  }
  BakedStats stats() const override { return parts_->stats(); }

 private:
  const std::shared_ptr<BakedParts> parts_;
  std::mutex mutex_;
  std::condition_variable stopping_;
  std::mt19937 random_{5};
  bool stopped_ = false;
};

/// What a Scene (streaming_support.h) shows around its viewer, but for what lies behind the region's end.
struct BakedScene {
  CacheFolder folder;

  BakedScene() {
    const WorldFieldSettings settings = settingsOf(caveText(), kStreamedCell, 3);
    constexpr int32_t edge = 128 * kUnitsPerMetre;
    const store::BakedRegion region{{{0, 0, 0}, {edge, edge, edge}}, 0, 3, kStreamedCell};
    const Baking baking(settings, region, folder.path);
    baking.bakeAll();
    baking.merge();
  }
  /// Each world stops its own.
  std::shared_ptr<FarFolder> open() const { return std::make_shared<FarFolder>(sourceAt(folder.path.string())); }
};

std::unique_ptr<JobSystem> markedJobs(unsigned threads) {
  return std::make_unique<MarkedJobs>(*makeThreadPool(threads));
}

WorldSettings with(std::shared_ptr<FarFolder> far) {
  WorldSettings settings;
  settings.baked = std::move(far);
  return settings;
}

Brush digAt(const Viewer& viewer) {
  Brush dig;
  dig.cut = true;
  for (int axis = 0; axis < 3; ++axis)
    dig.from[axis] = static_cast<int32_t>(viewer.position[static_cast<size_t>(axis)]);
  dig.radius = 5 * kUnitsPerMetre;
  return dig;
}

}  // namespace

TEST_CASE("what is awaited is handed out once, whatever comes in between", "[threads]") {
  using Clock = AwaitedItems::Clock;
  for (uint32_t seed = 1; seed <= rounds(50); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    AwaitedItems awaited;
    Clock::time_point now{std::chrono::hours(1)}, progress = now;
    std::set<ChunkKey> expected;  // of the plan in force
    std::vector<AwaitedItems::Looking> looking;
    std::set<uint64_t> current;  // numbers of those for this plan's items
    for (int step = 0; step < 300; ++step) {
      now += std::chrono::milliseconds(random() % 40);
      switch (random() % 8) {
        case 0: {
          std::vector<WorkItem> items(random() % 12);
          expected.clear();
          current.clear();
          for (size_t i = 0; i < items.size(); ++i) {
            items[i].request.key = {0, {step, static_cast<int32_t>(i), 0}};
            items[i].rank = i < items.size() / 2 ? WorkItem::Rank::other : WorkItem::Rank::near;
            items[i].urgency = static_cast<double>(items.size() - i);
            expected.insert(items[i].request.key);
          }
          awaited.replace(items, now);
          if (looking.empty()) progress = now;
          break;
        }
        case 1: {
          std::vector<WorkItem> items;
          const bool late = now - progress >= AwaitedItems::kPatience;
          CHECK(awaited.giveUp(items, now) == (late && !expected.empty()));
          if (items.empty()) break;
          std::set<ChunkKey> given;
          for (const WorkItem& item : items) CHECK(given.insert(item.request.key).second);
          CHECK(given == expected);
          expected.clear();
          current.clear();
          break;
        }
        case 2:
        case 3:
        case 4: {
          if (looking.size() == AwaitedItems::kMostLookers) break;
          const bool any = expected.size() > current.size();
          auto next = awaited.look(now);
          REQUIRE(next.has_value() == any);
          if (!next) break;
          if (looking.empty()) progress = now;
          CHECK(expected.contains(next->item.request.key));
          current.insert(next->number);
          looking.push_back(std::move(*next));
          break;
        }
        default: {
          if (looking.empty()) break;
          std::swap(looking[random() % looking.size()], looking.back());
          const AwaitedItems::Looking ended = std::move(looking.back());
          looking.pop_back();
          const bool wanted = current.erase(ended.number) > 0;
          CHECK(awaited.end(ended.number, now) == wanted);
          if (wanted) CHECK(expected.erase(ended.item.request.key) == 1);
          progress = now;
        }
      }
      REQUIRE(awaited.size() == expected.size());
      CHECK(awaited.hasUpTo(WorkItem::Rank::other) == !expected.empty());
      CHECK(!awaited.hasUpTo(WorkItem::Rank::edited));
    }
  }
}

TEST_CASE("a far store is asked by no job, and what it has is drawn", "[store][threads]") {
  const BakedScene baked;
  for (const unsigned threads : {1u, 3u}) {
    CAPTURE(threads);
    const auto far = baked.open();
    Scene scene(markedJobs(threads), caveText(), with(far));
    Engine engine;
    const Viewer viewer = viewerAt(64, 64, 64);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    checkFrame(scene, engine);
    CHECK(far->stats().hits > 100);
    CHECK(far->asked_by_jobs == 0);
    CHECK(scene.world->stats().queued == 0);
  }
}

TEST_CASE("a store that does not answer keeps nothing waiting", "[store][threads]") {
  const BakedScene baked;
  const auto far = baked.open();
  far->slowness = -1;
  Scene scene(markedJobs(2), caveText(), with(far));
  Engine engine;
  Viewer viewer = viewerAt(64, 64, 64);
  for (int turn = 0; turn < 3; ++turn) {
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    checkFrame(scene, engine);
    viewer.position[0] += 20 * kUnitsPerMetre;
  }
  CHECK(far->answers == 0);
  CHECK(far->asked_by_jobs == 0);
}

TEST_CASE("a store that is slow changes no frame of a viewer who wanders and digs", "[store][threads]") {
  const BakedScene baked;
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto far = baked.open();
    far->slowness = seed % 2 ? 10 : 400;
    Scene scene(markedJobs(2), caveText(), with(far));
    Engine engine;
    Viewer viewer = viewerAt(64, 64, 64);
    for (int turn = 0; turn < 24; ++turn) {
      viewer = wander(random, viewer);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      if (turn % 6 == 3) REQUIRE(scene.world->edit(digAt(viewer)));
      if (turn % 10 == 9) scene.world->cancel();
      for (int update = 0; update < 6; ++update) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        engine.take(*scene.world);
        workOrWait(scene);
      }
    }
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    EditLog edits{EditSettings{}};
    REQUIRE(edits.import(scene.world->exportEdits(0)));
    checkFrame(scene, engine, edits.snapshot().get());
    CHECK(far->asked_by_jobs == 0);
  }
}
