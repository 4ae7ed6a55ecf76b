// Tests watching worlds while an engine streams them, and forgetting them while they are sampled.

#include "tools/service/watch/watched_worlds.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <tuple>

#include "rounds.h"
#include "service_samples.h"

namespace sgm::service {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSoon(2);

std::unique_ptr<WatchedWorlds> makeWatcher(milliseconds period = kSoon) {
  Result<std::unique_ptr<WatchedWorlds>> made = WatchedWorlds::create(period);
  REQUIRE(made);
  return std::move(*made);
}

/// Calls question() until it returns true, for at most a minute. Returns whether it did.
template <class Question>
bool comesTrue(const Question& question) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!question()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(milliseconds(1));
  }
  return true;
}

std::optional<WorldSample> sampleNamed(const WatchedWorlds& worlds, const std::string& name) {
  for (WorldSample& sample : worlds.samples())
    if (sample.name == name) return std::move(sample);
  return std::nullopt;
}

}  // namespace

TEST_CASE("a world that streams is watched: its figures rise, and its map is what it draws", "[threads]") {
  StreamedWorld streamed(SGM_WORLD_MEASURE);
  const auto worlds = makeWatcher();
  CHECK(worlds->samples().empty());
  CHECK(!worlds->map("balls"));
  REQUIRE(worlds->watch("balls", streamed.world));
  streamed.fly();
  REQUIRE(comesTrue([&] {
    const auto now = sampleNamed(*worlds, "balls");
    return now && now->stats.chunks_meshed > 100 && now->chunks_per_second > 0 && now->parallel_speedup;
  }));
  WorldSample before = *sampleNamed(*worlds, "balls");
  CHECK(before.info.cell_units == 512);
  CHECK(before.viewers.size() == 1);
  REQUIRE(before.measures);
  for (unsigned round = 0; round < rounds(50); ++round) {
    REQUIRE(comesTrue([&] { return sampleNamed(*worlds, "balls")->taken > before.taken; }));
    const WorldSample now = *sampleNamed(*worlds, "balls");
    CHECK(now.stats.chunks_meshed >= before.stats.chunks_meshed);
    CHECK(now.stats.chunks_in_vain >= before.stats.chunks_in_vain);
    CHECK(now.chunks_per_second >= 0);
    CHECK(now.parallel_speedup.value() > 0);
    CHECK(now.parallel_speedup.value() <= now.info.threads);
    const std::optional<WorldMap> map = worlds->map("balls");
    REQUIRE(map);
    CHECK(map->total == map->chunks.size());
    before = now;
  }
  streamed.stop();
  streamed.settle();
  worlds->forget(streamed.world);
  CHECK(worlds->samples().empty());

  // When the world is idle, the map lists exactly the drawn chunks.
  REQUIRE(worlds->watch("again", streamed.world));
  const std::optional<WorldMap> map = worlds->map("again");
  REQUIRE(map);
  size_t count = 0;
  REQUIRE(sgm_world_get_drawn(streamed.world, nullptr, 0, &count, nullptr) == SGM_OK);
  std::vector<sgm_drawn_chunk> drawn(count);
  REQUIRE(sgm_world_get_drawn(streamed.world, drawn.data(), 0, &count, nullptr) == SGM_OK);
  using Line = std::tuple<int32_t, int32_t, int32_t, int32_t, uint32_t>;
  std::set<Line> expected, told;
  for (const sgm_drawn_chunk& chunk : drawn) {
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    REQUIRE(sgm_mesh_get_view(chunk.mesh, &view, nullptr) == SGM_OK);
    uint32_t indices = view.body.index_count;
    for (size_t face = 0; face < 6; ++face)
      if ((chunk.seams >> face & 1) != 0) indices += view.seams[face].index_count;
    expected.insert({chunk.key.level, chunk.key.x, chunk.key.y, chunk.key.z, indices / 3});
    sgm_mesh_release(chunk.mesh);
  }
  uint64_t triangles = 0;
  for (const DrawnChunk& chunk : map->chunks) {
    told.insert({chunk.level, chunk.x, chunk.y, chunk.z, chunk.triangles});
    triangles += chunk.triangles;
  }
  CHECK(told == expected);
  CHECK(map->total == count);
  CHECK(triangles == map->world.measures.value().drawn.triangles);
  // The map lists chunks of the finest level first; chunks of the same level are ordered by the distance of their
  // middles from the viewer, who is at the origin.
  const auto far = [](const DrawnChunk& chunk) {
    return std::tuple(chunk.level,
                      std::pow(chunk.x + 0.5, 2) + std::pow(chunk.y + 0.5, 2) + std::pow(chunk.z + 0.5, 2));
  };
  CHECK(std::is_sorted(map->chunks.begin(), map->chunks.end(),
                       [&](const auto& a, const auto& b) { return far(a) < far(b); }));
  CHECK(map->chunks.front().level < map->chunks.back().level);
}

