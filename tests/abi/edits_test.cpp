// Tests edits, colliders and data that outlive a world, through the C interface alone.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <tuple>

#include "fixture.h"
#include "temporary_folder.h"

namespace {

/// A world of solid rock: any void in it comes from an edit.
constexpr const char* kRock =
    "sgm 1; units m; domain infinite solid;\nlayer l cell 32m reach 8m { start Ball; }\n"
    "rule Ball { at(8m, 8m, 8m) cut sphere(5m); }\n";

using Key = std::tuple<int32_t, int32_t, int32_t, int32_t>;

/// An engine that records the world's events, and releases the meshes in them.
struct EditingEngine {
  ~EditingEngine() {
    for (const auto& [key, mesh] : meshes) sgm_mesh_release(mesh);
    for (const auto& [key, collider] : colliders) sgm_collider_release(collider);
  }
  void poll(sgm_world* world) {
    sgm_world_event event;
    for (size_t count = 1;; count = 1) {
      REQUIRE(sgm_world_poll(world, &event, 0, &count, nullptr) == SGM_OK);
      if (count == 0) return;
      const Key key{event.key.level, event.key.x, event.key.y, event.key.z};
      REQUIRE(event.kind != SGM_EVENT_FAILED);
      CHECK((event.collider != nullptr) == (event.kind == SGM_EVENT_COLLIDER));
      if (event.mesh != nullptr) std::swap(meshes[key], event.mesh);
      sgm_mesh_release(event.mesh);
      if (event.kind == SGM_EVENT_REMOVED) {
        sgm_mesh_release(meshes[key]);
        meshes.erase(key);
      }
      if (event.kind == SGM_EVENT_COLLIDER_REMOVED) REQUIRE(colliders.count(key) == 1);
      if (event.kind == SGM_EVENT_COLLIDER || event.kind == SGM_EVENT_COLLIDER_REMOVED) {
        std::swap(colliders[key], event.collider);
        sgm_collider_release(event.collider);
      }
      if (event.kind == SGM_EVENT_COLLIDER_REMOVED) colliders.erase(key);
    }
  }
  std::map<Key, sgm_mesh*> meshes;
  std::map<Key, sgm_collider*> colliders;
};

/// Makes a world with a viewer at its origin.
WorldOwner makeViewedWorld(sgm_field* field, const sgm_world_desc& desc = smallWorld()) {
  WorldOwner world = makeWorld(field, desc);
  look(world.get(), 0);
  return world;
}

sgm_edit_id dig(sgm_world* world, int32_t x, int32_t y, int32_t z, int32_t radius) {
  sgm_brush brush = SGM_BRUSH_INIT;
  brush.from[0] = x;
  brush.from[1] = y;
  brush.from[2] = z;
  brush.radius = radius;
  sgm_edit_id id{};
  REQUIRE(sgm_world_edit(world, &brush, &id, nullptr) == SGM_OK);
  CHECK(id.number != 0);
  return id;
}

sgm_world_stats statsOf(const sgm_world* world) {
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  REQUIRE(sgm_world_get_stats(world, &stats, nullptr) == SGM_OK);
  return stats;
}

uint64_t hashOf(sgm_world* world) {
  const int32_t low[3] = {-20 * 1024, -20 * 1024, -20 * 1024}, high[3] = {20 * 1024, 20 * 1024, 20 * 1024};
  uint64_t hash = 0;
  REQUIRE(sgm_world_hash(world, low, high, 0, &hash, nullptr) == SGM_OK);
  return hash;
}

void settle(sgm_world* world, EditingEngine& engine) {
  REQUIRE(sgm_world_wait_idle(world, nullptr, nullptr, nullptr) == SGM_OK);
  engine.poll(world);
}

}  // namespace

