// Tests polling a world's events when memory runs out in the middle of a poll.

#include <array>
#include <map>
#include <random>
#include <set>

#include "failing_memory.h"
#include "fixture.h"
#include "rounds.h"

namespace {

constexpr const char* kPolledHollows =
    "sgm 1; units m; domain infinite solid;\nlayer l cell 16m reach 4m { start Ball; }\n"
    "rule Ball { at(4m, 4m, 4m) cut sphere(3m); }\n";

/// The chunks that an engine draws, according to a world's events.
struct Polled {
  using Key = std::array<int32_t, 4>;
  std::map<Key, MeshOwner> meshes;
  std::set<Key> drawn;
  size_t colliders = 0, without_mesh = 0;

  void take(const sgm_world_event& event) {
    const Key key{event.key.level, event.key.x, event.key.y, event.key.z};
    if (event.kind == SGM_EVENT_READY) meshes[key].reset(event.mesh);
    if (event.kind == SGM_EVENT_COLLIDER) ++colliders;
    REQUIRE(sgm_collider_release(event.collider) == SGM_OK);
    if (event.kind == SGM_EVENT_SHOWN) {
      drawn.insert(key);
      without_mesh += meshes.count(key) == 0;
    }
    if (event.kind == SGM_EVENT_REMOVED) {
      drawn.erase(key);
      meshes.erase(key);
    }
  }
};

}  // namespace

TEST_CASE("a poll that fails has delivered nothing, and what it met comes with the next", "[threads]") {
  for (uint32_t seed = 1; seed <= sgm::rounds(4); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Failing failing;
    {
      const sgm_allocator allocator{Failing::allocate, Failing::release, &failing};
      sgm_runtime_desc runtime_desc = SGM_RUNTIME_DESC_INIT;
      runtime_desc.allocator = &allocator;
      runtime_desc.threads = 2;
      const RuntimeOwner runtime = makeRuntime(&runtime_desc);
      const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kPolledHollows).get(), 256);
      sgm_world_desc desc = SGM_WORLD_DESC_INIT;
      desc.top_level = 2;
      desc.flags = SGM_WORLD_BY_DISTANCE;
      desc.finest_distance = 5;
      desc.view_distance = 25;
      desc.collider_distance = 6;
      sgm_world* made = nullptr;
      REQUIRE(sgm_world_create(field.get(), &desc, &made, nullptr) == SGM_OK);
      const WorldOwner world(made);
      const sgm_viewer viewer = SGM_VIEWER_INIT;
      REQUIRE(sgm_world_set_viewers(made, &viewer, 0, 1, nullptr) == SGM_OK);
      REQUIRE(sgm_world_wait_idle(made, nullptr, nullptr, nullptr) == SGM_OK);
      Polled polled;
      size_t failed = 0, in_part = 0;
      for (bool more = true; more;) {
        sgm_world_event events[16];
        size_t count = std::size(events);
        failing.failures = 1;
        // In half of the cases, memory runs out at the first event; otherwise at a random event, up to twice as many as
        // fit into `events`.
        failing.left = random() % 2 == 0 ? 0 : static_cast<int64_t>(random() % (2 * std::size(events)));
        const sgm_result result = sgm_world_poll(made, events, 0, &count, nullptr);
        failing.left = INT64_MAX;
        if (result != SGM_OK) {
          CHECK(result == SGM_ERR_OUT_OF_MEMORY);
          CHECK(count == 0);
          ++failed;
          continue;
        }
        in_part += count > 0 && count < std::size(events);
        for (size_t i = 0; i < count; ++i) polled.take(events[i]);
        more = count > 0;
      }
      CHECK(failed > 0);
      CHECK(in_part > 0);
      CHECK(polled.colliders > 0);
      CHECK(polled.without_mesh == 0);
      size_t count = 0;
      REQUIRE(sgm_world_get_drawn(made, nullptr, 0, &count, nullptr) == SGM_OK);
      CHECK(polled.drawn.size() == count);
    }
    CHECK(failing.live == 0);
  }
}
