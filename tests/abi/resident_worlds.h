#pragma once
// Worlds whose meshes stay in device memory, for tests in which the engine provides the device.

#include <random>

#include "fixture.h"
#include "rounds.h"
#include "seed.h"

/// A grammar of balls with lumps around them.
inline constexpr const char* kLumps =
    "sgm 1; units m; domain infinite;\nlayer l cell 16m reach 8m detail 1m { start Lump; }\n"
    "rule Lump { at(8m, 8m, 8m) { scatter 5 on disc(4m) sphere(rand(1m, 3m)); } }\n";

/// Waits until the device is ready. A streamed world does not wait for the device by itself, but meshes on the CPU
/// meanwhile.
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
  sgm_world_desc desc = smallWorld(flags);
  desc.cache_folder = cache;
  return makeWorld(field, desc);
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

/// Moves a viewer at random in two equal worlds of the grammar `text`: one on `field`, one on the CPU. Calls
/// check(mesh) for every mesh of the first world, which is in device memory; check must return the mesh's number of
/// triangles.
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
    // Meshes that the engine still holds must not be overwritten by later meshes: check them again.
    for (const MeshOwner& mesh : kept) check(mesh);
    kept = std::move(meshes);
  }
}

/// Checks that the meshes of a field on the CPU have no view in device memory, and that each call which asks for device
/// memory returns the right error. lend: name of the function by which an engine would provide its device. getView:
/// fills a view, which is initialised from `init`. isEmpty(view): whether the view refers to no memory.
template <class View, class GetView, class IsEmpty>
void checkNothingBorrowed(sgm_field* on_cpu, const char* lend, const View& init, GetView getView, IsEmpty isEmpty) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.flags = SGM_WORLD_RESIDENT;
  sgm_world* refused = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_world_create(on_cpu, &desc, &refused, &error) == SGM_ERR_UNSUPPORTED);
  CHECK_THAT(error.message, Catch::Contains(lend));
  const WorldOwner world = makeWorld(on_cpu, 0);
  look(world.get(), 0, 0);
  waitIdle(world.get());
  const std::vector<MeshOwner> meshes = drawnOf(world.get());
  REQUIRE(!meshes.empty());
  View view = init;
  CHECK(getView(meshes[0].get(), &view, &error) == SGM_ERR_NOT_FOUND);
  CHECK_THAT(error.message, Catch::Contains("SGM_WORLD_RESIDENT"));
  CHECK(isEmpty(view));
  CHECK(getView(nullptr, &view, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(getView(meshes[0].get(), nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  view.struct_size = 1;
  CHECK(getView(meshes[0].get(), &view, nullptr) == SGM_ERR_STRUCT_SIZE);
}
