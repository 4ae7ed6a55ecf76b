// Tests the data that a world provides for monitoring: settings, viewers and times, while an engine updates the world.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "fixture.h"
#include "rounds.h"
#include "seed.h"
#include "temporary_folder.h"

namespace {

struct Watched {
  RuntimeOwner runtime = makeRuntime();
  WorldOwner world;

  explicit Watched(uint32_t flags = 0, const char* cache_folder = nullptr) {
    const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
    sgm_world_desc desc = smallWorld(flags);
    desc.collider_distance = 12;
    desc.mesh_bytes = uint64_t{300} << 20;
    desc.cache_folder = cache_folder;
    world = makeWorld(field.get(), desc);
  }

  void lookFrom(double x) const {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    viewer.position[0] = x;
    REQUIRE(sgm_world_set_viewers(world.get(), &viewer, 0, 1, nullptr) == SGM_OK);
  }
  /// Polls until no events are left; returns the number of calls.
  uint64_t pollAll() const {
    std::vector<sgm_world_event> events(16);
    for (uint64_t calls = 1;; ++calls) {
      size_t count = events.size();
      REQUIRE(sgm_world_poll(world.get(), events.data(), 0, &count, nullptr) == SGM_OK);
      if (count == 0) return calls;
      for (size_t i = 0; i < count; ++i) {
        REQUIRE(sgm_mesh_release(events[i].mesh) == SGM_OK);
        REQUIRE(sgm_collider_release(events[i].collider) == SGM_OK);
      }
    }
  }
  void settle() const { REQUIRE(sgm_world_wait_idle(world.get(), nullptr, nullptr, nullptr) == SGM_OK); }
  sgm_world_times times() const {
    sgm_world_times times = SGM_WORLD_TIMES_INIT;
    REQUIRE(sgm_world_get_times(world.get(), &times, nullptr) == SGM_OK);
    return times;
  }
  sgm_world_stats stats() const {
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    REQUIRE(sgm_world_get_stats(world.get(), &stats, nullptr) == SGM_OK);
    return stats;
  }
};

uint64_t countOf(const sgm_time_histogram& times) {
  return std::accumulate(std::begin(times.counts), std::end(times.counts), uint64_t{0});
}

uint64_t meshedIn(const sgm_world_times& times) {
  uint64_t all = 0;
  for (const sgm_time_histogram& level : times.mesh) all += countOf(level);
  return all;
}

/// Checks that a histogram's sum lies within the limits that its counts and bucket bounds imply.
void checkSum(const sgm_time_histogram& times) {
  double least = 0, most = 0;
  size_t last = 0;
  for (size_t i = 0; i < SGM_TIME_BUCKETS; ++i) {
    const double bound = std::ldexp(1.0, static_cast<int>(i) + SGM_TIME_FIRST_EXPONENT);
    least += static_cast<double>(times.counts[i]) * (i == 0 ? 0 : bound / 2);
    if (times.counts[i] == 0) continue;
    most += i + 1 == SGM_TIME_BUCKETS ? HUGE_VAL : static_cast<double>(times.counts[i]) * bound;
    last = i;
  }
  const double around = 1e-9 * (1 + times.sum);
  CHECK(times.sum >= least - around);
  if (countOf(times) == 0) {
    CHECK(times.sum == 0);
    CHECK(times.longest == 0);
    return;
  }
  CHECK(times.sum <= most + around);
  CHECK(times.longest <= times.sum + around);
  const double bound = std::ldexp(1.0, static_cast<int>(last) + SGM_TIME_FIRST_EXPONENT);
  CHECK((last == 0 || times.longest > bound / 2));
  CHECK((last + 1 == SGM_TIME_BUCKETS || times.longest <= bound));
}

}  // namespace

TEST_CASE("a world tells what it was created with and what works for it") {
  const Watched watched(SGM_WORLD_BY_DISTANCE | SGM_WORLD_MEASURE);
  sgm_world_info info = SGM_WORLD_INFO_INIT;
  REQUIRE(sgm_world_get_info(watched.world.get(), &info, nullptr) == SGM_OK);
  CHECK(info.cell_units == 512);
  CHECK(info.top_level == 3);
  CHECK(info.flags == (SGM_WORLD_BY_DISTANCE | SGM_WORLD_MEASURE));
  CHECK(info.threads >= 1);
  CHECK(info.finest_distance == 10);
  CHECK(info.view_distance == 60);
  CHECK(info.collider_distance == 12);
  CHECK(info.mesh_bytes == uint64_t{300} << 20);
  sgm_backend_info backend = SGM_BACKEND_INFO_INIT;
  REQUIRE(sgm_backend_query(watched.runtime.get(), info.backend.backend, &backend, nullptr) == SGM_OK);
  CHECK(info.backend.usable == 1);
  CHECK(info.backend.exact == backend.exact);
  CHECK(info.backend.concurrency == backend.concurrency);
  CHECK(std::string(info.backend.name) == backend.name);
  CHECK(std::string(info.backend.device) == backend.device);
  CHECK(std::string(info.backend.device) != "");
  CHECK(std::string(info.backend.reason).empty());
  CHECK(info.backend.losses == 0);
}