TEST_CASE("a map is gathered once a second, whoever asks for it", "[threads]") {
  StreamedWorld streamed;
  const auto worlds = makeWatcher();
  REQUIRE(worlds->watch("balls", streamed.world));
  const std::optional<WorldMap> empty = worlds->map("balls");
  REQUIRE(empty);
  CHECK(empty->total == 0);
  const auto asked = std::chrono::steady_clock::now();
  streamed.settle();
  const std::optional<WorldMap> soon = worlds->map("balls");
  REQUIRE(soon);
  // The map is made anew at most once a second, so it is still the empty one. A busy machine may have taken longer:
  // then nothing is checked.
  if (std::chrono::steady_clock::now() - asked < milliseconds(900)) CHECK(soon->total == 0);
  CHECK(comesTrue([&] { return worlds->map("balls")->total > 0; }));
  CHECK(std::chrono::steady_clock::now() - asked >= milliseconds(900));

  std::atomic<unsigned> wrong{0};
  std::vector<std::thread> askers;
  const auto taken = worlds->map("balls")->world.taken;
  for (int i = 0; i < 4; ++i) {
    askers.emplace_back([&] {
      for (int k = 0; k < 50; ++k) {
        const std::optional<WorldMap> map = worlds->map("balls");
        if (!map || map->total == 0 || map->world.taken < taken) ++wrong;
      }
    });
  }
  for (std::thread& asker : askers) asker.join();
  CHECK(wrong == 0);
}

TEST_CASE("a world may end as soon as it is forgotten, whatever looks at it", "[threads]") {
  const auto worlds = makeWatcher(milliseconds(0));
  for (unsigned round = 0; round < rounds(20); ++round) {
    auto streamed = std::make_unique<StreamedWorld>(round % 2 == 0 ? uint32_t{SGM_WORLD_MEASURE} : 0u);
    REQUIRE(worlds->watch("balls", streamed->world));
    streamed->fly();
    std::atomic<bool> ends{false};
    std::thread asker([&] {
      while (!ends) static_cast<void>(worlds->map("balls"));
    });
    std::this_thread::sleep_for(milliseconds(round % 5));
    worlds->forget(streamed->world);
    CHECK(worlds->samples().empty());
    CHECK(!worlds->map("balls"));
    streamed.reset();
    ends = true;
    asker.join();
  }
}

TEST_CASE("a watcher ends while it watches, and worlds outlive it", "[threads]") {
  StreamedWorld streamed;
  streamed.fly();
  for (unsigned round = 0; round < rounds(20); ++round) {
    const auto worlds = makeWatcher(milliseconds(round % 3));
    REQUIRE(worlds->watch("balls", streamed.world));
    std::this_thread::sleep_for(milliseconds(round % 4));
  }
  CHECK(streamed.updates > 0);
}

TEST_CASE("names of watched worlds are checked, and told apart") {
  StreamedWorld streamed;
  const auto worlds = makeWatcher();
  const auto refusal = [&](const std::string& name, sgm_world* world) {
    const Result<void> watched = worlds->watch(name, world);
    REQUIRE(!watched);
    CHECK(!watched.error().message.empty());
    return watched.error().code;
  };
  for (const std::string& name :
       {std::string(), std::string(65, 'a'), std::string("a b"), std::string("a/b"), std::string("a\"b"),
        std::string("caf\xc3\xa9"), std::string("a\nb"), std::string("a\0b", 3), std::string("{}")}) {
    CAPTURE(name);
    CHECK(refusal(name, streamed.world) == Code::invalid_argument);
  }
  CHECK(refusal("null", nullptr) == Code::invalid_argument);
  const std::string longest = "_-." + std::string(61, 'Z');
  REQUIRE(worlds->watch(longest, streamed.world));
  CHECK(refusal("other", streamed.world) == Code::busy);
  CHECK(refusal(longest, streamed.make()) == Code::busy);
  worlds->forget(nullptr);
  worlds->forget(streamed.make());
  CHECK(worlds->samples().size() == 1);
  worlds->forget(streamed.world);
  worlds->forget(streamed.world);
  REQUIRE(worlds->watch(longest, streamed.world));
}

TEST_CASE("sixteen worlds are watched, by name, and no more") {
  StreamedWorld streamed;
  const auto worlds = makeWatcher();
  std::vector<sgm_world*> all;
  for (size_t i = 0; i < kMaxWorlds; ++i) {
    all.push_back(streamed.make());
    REQUIRE(worlds->watch("w" + std::to_string(99 - i), all.back()));
  }
  const Result<void> one_more = worlds->watch("more", streamed.world);
  REQUIRE(!one_more);
  CHECK(one_more.error().code == Code::limit);
  const std::vector<WorldSample> samples = worlds->samples();
  REQUIRE(samples.size() == kMaxWorlds);
  for (size_t i = 1; i < samples.size(); ++i) CHECK(samples[i - 1].name < samples[i].name);
  worlds->forget(all[3]);
  REQUIRE(worlds->watch("more", streamed.world));
  CHECK(worlds->samples().size() == kMaxWorlds);
}

}  // namespace sgm::service
