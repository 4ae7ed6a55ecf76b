// Tests a streamed world when any of its allocations fails: it must report the failure, continue, and draw the right
// frame once memory is available again.

#include <chrono>
#include <cstring>
#include <random>
#include <thread>

#include "failing_memory.h"
#include "fixture.h"
#include "rounds.h"
#include "temporary_folder.h"

namespace {

constexpr const char* kHollows =
    "sgm 1; units m; domain infinite solid;\nlayer l cell 16m reach 4m { start Ball; }\n"
    "rule Ball { at(4m, 4m, 4m) cut sphere(3m); }\n";
constexpr int kDigs = 4, kTroubledFrames = 25;

struct Log {
  std::atomic<int> scarce{0}, damaged{0};

  static void write(void* user, sgm_log_level, const char* message) {
    auto& log = *static_cast<Log*>(user);
    if (std::strstr(message, "too little memory")) log.scarce.fetch_add(1);
    if (std::strstr(message, "damaged") || std::strstr(message, "cut off")) log.damaged.fetch_add(1);
  }
};

/// An engine that repeats a call if it was out of memory. It makes no assertions, because these allocate memory
/// themselves.
struct Session {
  sgm_field* field = nullptr;
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  sgm_world* world = nullptr;
  bool looks = false;
  int frames = 0, digs = 0;
  sgm_result wrong = SGM_OK;  ///< the first error code other than SGM_OK and out of memory

  ~Session() { sgm_world_destroy(world); }

  bool done(sgm_result result) {
    if (result != SGM_OK && result != SGM_INCOMPLETE && result != SGM_ERR_OUT_OF_MEMORY) wrong = result;
    return result == SGM_OK;
  }