TEST_CASE("viewers come back as they were set") {
  const Watched watched;
  const auto count = [&] {
    size_t all = 77;
    REQUIRE(sgm_world_get_viewers(watched.world.get(), nullptr, 0, &all, nullptr) == SGM_OK);
    return all;
  };
  CHECK(count() == 0);
  const unsigned seed = sgm::testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-2e6, 2e6), other(0.01, 3);
  struct Wide {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    uint64_t beside = 7;
  };
  for (unsigned round = 0; round < sgm::rounds(50); ++round) {
    std::vector<Wide> set(random() % 20), got(set.size() + 1);
    for (Wide& wide : set) {
      for (size_t axis = 0; axis < 3; ++axis) {
        wide.viewer.position[axis] = place(random);
        wide.viewer.direction[axis] = static_cast<float>(place(random));
        wide.viewer.velocity[axis] = static_cast<float>(other(random));
      }
      wide.viewer.fov = static_cast<float>(other(random));
      wide.viewer.weight = static_cast<float>(other(random) + 0.01);
    }
    const sgm_viewer* first = set.empty() ? nullptr : &set[0].viewer;
    REQUIRE(sgm_world_set_viewers(watched.world.get(), first, sizeof(Wide), set.size(), nullptr) == SGM_OK);
    CHECK(count() == set.size());
    size_t room = got.size();
    REQUIRE(sgm_world_get_viewers(watched.world.get(), &got[0].viewer, sizeof(Wide), &room, nullptr) == SGM_OK);
    REQUIRE(room == set.size());
    for (size_t i = 0; i < set.size(); ++i) {
      const sgm_viewer &a = set[i].viewer, &b = got[i].viewer;
      // The number of units in a metre is a power of two, so converting positions from units rounds nothing.
      CHECK(std::equal(a.position, a.position + 3, b.position));
      CHECK(std::equal(a.direction, a.direction + 3, b.direction));
      CHECK(std::equal(a.velocity, a.velocity + 3, b.velocity));
      CHECK(a.fov == b.fov);
      CHECK(a.weight == b.weight);
      CHECK(got[i].beside == 7);
    }
    CHECK(got.back().viewer.weight == 1);
    if (set.empty()) continue;
    room = set.size() - 1;
    got[0].viewer.position[0] = 12345;
    CHECK(sgm_world_get_viewers(watched.world.get(), &got[0].viewer, sizeof(Wide), &room, nullptr) == SGM_INCOMPLETE);
    CHECK(room == set.size());
    CHECK(got[0].viewer.position[0] == 12345);
  }
}

