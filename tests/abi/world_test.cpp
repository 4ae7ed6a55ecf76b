// Tests a streamed world through the C interface alone, as an engine uses it.

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <thread>
#include <tuple>

#include "fixture.h"

namespace {

using Key = std::tuple<int32_t, int32_t, int32_t, int32_t>;
Key keyOf(const sgm_chunk_key& key) { return {key.level, key.x, key.y, key.z}; }

struct Drawn {
  uint64_t hash = 0;
  uint32_t seams = 0, coarser = 0;
  friend bool operator==(const Drawn&, const Drawn&) = default;
};

/// An engine that tracks, from the events alone, which chunks are drawn.
class Engine {
 public:
  void poll(sgm_world* world) {
    // The array is smaller than the number of pending events, so polling must continue where the last call stopped.
    sgm_world_event events[7];
    for (size_t count = 7;; count = 7) {
      REQUIRE(sgm_world_poll(world, events, 0, &count, nullptr) == SGM_OK);
      if (count == 0) return;
      for (size_t i = 0; i < count; ++i) take(events[i]);
    }
  }

  std::map<Key, Drawn> drawn;

 private:
  void take(const sgm_world_event& event) {
    const Key key = keyOf(event.key);
    CHECK(event.result == SGM_OK);
    CHECK((event.mesh != nullptr) == (event.kind == SGM_EVENT_READY));
    switch (event.kind) {
      case SGM_EVENT_READY:
        meshes_[key] = MeshOwner(event.mesh);
        break;
      case SGM_EVENT_SHOWN:
      case SGM_EVENT_REPLACED: {
        REQUIRE(meshes_.count(key) == 1);
        drawn[key] = {viewOf(meshes_[key]).hash, event.seams, event.coarser};
        break;
      }
      case SGM_EVENT_SEAMS:
        REQUIRE(drawn.count(key) == 1);
        drawn[key].seams = event.seams;
        drawn[key].coarser = event.coarser;
        break;
      case SGM_EVENT_REMOVED:
        drawn.erase(key);
        meshes_.erase(key);
        break;
      default:
        FAIL("an event of no known kind");
    }
  }
  std::map<Key, MeshOwner> meshes_;
};

}  // namespace

TEST_CASE("events lead to what the world says it draws", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  const WorldOwner world = makeWorld(field.get());
  field.reset();  // the world keeps the field alive
  Engine engine;
  for (const double x : {0.0, 30.0, 500.0, 0.0}) {
    look(world.get(), x);
    for (int frame = 0; frame < 5; ++frame) {
      REQUIRE(sgm_world_update(world.get(), 1 << 20, nullptr) == SGM_OK);
      engine.poll(world.get());
    }
    comeToRest(world.get());
    engine.poll(world.get());
    size_t count = 0;
    REQUIRE(sgm_world_get_drawn(world.get(), nullptr, 0, &count, nullptr) == SGM_OK);
    CHECK(count > 20);
    std::vector<sgm_drawn_chunk> chunks(count);
    size_t room = count - 1;
    CHECK(sgm_world_get_drawn(world.get(), chunks.data(), 0, &room, nullptr) == SGM_INCOMPLETE);
    REQUIRE(sgm_world_get_drawn(world.get(), chunks.data(), 0, &count, nullptr) == SGM_OK);
    std::map<Key, Drawn> drawn;
    for (const sgm_drawn_chunk& chunk : chunks) {
      const MeshOwner mesh(chunk.mesh);
      drawn[keyOf(chunk.key)] = {viewOf(mesh).hash, chunk.seams, chunk.coarser};
    }
    CHECK(drawn == engine.drawn);
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    REQUIRE(sgm_world_get_stats(world.get(), &stats, nullptr) == SGM_OK);
    CHECK(stats.idle == 1);
    CHECK(stats.drawn == drawn.size());
    CHECK(stats.mesh_bytes > 0);
    CHECK(stats.peak_mesh_bytes >= stats.mesh_bytes);
  }
}