  void frame() {
    ++frames;
    if (world == nullptr && !done(sgm_world_create(field, &desc, &world, nullptr))) return;
    const sgm_viewer viewer = SGM_VIEWER_INIT;
    looks = looks || done(sgm_world_set_viewers(world, &viewer, 0, 1, nullptr));
    if (digs < kDigs && frames > 3 * digs) {
      sgm_brush brush = SGM_BRUSH_INIT;
      brush.from[0] = 2048 * digs;
      brush.radius = 1500;
      digs += done(sgm_world_edit(world, &brush, nullptr, nullptr));
    }
    done(sgm_world_update(world, 1 << 20, nullptr));
    sgm_world_event events[16];
    size_t count = 0;
    do {
      count = 16;
      if (const sgm_result polled = sgm_world_poll(world, events, 0, &count, nullptr); !done(polled)) {
        if (count != 0) wrong = SGM_ERR_INTERNAL;  // a failed call must return no events
        break;
      }
      for (size_t i = 0; i < count; ++i) {
        sgm_mesh_release(events[i].mesh);
        sgm_collider_release(events[i].collider);
        if (events[i].kind == SGM_EVENT_FAILED) wrong = events[i].result;
      }
    } while (count > 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  bool atRest() {
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    return world != nullptr && digs == kDigs && sgm_world_get_stats(world, &stats, nullptr) == SGM_OK &&
           stats.idle == 1 && stats.edits_drawn == stats.edits_state;
  }

  void settle() {
    for (int i = 0; i < 100'000 && !atRest(); ++i) frame();
    REQUIRE(atRest());
  }

  uint64_t drawnHash() const {
    size_t count = 0;
    REQUIRE(sgm_world_get_drawn(world, nullptr, 0, &count, nullptr) == SGM_OK);
    std::vector<sgm_drawn_chunk> chunks(count);
    REQUIRE(sgm_world_get_drawn(world, chunks.data(), 0, &count, nullptr) == SGM_OK);
    uint64_t hash = count;
    const auto add = [&hash](uint64_t part) { hash = (hash ^ part) * 0x9E3779B97F4A7C15u; };
    for (const sgm_drawn_chunk& chunk : chunks) {
      const MeshOwner mesh(chunk.mesh);
      const sgm_mesh_view view = viewOf(mesh);
      for (const int32_t part : {view.key.level, view.key.x, view.key.y, view.key.z}) add(static_cast<uint64_t>(part));
      add(chunk.seams);
      add(chunk.coarser);
      add(view.body.hash);
      // Count only the seams that are drawn: a mesh may have more.
      for (size_t face = 0; face < 6; ++face) add((chunk.seams >> face & 1) != 0 ? view.seams[face].hash : 0);
    }
    return hash;
  }
};

/// A temporary folder for one session's journal and chunks.
struct Folder : sgm::TemporaryFolder {
  std::string journal = (path / "edits").string(), cache = (path / "chunks").string();
};

sgm_world_desc troubledWorld(const Folder& folder, bool by_distance) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 2;
  desc.flags = by_distance ? SGM_WORLD_BY_DISTANCE : SGM_WORLD_TEXTURE | SGM_WORLD_SHARP;
  desc.finest_distance = 5;
  desc.view_distance = 25;
  desc.collider_distance = 6;
  desc.author = 5;
  desc.journal = folder.journal.c_str();
  if (SGM_TEST_DISK_CACHE) desc.cache_folder = folder.cache.c_str();
  return desc;
}

/// A field to stream, in a runtime with the test's allocator and log.
struct Scene {
  sgm_allocator allocator;
  Log log;
  sgm_log_sink sink{Log::write, &log};
  Folder folder;
  RuntimeOwner runtime;
  FieldOwner field;

  Scene(Failing& failing, uint32_t threads) : allocator{Failing::allocate, Failing::release, &failing} {
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.allocator = &allocator;
    desc.threads = threads;
    desc.log = &sink;
    runtime = makeRuntime(&desc);
    field = makeField(runtime.get(), compile(runtime.get(), kHollows).get(), 256);
  }
};

struct Outcome {
  uint64_t drawn = 0, edits = 0;
};

/// Runs one session. Allocations fail from begin() to end(); troubled() returns whether any has failed.
template <class Begin, class End, class Troubled>
Outcome trouble(Failing& failing, bool by_distance, Begin begin, End end, Troubled troubled) {
  Outcome outcome;
  {
    const Scene scene(failing, 2);
    {
      Session session;
      session.field = scene.field.get();
      session.desc = troubledWorld(scene.folder, by_distance);
      begin();
      for (int left = kTroubledFrames; left > 0 && !session.atRest(); left -= troubled()) session.frame();
      end();
      session.settle();
      CHECK(session.wrong == SGM_OK);
      CHECK(scene.log.scarce <= 1);
      outcome = {session.drawnHash(), sgm_world_edits_hash(session.world)};
    }
    // The journal must contain all edits completely.
    sgm_world* again = nullptr;
    const sgm_world_desc world = troubledWorld(scene.folder, by_distance);
    REQUIRE(sgm_world_create(scene.field.get(), &world, &again, nullptr) == SGM_OK);
    CHECK(sgm_world_edits_hash(again) == outcome.edits);
    CHECK(scene.log.damaged == 0);
    sgm_world_destroy(again);
  }
  CHECK(failing.live == 0);
  return outcome;
}

/// Runs sessions in which failures start later and later, until a session has no failure: once with temporary failures,
/// once with permanent ones.
template <class Run>
void everLater(Run run) {
  for (uint32_t seed = 1; seed <= 2 * sgm::rounds(1); ++seed) {
    std::mt19937 random(seed);
    const bool by_distance = seed % 2 == 0;
    const Outcome expected = run(by_distance, INT64_MAX / 4, 0).first;
    REQUIRE(expected.drawn != 0);
    const auto below = [&](int64_t end) { return static_cast<int64_t>(random() % static_cast<uint64_t>(end)); };
    int64_t n = 0;
    for (bool troubled = true; troubled; n += 1 + n + below(1 + 3 * n)) {
      const int64_t failures = random() % 2 == 0 ? INT64_MAX : 1 + below(300);
      CAPTURE(seed, n, failures);
      Outcome outcome;
      std::tie(outcome, troubled) = run(by_distance, n, failures);
      CHECK(outcome.edits == expected.edits);
      CHECK(outcome.drawn == expected.drawn);
    }
    CHECK(n > 1000);
  }
}

}  // namespace

TEST_CASE("a streamed world outlives an allocator that gives out, and is right once memory is back") {
  Failing failing;
  everLater([&](bool by_distance, int64_t n, int64_t failures) {
    bool reached = false;
    const Outcome outcome = trouble(
        failing, by_distance,
        [&] {
          failing.failures = failures;
          failing.left = n;
        },
        [&] { reached = failing.left.exchange(INT64_MAX) <= 0; }, [&] { return failing.left <= 0 ? 1 : 0; });
    return std::pair(outcome, reached);
  });
}

TEST_CASE("a streamed world outlives a heap that gives out, and is right once memory is back", "[costly]") {
  Failing failing;
  everLater([&](bool by_distance, int64_t n, int64_t failures) {
    bool reached = false;
    const Outcome outcome = trouble(
        failing, by_distance,
        [&] {
          heap_failures = failures;
          heap_left_everywhere = n;
        },
        [&] { reached = heap_left_everywhere.exchange(INT64_MAX) <= 0; },
        [&] { return heap_left_everywhere <= 0 ? 1 : 0; });
    return std::pair(outcome, reached);
  });
}

TEST_CASE("a world whose memory never suffices says so once, tries little, and a wait for it ends") {
  Failing failing;
  const Scene scene(failing, 3);
  Session session;
  session.field = scene.field.get();
  session.desc = troubledWorld(scene.folder, true);
  session.frame();
  REQUIRE(session.world != nullptr);
  failing.left = 0;
  for (int i = 0; i < 50; ++i) session.frame();
  CHECK(scene.log.scarce == 1);
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  REQUIRE(sgm_world_get_stats(session.world, &stats, nullptr) == SGM_OK);
  const uint64_t plans = stats.plans;
  const int64_t left = failing.left;
  for (int i = 0; i < 50; ++i) session.frame();
  REQUIRE(sgm_world_get_stats(session.world, &stats, nullptr) == SGM_OK);
  CHECK(stats.plans <= plans + 100);
  CHECK(failing.left > left - 50 * 100);  // at most 100 attempted allocations per frame
  CHECK(scene.log.scarce == 1);
  CHECK(stats.idle == 0);
  const sgm_result waited = sgm_world_wait_idle(session.world, nullptr, nullptr, nullptr);
  CHECK((waited == SGM_ERR_LIMIT || waited == SGM_ERR_OUT_OF_MEMORY));
  failing.left = INT64_MAX;
  session.settle();
  CHECK(session.wrong == SGM_OK);
  CHECK(scene.log.scarce == 1);
}