TEST_CASE("what is dug joins two hollows, and its undo parts them again") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kRock).get(), 512);
  const WorldOwner world = makeViewedWorld(field.get());
  sgm_way_desc desc = SGM_WAY_DESC_INIT;
  desc.minimum[0] = desc.minimum[1] = desc.minimum[2] = -16 * 1024;
  desc.maximum[0] = desc.maximum[1] = desc.maximum[2] = 16 * 1024;
  desc.from[0] = -4 * 1024;
  desc.to[0] = 4 * 1024;
  sgm_way way = SGM_WAY_INIT;
  const auto verdict = [&] {
    REQUIRE(sgm_world_find_way(world.get(), &desc, &way, nullptr) == SGM_OK);
    return way.verdict;
  };
  CHECK(verdict() == SGM_WAY_FROM_IN_ROCK);
  dig(world.get(), -4 * 1024, 0, 0, 2 * 1024);
  CHECK(verdict() == SGM_WAY_TO_IN_ROCK);
  dig(world.get(), 4 * 1024, 0, 0, 2 * 1024);
  CHECK(verdict() == SGM_WAY_APART);
  CHECK(way.from_volume == way.to_volume);
  const sgm_edit_id id = dig(world.get(), 0, 0, 0, 3 * 1024);
  CHECK(verdict() == SGM_WAY_FOUND);
  CHECK(way.length == 8.0);
  REQUIRE(sgm_world_undo(world.get(), &id, nullptr, nullptr) == SGM_OK);
  CHECK(verdict() == SGM_WAY_APART);
  REQUIRE(sgm_field_find_way(field.get(), &desc, &way, nullptr) == SGM_OK);
  CHECK(way.verdict == SGM_WAY_FROM_IN_ROCK);
}

TEST_CASE("a dig is drawn, collided with and asked about, and its undo takes all of that back", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kRock).get(), 512);
  sgm_world_desc desc = smallWorld();
  desc.collider_distance = 12;
  const WorldOwner world = makeViewedWorld(field.get(), desc);
  EditingEngine engine;
  settle(world.get(), engine);
  const uint64_t whole = hashOf(world.get());

  const int32_t radius = 3 * 1024;
  const sgm_edit_id id = dig(world.get(), -4 * 1024, 0, 0, radius);
  sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  ray.from[0] = -4 * 1024;
  ray.direction[0] = 1;
  ray.direction[1] = 0;
  ray.length = 10;
  sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
  REQUIRE(sgm_world_ray_cast(world.get(), &ray, &hit, nullptr) == SGM_OK);
  CHECK(hit.found == 1);
  CHECK(hit.inside == 0);
  CHECK(std::abs(hit.distance - 3) < 0.01);
  REQUIRE(sgm_field_ray_cast(field.get(), &ray, &hit, nullptr) == SGM_OK);
  CHECK(hit.inside == 1);  // edits change the world only: the field is still solid at this point

  settle(world.get(), engine);
  CHECK(statsOf(world.get()).edits == 1);
  CHECK(statsOf(world.get()).edits_drawn == statsOf(world.get()).edits_state);
  CHECK(hashOf(world.get()) != whole);
  size_t on_the_sphere = 0;
  for (const auto& [key, collider] : engine.colliders) {
    sgm_collider_view view = SGM_COLLIDER_VIEW_INIT;
    REQUIRE(sgm_collider_get_view(collider, &view, nullptr) == SGM_OK);
    REQUIRE(view.index_count % 3 == 0);
    for (uint32_t i = 0; i < view.index_count; ++i) REQUIRE(view.indices[i] < view.vertex_count);
    for (uint32_t i = 0; i < view.vertex_count; ++i) {
      const float* p = view.positions + 3 * size_t{i};
      const double x = view.origin[0] / 1024.0 + static_cast<double>(p[0]) + 4;
      const double y = view.origin[1] / 1024.0 + static_cast<double>(p[1]);
      const double z = view.origin[2] / 1024.0 + static_cast<double>(p[2]);
      on_the_sphere += std::abs(std::sqrt(x * x + y * y + z * z) - 3) < 0.2;
    }
  }
  CHECK(on_the_sphere > 200);

  sgm_edit_id undone{};
  REQUIRE(sgm_world_undo(world.get(), &id, &undone, nullptr) == SGM_OK);
  settle(world.get(), engine);
  CHECK(hashOf(world.get()) == whole);
  REQUIRE(sgm_world_undo(world.get(), &undone, nullptr, nullptr) == SGM_OK);
  CHECK(hashOf(world.get()) != whole);
}

