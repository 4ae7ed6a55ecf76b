// Tests worlds whose store is on a slow server: no job waits for it, and no chunk waits long.

#include <atomic>
#include <set>
#include <thread>

#include "rounds.h"
#include "store_support.h"
#include "stream/plan/work_queue.h"
#include "stream/streaming_support.h"

using namespace sgm;

namespace {

thread_local int jobs_running = 0;

/// A job system that marks its threads while they run jobs.
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

/// A job system that runs every job within submit(), on the calling thread.
class InlineJobs final : public JobSystem {
 public:
  unsigned concurrency() const override { return 1; }
  bool help() override { return false; }
  void submit(void (*function)(void*), void* argument, int) override { function(argument); }
};

/// A store in a folder that behaves like a slow server.
class FarFolder final : public BakedParts {
 public:
  explicit FarFolder(std::shared_ptr<BakedParts> parts) : parts_(std::move(parts)) {}

  /// Maximum time of an answer in milliseconds; if negative, a request gets no answer until reading is stopped.
  std::atomic<int> slowness = 0;
  /// Number of requests, from the first on, that are never answered.
  std::atomic<int> to_hang = 0;
  std::atomic<size_t> asked = 0, answers = 0, asked_by_jobs = 0;

  DiskKey worldOf(std::span<const std::byte> inputs) const override { return parts_->worldOf(inputs); }
  std::optional<BakedPart> get(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach,
                               std::pmr::memory_resource* memory) override {
    if (reach == Reach::near) return std::nullopt;
    ++asked;
    asked_by_jobs += jobs_running > 0;
    {
      std::unique_lock lock(mutex_);
      const bool hangs = to_hang > 0 && to_hang-- > 0;
      if (slowness < 0 || hangs) {
        stopping_.wait(lock, [this] { return stopped_; });
      } else if (slowness > 0) {
        const auto time = std::chrono::microseconds(random_() % (1000 * static_cast<unsigned>(slowness)));
        stopping_.wait_for(lock, time, [this] { return stopped_; });
      }
      if (stopped_) return std::nullopt;
    }
    ++answers;
    std::optional<BakedPart> found = parts_->get(world, chunk, part, reach, memory);
    if (found) found->is_far = true;
    return found;
  }
  void reject(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach) override {
    parts_->reject(world, chunk, part, reach);
  }
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

/// A store with the chunks that a Scene (streaming_support.h) shows around its viewer, up to the border of the region.
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
  /// Opens the store. Each world needs its own FarFolder, because a world stops the reading at its end.
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

TEST_CASE("requests of a far store wait for their looks, in their order, and for no longer than is said", "[store]") {
  using Clock = WorkQueue::Clock;
  for (uint32_t seed = 1; seed <= rounds(60); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    constexpr size_t kPrefetchers = 4;
    WorkQueue queue(kPrefetchers);
    Clock::time_point now{std::chrono::hours(1)};
    std::vector<WorkItem> model;  // in the order of the queue: the most urgent item last
    std::vector<std::shared_ptr<Look>> looking;
    Clock::time_point progress{};
    const auto sight = [&] { return std::span(model).last(std::min(WorkQueue::kSight, model.size())); };
    const auto isStalled = [&] { return looking.size() >= kPrefetchers && now - progress >= WorkQueue::kPatience; };
    const auto isReady = [&](const WorkItem& item) {
      const bool is_in_sight = &item >= sight().data();
      return item.rank == WorkItem::Rank::edited || (item.look && item.look->has_ended) ||
             (!item.look && isStalled()) || (is_in_sight && now - item.in_sight_since >= WorkQueue::kPatience);
    };
    const auto reached = [&] { return isStalled() ? std::span(model) : sight(); };
    for (int step = 0; step < 400; ++step) {
      now += std::chrono::milliseconds(random() % (step % 50 < 10 ? 100 : 20));
      switch (random() % 8) {
        case 0: {
          std::vector<WorkItem> plan;
          const bool may_prefetch = random() % 4 != 0;
          const size_t size = random() % 2 ? random() % 12 : random() % (WorkQueue::kSight + 40);
          std::set<ChunkKey> keys;
          while (keys.size() < size) keys.insert({0, {static_cast<int32_t>(random() % 600), 0, 0}});
          for (const ChunkKey& key : keys) {
            WorkItem& item = plan.emplace_back();
            item.request.key = key;
            item.request.seams = static_cast<uint8_t>(random() % 8 == 0);
            item.rank = plan.size() + 3 > size ? WorkItem::Rank::edited : WorkItem::Rank::other;
          }
          std::vector<WorkItem> next = plan;
          for (WorkItem& item : std::span(next).last(std::min(WorkQueue::kSight, next.size()))) {
            item.in_sight_since = now;
            for (const WorkItem& old : sight()) {
              if (old.request.key != item.request.key) continue;
              if (old.request == item.request) item.look = old.look;
              if (may_prefetch || item.look) item.in_sight_since = old.in_sight_since;
            }
          }
          model = std::move(next);
          queue.replace(plan, may_prefetch, now);
          break;
        }
        case 1:
        case 2: {
          const auto at = queue.nextReady(queue.size(), now);
          const std::span<WorkItem> of = reached();
          const auto wanted = std::find_if(of.rbegin(), of.rend(), isReady);
          REQUIRE(at.has_value() == (wanted != of.rend()));
          if (!at) break;
          const WorkItem taken = queue.remove(*at, now);
          REQUIRE(taken.request == wanted->request);
          CHECK((taken.look == nullptr || taken.look->has_ended));
          const bool was_in_sight = &*wanted >= sight().data();
          model.erase(model.begin() + (&*wanted - model.data()));
          if (was_in_sight && model.size() >= WorkQueue::kSight)
            model[model.size() - WorkQueue::kSight].in_sight_since = now;
          break;
        }
        case 3:
        case 4:
        case 5: {
          if (looking.size() == kPrefetchers) break;
          const auto look = std::make_shared<Look>();
          const auto isFound = [](const WorkItem& item) { return item.look && item.look->has_ended; };
          const auto found = static_cast<size_t>(std::ranges::count_if(sight(), isFound));
          const std::span<WorkItem> of = sight();
          const auto wanted = std::find_if(of.rbegin(), of.rend(), [](const WorkItem& item) {
            return item.look == nullptr && item.rank != WorkItem::Rank::edited;
          });
          const bool is_there = wanted != of.rend() && found < WorkQueue::kMaxFound;
          CHECK((queue.countToLook() > 0) == is_there);
          const auto request = queue.beginLook(look, now);
          REQUIRE(request.has_value() == is_there);
          if (!request) break;
          REQUIRE(*request == wanted->request);
          wanted->look = look;
          looking.push_back(look);
          progress = now;
          break;
        }
        default:
          if (looking.empty() || step % 50 < 10) break;
          std::swap(looking[random() % looking.size()], looking.back());
          queue.endLook(*looking.back(), std::nullopt, 0, now);
          looking.pop_back();
          progress = now;
      }
      REQUIRE(queue.countLooking() == looking.size());
      REQUIRE(queue.size() == model.size());
      CHECK(queue.countReady(now) == static_cast<size_t>(std::ranges::count_if(reached(), isReady)));
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
    lookFrom(scene, engine, viewer);
    checkFrame(scene, engine);
    CHECK(far->stats().hits > 100);
    CHECK(far->asked_by_jobs == 0);
    CHECK(scene.world->stats().queued == 0);
  }
}

TEST_CASE("a store that does not answer, or slowly, holds up no viewer, whoever runs the jobs", "[store][threads]") {
  const BakedScene baked;
  // The store never answers (-1), or takes up to 60 ms for each part.
  for (const int slowness : {-1, 60}) {
    for (const int kind : {0, 1, 2, 3}) {
      CAPTURE(slowness, kind);
      const auto far = baked.open();
      far->slowness = slowness;
      std::unique_ptr<JobSystem> jobs;
      if (kind < 2) jobs = markedJobs(kind == 0 ? 1 : 3);
      if (kind == 2) jobs = std::make_unique<MarkedJobs>(std::make_unique<LateJobs>(7));
      if (kind == 3) jobs = std::make_unique<MarkedJobs>(std::make_unique<InlineJobs>());
      Scene scene(std::move(jobs), caveText(), with(far));
      Engine engine;
      // The viewer moves, so that each frame gets a new plan.
      Viewer viewer = viewerAt(64, 64, 64);
      for (int frame = 0; frame < 2000 && scene.world->stats().planner.meshed < 200; ++frame) {
        viewer.position[0] += 0.02 * kUnitsPerMetre;
        REQUIRE(scene.world->setViewers({&viewer, 1}));
        scene.world->update(size_t{1} << 30);
        engine.take(*scene.world);
        workOrWait(scene);
      }
      CHECK(scene.world->stats().planner.meshed >= 200);
      CHECK(far->asked > 0);
      if (slowness < 0) CHECK(far->answers == 0);
      CHECK(far->asked_by_jobs == 0);
      comeToRest(scene, engine);
      checkFrame(scene, engine);
    }
  }
}

TEST_CASE("requests that hang cost their own lookers and no more", "[store][threads]") {
  const BakedScene baked;
  // With few concurrent requests, a single thread that hangs has a visible effect.
  const auto hitsOfWalk = [&](std::shared_ptr<BakedParts> parts) {
    WorldSettings settings;
    settings.baked = parts;
    Scene scene(markedJobs(2), caveText(), settings);
    Engine engine;
    Viewer viewer = viewerAt(16, 64, 64);
    for (int turn = 0; turn < 6; ++turn) {
      viewer.position[0] += 16 * kUnitsPerMetre;
      lookFrom(scene, engine, viewer);
    }
    checkFrame(scene, engine);
    return parts->stats().hits;
  };
  const uint64_t near = hitsOfWalk(sourceAt(baked.folder.path.string()));
  for (const int hanging : {1, 3}) {
    CAPTURE(hanging, near);
    const auto far = baked.open();
    far->to_hang = hanging;
    const uint64_t hits = hitsOfWalk(far);
    CHECK(hits > near / 2);
    CHECK(far->asked_by_jobs == 0);
  }
}

TEST_CASE("a world that has no room for what is wanted says so, whatever its store does", "[store][threads]") {
  const BakedScene baked;
  for (const int slowness : {0, -1}) {
    CAPTURE(slowness);
    const auto far = baked.open();
    far->slowness = slowness;
    WorldSettings settings = with(far);
    settings.mesh_bytes = size_t{21} << 20;
    settings.lod.finest_distance = 60.0 * kUnitsPerMetre;
    Scene scene(markedJobs(2), caveText(), settings);
    // Keeps all meshes, like an engine that never releases any.
    std::vector<std::shared_ptr<const ChunkSurface>> kept;
    const auto waitAndTake = [&] {
      const Result<void> waited = scene.world->waitIdle();
      scene.world->poll([&](const WorldEvent& event) {
        if (event.surface != nullptr) kept.push_back(event.surface);
        return true;
      });
      return waited;
    };
    Viewer viewer = viewerAt(64, 64, 64);
    Result<void> waited;
    for (int turn = 0; turn < 60 && waited; ++turn) {
      viewer.position[0] += 60 * kUnitsPerMetre;
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      waited = waitAndTake();
    }
    REQUIRE(!waited);
    CHECK(waited.error().code == Code::limit);
    // When the meshes are released, there is memory again, and loading continues.
    kept.clear();
    viewer = viewerAt(64, 64, 64);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    for (int turn = 0; turn < 12 && !waited; ++turn) {
      waited = waitAndTake();
      kept.clear();
    }
    CHECK(waited);
  }
}

TEST_CASE("a store that is slow changes no frame of a viewer who wanders and digs", "[store][threads]") {
  const BakedScene baked;
  for (const int slowness : {10, 400}) {
    for (uint32_t seed = 1; seed <= rounds(1); ++seed) {
      CAPTURE(slowness, seed);
      std::mt19937 random(seed);
      const auto far = baked.open();
      far->slowness = slowness;
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
      comeToRest(scene, engine);
      EditLog edits{EditSettings{}};
      REQUIRE(edits.import(scene.world->exportEdits(0)));
      checkFrame(scene, engine, edits.snapshot().get());
      CHECK(far->asked_by_jobs == 0);
    }
  }
}
