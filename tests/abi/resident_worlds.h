#pragma once
// Worlds whose meshes stay in device memory, for tests of devices that engines provide.

#include <random>

#include "fixture.h"
#include "rounds.h"
#include "seed.h"

/// A grammar of balls with lumps around them.
inline constexpr const char* kLumps =
    "sgm 1; units m; domain infinite;\nlayer l cell 16m reach 8m detail 1m { start Lump; }\n"
    "rule Lump { at(8m, 8m, 8m) { scatter 5 on disc(4m) sphere(rand(1m, 3m)); } }\n";
inline constexpr const char* kBalls =
    "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m detail 2m { start Ball; }\n"
    "rule Ball { at(8m, 8m, 8m) sphere(7m); }\n";

/// Waits until the device is ready. A streamed world would not wait, but mesh on the CPU instead.
inline void makeReady(sgm_field* field) {
  std::vector<sgm_chunk_request> requests;
  for (int level = 0; level < 4; ++level) {
    for (int corner = 0; corner < 8; ++corner) {
      requests.push_back(chunkAt({level, corner % 2 - 1, corner / 2 % 2 - 1, corner / 4 - 1}, 63));
    }
  }
  meshChunks(field, requests);
}

inline WorldOwner makeWorld(sgm_field* field, uint32_t flags, const char* cache = nullptr) {
  if (flags & SGM_WORLD_RESIDENT) makeReady(field);
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 3;
  desc.flags = flags;
  desc.finest_distance = 10;
  desc.view_distance = 60;
  desc.cache_folder = cache;
  sgm_world* world = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_world_create(field, &desc, &world, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return WorldOwner(world);
}

inline void look(sgm_world* world, double x, double z) {
  sgm_viewer viewer = SGM_VIEWER_INIT;
  viewer.position[0] = x;
  viewer.position[2] = z;
  REQUIRE(sgm_world_set_viewers(world, &viewer, 0, 1, nullptr) == SGM_OK);
}

inline std::vector<MeshOwner> drawnOf(sgm_world* world) {
  size_t count = 0;
  REQUIRE(sgm_world_get_drawn(world, nullptr, 0, &count, nullptr) == SGM_OK);
  std::vector<sgm_drawn_chunk> chunks(count);
  REQUIRE(sgm_world_get_drawn(world, chunks.data(), 0, &count, nullptr) == SGM_OK);
  std::vector<MeshOwner> meshes;
  for (const sgm_drawn_chunk& chunk : chunks) meshes.emplace_back(chunk.mesh);
  return meshes;
}

inline void pollAll(sgm_world* world) {
  sgm_world_event events[16];
  for (size_t count = 16;; count = 16) {
    REQUIRE(sgm_world_poll(world, events, 0, &count, nullptr) == SGM_OK);
    if (count == 0) return;
    for (size_t i = 0; i < count; ++i) sgm_mesh_release(events[i].mesh);
  }
}

inline void waitIdle(sgm_world* world) {
  REQUIRE(sgm_world_wait_idle(world, nullptr, nullptr, nullptr) == SGM_OK);
  pollAll(world);
}

/// Moves a viewer at random in two equal worlds of `text`: one on `field`, one on the CPU. Calls check(mesh) for every
/// mesh of the first world, where it lies in device memory; check returns the mesh's number of triangles.
template <class Check>
void wanderBeside(sgm_field* field, const char* text, const Check& check) {
  const unsigned seed = sgm::testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-40, 40);
  const WorldOwner world = makeWorld(field, SGM_WORLD_RESIDENT);
  const RuntimeOwner other = makeRuntime();
  const GrammarOwner grammar = compile(other.get(), text);
  const FieldOwner other_field = makeField(other.get(), grammar.get(), 256, SGM_BACKEND_CPU);
  const WorldOwner on_cpu = makeWorld(other_field.get(), 0);
  std::vector<MeshOwner> kept;
  for (unsigned step = 0; step < sgm::rounds(3); ++step) {
    const double x = place(random), z = place(random);
    for (sgm_world* one : {world.get(), on_cpu.get()}) {
      look(one, x, z);
      waitIdle(one);
    }
    std::vector<MeshOwner> meshes = drawnOf(world.get());
    CHECK(meshes.size() == drawnOf(on_cpu.get()).size());
    size_t triangles = 0;
    for (const MeshOwner& mesh : meshes) triangles += check(mesh);
    CHECK(triangles > 0);
    // Meshes that the engine holds must not be overwritten by meshes that are made later.
    for (const MeshOwner& mesh : kept) check(mesh);
    kept = std::move(meshes);
  }
}