TEST_CASE("an update waits for the events of the one before, and unpolled meshes end with the world", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  const WorldOwner world = makeWorld(field.get());
  look(world.get(), 0);
  comeToRest(world.get());
  CHECK(sgm_world_update(world.get(), 1 << 20, nullptr) == SGM_INCOMPLETE);
  sgm_world_event event;
  size_t count = 1;
  REQUIRE(sgm_world_poll(world.get(), &event, 0, &count, nullptr) == SGM_OK);
  REQUIRE(count == 1);
  sgm_mesh_release(event.mesh);
  CHECK(sgm_world_update(world.get(), 1 << 20, nullptr) == SGM_INCOMPLETE);
}

TEST_CASE("a world's hash is that of the region's surface, streamed or not", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  const WorldOwner world = makeWorld(field.get());
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  for (int32_t& v : region.minimum) v = -8 * 1024;
  for (int32_t& v : region.maximum) v = 24 * 1024;
  const SurfaceOwner surface = surfaceOf(field.get(), region);
  for (int turn = 0; turn < 2; ++turn) {
    uint64_t hash = 0;
    REQUIRE(sgm_world_hash(world.get(), region.minimum, region.maximum, 0, &hash, nullptr) == SGM_OK);
    CHECK(hash == sgm_surface_hash(surface.get()));
    look(world.get(), 0);
    comeToRest(world.get());
  }
}

TEST_CASE("meshes have morph offsets where they are asked for, to the coarser surface") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  for (const uint32_t flags : {0u, uint32_t{SGM_WORLD_MORPH}}) {
    const WorldOwner world = makeWorld(field.get(), smallWorld(flags));
    look(world.get(), 0);
    comeToRest(world.get());
    size_t moved = 0;
    for (const MeshOwner& mesh : drawnOf(world.get())) {
      const sgm_mesh_view view = viewOf(mesh);
      CHECK((view.morphs != nullptr) == (flags != 0 && view.vertex_count > 0));
      for (uint32_t i = 0; view.morphs != nullptr && i < 3 * view.vertex_count; ++i) {
        CHECK(std::abs(view.morphs[i]) <= 1024);
        moved += view.morphs[i] != 0;
        if (view.vertices[i / 3].kind != SGM_VERTEX_OWN) CHECK(view.morphs[i] == 0);
      }
    }
    CHECK((moved > 0) == (flags != 0));
  }
}

TEST_CASE("meshes have texture coordinates where they are asked for, of the same triangles") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  for (const uint32_t flags : {0u, uint32_t{SGM_WORLD_TEXTURE}}) {
    const WorldOwner world = makeWorld(field.get(), smallWorld(flags));
    look(world.get(), 0);
    comeToRest(world.get());
    for (const MeshOwner& mesh : drawnOf(world.get())) {
      const sgm_mesh_view view = viewOf(mesh);
      CHECK((view.wedges != nullptr) == (flags != 0));
      if (view.wedges != nullptr) checkWedges(view);
    }
  }
}

TEST_CASE("worlds have sharp features where they are asked for, at every level") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(),
                                     compile(runtime.get(),
                                             "sgm 1; units m; domain finite box(160m, 160m, 160m) empty; start Box;\n"
                                             "rule Box { rot(y, 30deg) rot(x, 20deg) box(50m, 40m, 60m); }")
                                         .get(),
                                     512);
  for (const uint32_t flags : {0u, uint32_t{SGM_WORLD_SHARP}}) {
    const WorldOwner world = makeWorld(field.get(), smallWorld(flags | SGM_WORLD_BY_DISTANCE));
    look(world.get(), 0);
    comeToRest(world.get());
    std::set<int32_t> levels;
    for (const MeshOwner& mesh : drawnOf(world.get())) {
      const sgm_mesh_view view = viewOf(mesh);
      for (uint32_t v = 0; v < view.vertex_count; ++v)
        if ((view.vertices[v].kind & SGM_VERTEX_FEATURE) != 0) levels.insert(view.key.level);
    }
    CHECK((levels.size() > 1) == (flags != 0));
    CHECK((!levels.empty()) == (flags != 0));
  }
}