TEST_CASE("times are counted once a call and once a chunk", "[threads]") {
  const Watched watched;
  CHECK(meshedIn(watched.times()) == 0);
  uint64_t updates = 0, polls = 0;
  for (const double x : {0.0, 40.0, 300.0}) {
    watched.lookFrom(x);
    for (int frame = 0; frame < 10; ++frame, ++updates) {
      REQUIRE(sgm_world_update(watched.world.get(), 1 << 20, nullptr) == SGM_OK);
      polls += watched.pollAll();
    }
    watched.settle();
    // An update that does nothing, because events are unread, must also be counted.
    CHECK(sgm_world_update(watched.world.get(), 1 << 20, nullptr) == SGM_INCOMPLETE);
    ++updates;
    polls += watched.pollAll();
    const sgm_world_times times = watched.times();
    const sgm_world_stats stats = watched.stats();
    CHECK(countOf(times.update) == updates);
    CHECK(countOf(times.poll) == polls);
    CHECK(countOf(times.read) == 0);
    CHECK(stats.chunks_meshed > 50);
    CHECK(meshedIn(times) == stats.chunks_meshed);
    CHECK(countOf(times.mesh[0]) == stats.finest_meshed);
    for (size_t level = 4; level <= SGM_MAX_LEVEL; ++level) CHECK(countOf(times.mesh[level]) == 0);
    for (const sgm_time_histogram* of : {&times.update, &times.poll, &times.read}) checkSum(*of);
    for (const sgm_time_histogram& level : times.mesh) checkSum(level);
    CHECK(times.update.sum > 0);
    CHECK(times.mesh[0].longest > 0);
    // While jobs run, at least one and at most all workers run, so job_seconds lies between clock_seconds and
    // clock_seconds times the number of workers.
    CHECK(times.clock_seconds > 0);
    CHECK(times.job_seconds >= times.clock_seconds * 0.999);
    double bodies = 0;
    for (const sgm_time_histogram& level : times.mesh) bodies += level.sum;
    CHECK(times.job_seconds >= bodies * 0.999);
  }
  // Calls with invalid arguments must not be counted.
  CHECK(sgm_world_update(watched.world.get(), 0, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(countOf(watched.times().update) == updates);
}

#if SGM_TEST_DISK_CACHE
TEST_CASE("what comes from the disk is read, not meshed") {
  const sgm::TemporaryFolder folder;
  const std::string cache = folder.path.string();
  uint64_t meshed = 0;
  for (const bool again : {false, true}) {
    CAPTURE(again);
    const Watched watched(0, cache.c_str());
    watched.lookFrom(0);
    watched.settle();
    static_cast<void>(watched.pollAll());
    const sgm_world_times times = watched.times();
    CHECK(meshedIn(times) + countOf(times.read) == watched.stats().chunks_meshed);
    checkSum(times.read);
    if (again) {
      CHECK(countOf(times.read) > 10);
      CHECK(meshedIn(times) < meshed);
    } else {
      CHECK(countOf(times.read) == 0);
      meshed = meshedIn(times);
    }
  }
}
#endif

TEST_CASE("a world is watched by other threads while its engine updates it", "[threads]") {
  const Watched watched(SGM_WORLD_MEASURE);
  sgm_world* const world = watched.world.get();
  std::atomic<bool> ends{false};
  std::atomic<unsigned> looks{0}, wrong{0};
  // This function runs on another thread, which must not use Catch2's checks: they are not thread-safe.
  const auto watch = [&] {
    sgm_world_times before = SGM_WORLD_TIMES_INIT;
    while (!ends) {
      sgm_world_info info = SGM_WORLD_INFO_INIT;
      sgm_world_stats stats = SGM_WORLD_STATS_INIT;
      sgm_world_measures measures = SGM_WORLD_MEASURES_INIT;
      sgm_world_times times = SGM_WORLD_TIMES_INIT;
      sgm_viewer viewers[4];
      size_t count = std::size(viewers), drawn = 0;
      bool fine = sgm_world_get_info(world, &info, nullptr) == SGM_OK && info.cell_units == 512 &&
                  sgm_world_get_stats(world, &stats, nullptr) == SGM_OK &&
                  sgm_world_get_measures(world, &measures, nullptr) == SGM_OK &&
                  sgm_world_get_times(world, &times, nullptr) == SGM_OK &&
                  sgm_world_get_viewers(world, viewers, 0, &count, nullptr) == SGM_OK && count <= 2 &&
                  sgm_world_get_drawn(world, nullptr, 0, &drawn, nullptr) == SGM_OK;
      for (size_t i = 0; fine && i < count; ++i) fine = viewers[i].position[1] == static_cast<double>(i);
      fine = fine && countOf(times.update) >= countOf(before.update) && times.update.sum >= before.update.sum;
      before = times;
      // Pass an array with at least one element: with NULL, the call would only return the number of chunks, which may
      // be positive by now.
      std::vector<sgm_drawn_chunk> chunks(++drawn);
      const sgm_result gathered = sgm_world_get_drawn(world, chunks.data(), 0, &drawn, nullptr);
      fine = fine && (gathered == SGM_OK || gathered == SGM_INCOMPLETE);
      for (size_t i = 0; gathered == SGM_OK && i < drawn; ++i) {
        sgm_mesh_view view = SGM_MESH_VIEW_INIT;
        fine = fine && sgm_mesh_get_view(chunks[i].mesh, &view, nullptr) == SGM_OK;
        fine = sgm_mesh_release(chunks[i].mesh) == SGM_OK && fine;
      }
      if (!fine) ++wrong;
      ++looks;
    }
  };
  std::vector<std::thread> watchers;
  for (int i = 0; i < 2; ++i) watchers.emplace_back(watch);
  unsigned frames = 0;
  const auto latest = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  // Continue until a chunk was meshed: on a busy machine, the first one may take long.
  const auto more = [&] {
    return (looks < 20 || watched.stats().chunks_meshed == 0) && std::chrono::steady_clock::now() < latest;
  };
  for (double x = 0; x < 200 || more(); x += 4, ++frames) {
    sgm_viewer viewers[2] = {SGM_VIEWER_INIT, SGM_VIEWER_INIT};
    for (size_t i = 0; i < 2; ++i) {
      viewers[i].position[0] = std::fmod(x, 1000);
      viewers[i].position[1] = static_cast<double>(i);
    }
    REQUIRE(sgm_world_set_viewers(world, viewers, 0, 1 + frames % 2, nullptr) == SGM_OK);
    REQUIRE(sgm_world_update(world, 1 << 20, nullptr) == SGM_OK);
    static_cast<void>(watched.pollAll());
    std::this_thread::yield();
  }
  ends = true;
  for (std::thread& thread : watchers) thread.join();
  CHECK(wrong == 0);
  CHECK(countOf(watched.times().update) == frames);
  CHECK(watched.stats().chunks_meshed > 0);
}