TEST_CASE("worlds exchange edits as bytes, and are equal then", "[threads]") {
  const RuntimeOwner runtime = makeRuntime();
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kRock).get(), 512);
  const WorldOwner one = makeViewedWorld(field.get()), other = makeViewedWorld(field.get());
  for (int i = 0; i < 5; ++i) {
    dig(one.get(), i * 2048, 0, 0, 2000 + i);
    dig(other.get(), i * 2048, 1024, 0, 2100 + i);
  }
  CHECK(sgm_world_edits_hash(one.get()) != sgm_world_edits_hash(other.get()));
  const auto send = [](sgm_world* from, sgm_world* to) {
    size_t count = 0;
    REQUIRE(sgm_world_export_edits(from, 0, nullptr, &count, nullptr) == SGM_OK);
    std::vector<unsigned char> bytes(count);
    size_t room = count - 1;
    CHECK(sgm_world_export_edits(from, 0, bytes.data(), &room, nullptr) == SGM_INCOMPLETE);
    REQUIRE(sgm_world_export_edits(from, 0, bytes.data(), &count, nullptr) == SGM_OK);
    bytes[count / 2] ^= 1;
    CHECK(sgm_world_import_edits(to, bytes.data(), count, nullptr) == SGM_ERR_DATA);
    bytes[count / 2] ^= 1;
    REQUIRE(sgm_world_import_edits(to, bytes.data(), count, nullptr) == SGM_OK);
  };
  send(one.get(), other.get());
  send(other.get(), one.get());
  CHECK(sgm_world_edits_hash(one.get()) == sgm_world_edits_hash(other.get()));
  CHECK(statsOf(one.get()).edits == 10);
  CHECK(hashOf(one.get()) == hashOf(other.get()));
}

TEST_CASE("a journal and a folder of chunks outlast the world", "[threads]") {
  namespace fs = std::filesystem;
  const sgm::TemporaryFolder temporary;
  const fs::path& folder = temporary.path;
  const std::string journal = (folder / "edits").string(), cache = (folder / "chunks").string();
  sgm_world_desc desc = smallWorld();
  desc.journal = journal.c_str();
  uint64_t hash = 0, edits = 0;
  for (const bool again : {false, true}) {
    CAPTURE(again);
    if (SGM_TEST_DISK_CACHE) desc.cache_folder = cache.c_str();
    const RuntimeOwner runtime = makeRuntime();
    const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kRock).get(), 512);
    const WorldOwner world = makeViewedWorld(field.get(), desc);
    if (!again) {
      dig(world.get(), 0, 0, 0, 2500);
      REQUIRE(sgm_world_flush_edits(world.get(), nullptr) == SGM_OK);
      edits = sgm_world_edits_hash(world.get());
    }
    CHECK(sgm_world_edits_hash(world.get()) == edits);
    EditingEngine engine;
    settle(world.get(), engine);
    if (again) {
      CHECK(hashOf(world.get()) == hash);
    } else {
      hash = hashOf(world.get());
    }
    if (SGM_TEST_DISK_CACHE) CHECK((statsOf(world.get()).cache_hits > 0) == again);
    sgm_error error = SGM_ERROR_INIT;
    sgm_world* second = nullptr;
    // refused: the first world still uses the journal
    CHECK(sgm_world_create(field.get(), &desc, &second, &error) == SGM_ERR_LIMIT);
  }
  // A journal belongs to one world: a world with another seed is refused.
  const RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kRock);
  sgm_field_desc of = SGM_FIELD_DESC_INIT;
  of.grammar = grammar.get();
  of.cell_units = 512;
  of.seed = 99;
  sgm_field* field = nullptr;
  REQUIRE(sgm_field_create(runtime.get(), &of, &field, nullptr) == SGM_OK);
  const FieldOwner owner(field);
  sgm_error error = SGM_ERROR_INIT;
  sgm_world* world = nullptr;
  CHECK(sgm_world_create(field, &desc, &world, &error) == SGM_ERR_DATA);
  CHECK(std::string(error.message).size() > 20);
  { std::ofstream(folder / "other") << "this is no journal, and stays as it is"; }
  const std::string wrong = (folder / "other").string();
  desc.journal = wrong.c_str();
  CHECK(sgm_world_create(field, &desc, &world, &error) == SGM_ERR_DATA);
  CHECK(fs::file_size(folder / "other") == 38);
}