TEST_CASE("a world tells what it is, who looks, and how long its work takes", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  sgm_world_desc desc = smallWorld(SGM_WORLD_BY_DISTANCE | SGM_WORLD_MEASURE);
  desc.collider_distance = 5;
  desc.max_colliders = 3;
  const WorldOwner world = makeWorld(field.get(), desc);
  sgm_world* const made = world.get();
  sgm_world_info info = SGM_WORLD_INFO_INIT;
  REQUIRE(sgm_world_get_info(made, &info, nullptr) == SGM_OK);
  CHECK(info.cell_units == 512);
  CHECK(info.top_level == 3);
  CHECK(info.flags == desc.flags);
  CHECK(info.threads >= 1);
  CHECK(info.finest_distance == 10);
  CHECK(info.view_distance == 60);
  CHECK(info.collider_distance == 5);
  CHECK(info.mesh_bytes == uint64_t{256} << 20);
  CHECK(info.backend.usable == 1);
  CHECK(std::string(info.backend.name) == "cpu");
  CHECK(std::strlen(info.backend.device) > 0);

  sgm_viewer two[2] = {SGM_VIEWER_INIT, SGM_VIEWER_INIT};
  two[0].position[0] = 1.25;
  two[0].direction[2] = 1;
  two[1].velocity[1] = 3;
  two[1].weight = 2;
  REQUIRE(sgm_world_set_viewers(made, two, 0, 2, nullptr) == SGM_OK);
  sgm_viewer back[2] = {SGM_VIEWER_INIT, SGM_VIEWER_INIT};
  size_t count = 1;
  CHECK(sgm_world_get_viewers(made, back, 0, &count, nullptr) == SGM_INCOMPLETE);
  REQUIRE(count == 2);
  CHECK(back[0].position[0] == 0);
  REQUIRE(sgm_world_get_viewers(made, back, 0, &count, nullptr) == SGM_OK);
  CHECK(std::memcmp(two, back, sizeof two) == 0);

  uint64_t updates = 0, polls = 0, all_colliders = 0;
  std::set<uint64_t> hashes;
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  do {
    REQUIRE(sgm_world_update(made, 1 << 20, nullptr) == SGM_OK);
    ++updates;
    sgm_world_event events[64];
    size_t colliders = 0;
    for (size_t taken = 1; taken > 0; ++polls) {
      taken = std::size(events);
      REQUIRE(sgm_world_poll(made, events, 0, &taken, nullptr) == SGM_OK);
      for (size_t i = 0; i < taken; ++i) {
        sgm_mesh_release(events[i].mesh);
        if (events[i].collider == nullptr) continue;
        ++colliders;
        sgm_collider_view view = SGM_COLLIDER_VIEW_INIT;
        REQUIRE(sgm_collider_get_view(events[i].collider, &view, nullptr) == SGM_OK);
        hashes.insert(view.hash);
        sgm_collider_release(events[i].collider);
      }
    }
    CHECK(colliders <= 3);
    all_colliders += colliders;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    REQUIRE(sgm_world_get_stats(made, &stats, nullptr) == SGM_OK);
  } while (stats.idle == 0);
  CHECK(all_colliders > 0);
  CHECK(hashes.count(0) == 0);
  sgm_world_times times = SGM_WORLD_TIMES_INIT;
  REQUIRE(sgm_world_get_times(made, &times, nullptr) == SGM_OK);
  const auto sum = [](const sgm_time_histogram& of) {
    return std::accumulate(std::begin(of.counts), std::end(of.counts), uint64_t{0});
  };
  CHECK(sum(times.update) == updates);
  CHECK(sum(times.poll) == polls);
  CHECK(sum(times.read) == 0);
  uint64_t meshed = 0;
  double seconds = 0;
  for (const sgm_time_histogram& level : times.mesh) {
    meshed += sum(level);
    seconds += level.sum;
    CHECK(level.longest <= level.sum);
  }
  CHECK(meshed == stats.chunks_meshed);
  CHECK(sum(times.mesh[0]) == stats.finest_meshed);
  CHECK(sum(times.mesh[4]) == 0);
  CHECK(seconds > 0);
  CHECK(times.update.longest > 0);
}

TEST_CASE("a world that measures gives sums of what it draws, and each chunk's own measures", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  const WorldOwner world = makeWorld(field.get(), smallWorld(SGM_WORLD_MEASURE));
  look(world.get(), 0);
  comeToRest(world.get());
  sgm_world_measures measures = SGM_WORLD_MEASURES_INIT;
  REQUIRE(sgm_world_get_measures(world.get(), &measures, nullptr) == SGM_OK);

  double area = 0, flux = 0;
  uint64_t triangles = 0;
  for (const sgm_drawn_chunk& chunk : drawnChunks(world.get())) {
    const MeshOwner mesh(chunk.mesh);
    sgm_mesh_measures of_chunk = SGM_MESH_MEASURES_INIT;
    REQUIRE(sgm_mesh_get_measures(chunk.mesh, chunk.seams, &of_chunk, nullptr) == SGM_OK);
    const sgm_mesh_view view = viewOf(mesh);
    CHECK(of_chunk.vertices == view.body.vertex_count);
    uint64_t border = 0;
    for (const uint64_t edges : of_chunk.border_edges) border += edges;
    CHECK(of_chunk.sums.border_edges == border);
    // Edge count: each triangle has three sides; an inner edge belongs to two triangles, a border edge to one.
    CHECK(2 * of_chunk.edges == view.body.index_count + border);
    area += of_chunk.sums.area;
    flux += of_chunk.sums.flux;
    triangles += of_chunk.sums.triangles;
    for (const uint64_t defects : of_chunk.sums.defects) CHECK(defects == 0);
    CHECK(sgm_mesh_get_measures(chunk.mesh, 64, &of_chunk, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  }
  CHECK(triangles > 1000);
  CHECK(measures.drawn.triangles == triangles);
  CHECK(std::fabs(measures.drawn.area - area) < 1e-9 * area);
  CHECK(std::fabs(measures.drawn.flux - flux) < 1e-9 * flux);
  // The balls have a radius of 7 m. At coarse levels, the ratio of area to volume is only roughly that of a ball, 3/7.
  CHECK(measures.drawn.flux > 0);
  CHECK(measures.drawn.area / measures.drawn.flux > 3.0 / 7 * 0.9);
  CHECK(measures.drawn.area / measures.drawn.flux < 3.0 / 7 * 1.4);
  for (const double component : measures.drawn.area_vector) CHECK(std::fabs(component) < 1e-9 * area);
  CHECK(measures.made.triangles >= triangles);
  for (const uint64_t defects : measures.made.defects) CHECK(defects == 0);
  CHECK(measures.measuring_seconds > 0);
  CHECK(measures.meshing_seconds > 0);
}

TEST_CASE("another field takes a world's place, and only what it changes is meshed again", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  // A grammar with two layers of balls, one of them with a parameter.
  const std::string text = std::string(kBalls) +
                           "param wide = 3m in 1m..4m animated;\n"
                           "layer rare cell 128m reach 8m detail 2m { start Rare; }\n"
                           "rule Rare { at(40m, 24m, 24m) sphere(wide); }\n";
  const GrammarOwner grammar = compile(runtime.get(), text.c_str());
  const auto fieldWith = [&](double wide, int32_t cell) {
    sgm_parameters* made = nullptr;
    REQUIRE(sgm_parameters_create(grammar.get(), &made, nullptr) == SGM_OK);
    const ParametersOwner parameters(made);
    REQUIRE(sgm_parameters_set(made, "wide", wide, nullptr) == SGM_OK);
    sgm_field_desc desc = SGM_FIELD_DESC_INIT;
    desc.grammar = grammar.get();
    desc.parameters = made;
    desc.seed = 7;
    desc.cell_units = cell;
    sgm_field* field = nullptr;
    REQUIRE(sgm_field_create(runtime.get(), &desc, &field, nullptr) == SGM_OK);
    return FieldOwner(field);
  };
  const WorldOwner world = makeWorld(fieldWith(3, 512).get());
  Engine engine;
  const auto rest = [&] {
    comeToRest(world.get());
    engine.poll(world.get());
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    REQUIRE(sgm_world_get_stats(world.get(), &stats, nullptr) == SGM_OK);
    CHECK(stats.edits_drawn == stats.edits_state);
    return stats;
  };
  look(world.get(), 0);
  const sgm_world_stats before = rest();
  const std::map<Key, Drawn> small = engine.drawn;
  CHECK(before.chunks_outdated == 0);
  REQUIRE(sgm_world_set_field(world.get(), fieldWith(4, 512).get(), nullptr) == SGM_OK);
  const sgm_world_stats after = rest();
  CHECK(after.chunks_outdated > 0);
  CHECK(4 * after.chunks_outdated < before.kept);
  CHECK(engine.drawn != small);
  // The hash after the replacement equals the hash of a world that was created with the new field.
  const int32_t low[3] = {0, 0, 0}, high[3] = {65536, 32768, 32768};
  uint64_t streamed = 0;
  REQUIRE(sgm_world_hash(world.get(), low, high, 0, &streamed, nullptr) == SGM_OK);
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  for (size_t axis = 0; axis < 3; ++axis) {
    region.minimum[axis] = low[axis];
    region.maximum[axis] = high[axis];
  }
  CHECK(streamed == sgm_surface_hash(surfaceOf(fieldWith(4, 512).get(), region).get()));
  REQUIRE(sgm_world_set_field(world.get(), fieldWith(3, 512).get(), nullptr) == SGM_OK);
  rest();
  CHECK(engine.drawn == small);

  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_world_set_field(world.get(), fieldWith(3, 256).get(), &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(std::string(error.message).find("0.25 m") != std::string::npos);
  const RuntimeOwner other = makeRuntime();
  const FieldOwner foreign = makeField(other.get(), compile(other.get(), kBalls).get(), 512);
  CHECK(sgm_world_set_field(world.get(), foreign.get(), &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(std::string(error.message).find("runtime") != std::string::npos);
}

TEST_CASE("a grammar that was edited is reloaded into a world that streams", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const WorldOwner world = makeWorld(makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512).get());
  Engine engine;
  look(world.get(), 0);
  comeToRest(world.get());
  engine.poll(world.get());
  const std::map<Key, Drawn> balls = engine.drawn;
  // Several new fields (boxes instead of balls, and a new layer) replace each other while the viewer moves; only the
  // last one must remain.
  for (const char* rule : {"rule Ball { at(8m, 8m, 8m) box(9m); }\n", "rule Ball { at(8m, 8m, 8m) box(11m); }\n"}) {
    const std::string text =
        "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m detail 2m { start Ball; }\n" + std::string(rule);
    const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), text.c_str()).get(), 512);
    REQUIRE(sgm_world_set_field(world.get(), field.get(), nullptr) == SGM_OK);
    REQUIRE(sgm_world_update(world.get(), 1 << 20, nullptr) == SGM_OK);
    engine.poll(world.get());
  }
  comeToRest(world.get());
  engine.poll(world.get());
  CHECK(engine.drawn != balls);
  const WorldOwner fresh = makeWorld(
      makeField(runtime.get(),
                compile(runtime.get(),
                        "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m detail 2m { start Ball; }\n"
                        "rule Ball { at(8m, 8m, 8m) box(11m); }\n")
                    .get(),
                512)
          .get());
  Engine anew;
  look(fresh.get(), 0);
  comeToRest(fresh.get());
  anew.poll(fresh.get());
  CHECK(engine.drawn == anew.drawn);
}

TEST_CASE("a wait can be ended, and a world cancelled, at any time", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBalls).get(), 512);
  const WorldOwner world = makeWorld(field.get());
  look(world.get(), 0);
  const auto stop = [](void*, uint64_t done, uint64_t total) -> int32_t { return done <= total ? 1 : 2; };
  CHECK(sgm_world_wait_idle(world.get(), stop, nullptr, nullptr) == SGM_ERR_CANCELLED);
  sgm_world_cancel(world.get());
  comeToRest(world.get());
}
