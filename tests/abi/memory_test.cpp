// Makes every allocation fail in turn: each time the call must report it, nothing may leak, and the next attempt must
// succeed.

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "failing_memory.h"
#include "fixture.h"

namespace {

struct Handles {
  sgm_runtime* runtime = nullptr;
  sgm_grammar* grammar = nullptr;
  sgm_diagnostics* diagnostics = nullptr;
  sgm_parameters* parameters = nullptr;
  sgm_field* field = nullptr;
  sgm_mesh* meshes[2] = {};
  sgm_surface* region = nullptr;
  sgm_surface* grid = nullptr;
};

/// Calls functions of the whole interface in order, and stops at the first one that fails.
sgm_result everything(Handles& h, const sgm_allocator& allocator, uint32_t threads, sgm_error* error) {
  sgm_runtime_desc runtime = SGM_RUNTIME_DESC_INIT;
  runtime.allocator = &allocator;
  runtime.threads = threads;
  if (sgm_result r = sgm_runtime_create(&runtime, &h.runtime, error); r != SGM_OK) return r;
  sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
  text.text = kBall;
  if (sgm_result r = sgm_grammar_compile(h.runtime, &text, &h.grammar, &h.diagnostics, error); r != SGM_OK) return r;
  if (sgm_result r = sgm_parameters_create(h.grammar, &h.parameters, error); r != SGM_OK) return r;
  if (sgm_result r = sgm_parameters_set_text(h.parameters, "radius", "2m", error); r != SGM_OK) return r;
  sgm_field_desc field = SGM_FIELD_DESC_INIT;
  field.grammar = h.grammar;
  field.parameters = h.parameters;
  if (sgm_result r = sgm_field_create(h.runtime, &field, &h.field, error); r != SGM_OK) return r;
  const sgm_chunk_request requests[2] = {chunkAt({0, 0, 0, 0}, 63), chunkAt({1, 0, 0, 0})};
  sgm_chunks_desc chunks = SGM_CHUNKS_DESC_INIT;
  chunks.requests = requests;
  chunks.count = 2;
  chunks.flags = SGM_MESHING_TEXTURE | SGM_MESHING_SHARP;
  if (sgm_result r = sgm_mesh_chunks(h.field, &chunks, h.meshes, error); r != SGM_OK) return r;
  const int32_t points[6] = {0, 0, 0, 4096, 4096, 4096};
  float values[2], gradients[6];
  sgm_sample_desc sample = SGM_SAMPLE_DESC_INIT;
  sample.points = points;
  sample.count = 2;
  sample.values = values;
  sample.gradients = gradients;
  if (sgm_result r = sgm_field_sample(h.field, &sample, error); r != SGM_OK) return r;
  uint8_t fog[27];
  sgm_density_desc density = SGM_DENSITY_DESC_INIT;
  density.values = fog;
  for (uint32_t& size : density.size) size = 3;
  if (sgm_result r = sgm_field_sample_density(h.field, &density, error); r != SGM_OK) return r;
  sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  sgm_closest_desc closest = SGM_CLOSEST_DESC_INIT;
  ray.from[0] = ray.from[2] = closest.position[0] = closest.position[2] = 4096;
  ray.from[1] = closest.position[1] = 8192;
  ray.length = closest.max_distance = 5;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  if (sgm_result r = sgm_field_ray_cast(h.field, &ray, &point, error); r != SGM_OK) return r;
  if (sgm_result r = sgm_field_closest_point(h.field, &closest, &point, error); r != SGM_OK) return r;
  sgm_walk_desc walk = SGM_WALK_DESC_INIT;
  for (int32_t& v : walk.maximum) v = 8192;
  sgm_walkable walkable = SGM_WALKABLE_INIT;
  if (sgm_result r = sgm_field_is_walkable(h.field, &walk, &walkable, error); r != SGM_OK) return r;
  sgm_way_desc way_desc = SGM_WAY_DESC_INIT;
  for (int32_t& v : way_desc.maximum) v = 8192;
  way_desc.to[0] = 8000;
  sgm_way way = SGM_WAY_INIT;
  if (sgm_result r = sgm_field_find_way(h.field, &way_desc, &way, error); r != SGM_OK) return r;
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  for (int32_t& v : region.maximum) v = 20000;
  region.flags = SGM_MESHING_TEXTURE | SGM_MESHING_SHARP;
  if (sgm_result r = sgm_surface_from_region(h.field, &region, &h.region, error); r != SGM_OK) return r;
  const float grid_values[8] = {-1, 1, 1, 1, 1, 1, 1, 1};
  sgm_grid_desc grid = SGM_GRID_DESC_INIT;
  grid.values = grid_values;
  for (uint32_t& size : grid.size) size = 2;
  if (sgm_result r = sgm_surface_from_grid(h.runtime, &grid, &h.grid, error); r != SGM_OK) return r;
  const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const uint32_t sides[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  sgm_measure_desc tetrahedron = SGM_MEASURE_DESC_INIT;
  tetrahedron.positions = corners;
  tetrahedron.position_count = 4;
  tetrahedron.indices = sides;
  tetrahedron.index_count = 12;
  tetrahedron.cubes = 0.25;
  sgm_measures measures = SGM_MEASURES_INIT;
  return sgm_measure(h.runtime, &tetrahedron, &measures, error);
}

void endAll(Handles& h) {
  sgm_surface_destroy(h.grid);
  sgm_surface_destroy(h.region);
  for (sgm_mesh* mesh : h.meshes) sgm_mesh_release(mesh);
  sgm_field_destroy(h.field);
  sgm_parameters_destroy(h.parameters);
  sgm_diagnostics_destroy(h.diagnostics);
  sgm_grammar_destroy(h.grammar);
  CHECK(sgm_runtime_destroy(h.runtime) == SGM_OK);
}

}  // namespace

// Replaces operator new of the whole program, including the shared library, by one that can be made to fail.
void* operator new(size_t size) {
  if (void* memory = heapAllocate(size, alignof(std::max_align_t))) return memory;
  throw std::bad_alloc();
}
void* operator new(size_t size, std::align_val_t alignment) {
  if (void* memory = heapAllocate(size, static_cast<size_t>(alignment))) return memory;
  throw std::bad_alloc();
}
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  return heapAllocate(size, alignof(std::max_align_t));
}
void* operator new(size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return heapAllocate(size, static_cast<size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }

TEST_CASE("each allocation from the allocator fails in turn") {
  Failing failing;
  const sgm_allocator allocator{Failing::allocate, Failing::release, &failing};
  // n: number of allocations that succeed. It grows in steps of 1, later in larger steps, because later allocations
  // mostly repeat the same code paths.
  int64_t tries = 0;
  for (int64_t n = 0;; n += 1 + n / 64) {
    failing.left = n;
    Handles handles;
    sgm_error error = SGM_ERROR_INIT;
    const sgm_result result = everything(handles, allocator, 1, &error);
    failing.left = INT64_MAX;
    endAll(handles);
    REQUIRE(failing.live == 0);
    ++tries;
    if (result == SGM_OK) break;
    INFO("allocation " << n << ": " << error.message);
    REQUIRE(result == SGM_ERR_OUT_OF_MEMORY);
    REQUIRE(error.code == SGM_ERR_OUT_OF_MEMORY);
  }
  CHECK(tries > 20);
}

namespace {

/// For increasing n, makes the n-th allocation of the C++ heap and all later ones fail.
template <class Begin, class End>
void failHeap(uint32_t threads, Begin begin, End end) {
  const sgm_allocator allocator{[](void*, size_t size, size_t alignment) {
                                  return std::aligned_alloc(std::max<size_t>(alignment, 16), (size + 63) / 64 * 64);
                                },
                                [](void*, void* memory, size_t, size_t) { std::free(memory); }, nullptr};
  for (int64_t n = 0;; n += 1 + n / 48) {
    Handles handles;
    sgm_error error = SGM_ERROR_INIT;
    begin(n);
    const sgm_result result = everything(handles, allocator, threads, &error);
    end();
    endAll(handles);
    if (result == SGM_OK) break;
    INFO("allocation " << n << ", " << threads << " threads: " << error.message);
    REQUIRE(result == SGM_ERR_OUT_OF_MEMORY);
  }
}

}  // namespace

TEST_CASE("each allocation of the C++ heap on the calling thread fails in turn") {
  for (const uint32_t threads : {1u, 3u})
    failHeap(
        threads, [](int64_t n) { heap_left = n; }, [] { heap_left = -1; });
}

TEST_CASE("each allocation of the C++ heap on any thread fails in turn") {
  failHeap(
      3, [](int64_t n) { heap_left_everywhere = n; }, [] { heap_left_everywhere = INT64_MAX; });
}

TEST_CASE("threads that mesh a grid together end together, whichever of them has no memory") {
  // A slab is the part of the grid that one thread meshes at a time. The layers of samples are so large here that a
  // slab has only four of them, so there are more slabs than threads. The ball extends into every slab.
  constexpr size_t kX = 512, kY = 256, kZ = 18;
  constexpr size_t kCount = kX * kY * kZ;
  const std::unique_ptr<float, void (*)(void*)> values(static_cast<float*>(std::malloc(kCount * sizeof(float))),
                                                       std::free);
  for (size_t i = 0; i < kCount; ++i) {
    const double x = static_cast<double>(i % kX) - 250, y = static_cast<double>(i / kX % kY) - 100,
                 z = static_cast<double>(i / (kX * kY)) - 9;
    values.get()[i] = static_cast<float>(std::sqrt(x * x + y * y + 9 * z * z) - 24.5);
  }
  Failing failing;
  const sgm_allocator allocator{Failing::allocate, Failing::release, &failing};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.allocator = &allocator;
  desc.threads = 3;
  sgm_grid_desc grid = SGM_GRID_DESC_INIT;
  grid.values = values.get();
  grid.size[0] = kX;
  grid.size[1] = kY;
  grid.size[2] = kZ;
  const auto failAt = [&](int64_t n, bool heap) {
    sgm_runtime* runtime = nullptr;
    REQUIRE(sgm_runtime_create(&desc, &runtime, nullptr) == SGM_OK);
    sgm_surface* surface = nullptr;
    (heap ? heap_left_everywhere : failing.left) = n;
    const sgm_result result = sgm_surface_from_grid(runtime, &grid, &surface, nullptr);
    heap_left_everywhere = failing.left = INT64_MAX;
    CHECK((result == SGM_OK || result == SGM_ERR_OUT_OF_MEMORY));
    CHECK((result == SGM_OK) == (surface != nullptr));
    sgm_surface_destroy(surface);
    CHECK(sgm_runtime_destroy(runtime) == SGM_OK);
    CHECK(failing.live == 0);
    return result == SGM_OK;
  };
  for (const bool heap : {false, true}) {
    int64_t n = 0;
    while (!failAt(n, heap)) ++n;
    INFO("allocations " << n);
    CHECK(n > (heap ? 1 : 10));
  }
}

TEST_CASE("handles are ended, and ended again, without any memory") {
  Failing failing;
  const sgm_allocator allocator{Failing::allocate, Failing::release, &failing};
  Handles handles;
  REQUIRE(everything(handles, allocator, 1, nullptr) == SGM_OK);
  failing.left = 0;
  heap_left = 0;
  const sgm_result first = sgm_field_destroy(handles.field), second = sgm_field_destroy(handles.field);
  const sgm_result mesh = sgm_mesh_release(handles.meshes[0]), again = sgm_mesh_release(handles.meshes[0]);
  heap_left = -1;
  failing.left = INT64_MAX;
  CHECK(first == SGM_OK);
  CHECK(second == SGM_ERR_INVALID_ARGUMENT);
  CHECK(mesh == SGM_OK);
  CHECK(again == SGM_ERR_INVALID_ARGUMENT);
  handles.field = nullptr;
  handles.meshes[0] = nullptr;
  endAll(handles);
  CHECK(failing.live == 0);
}
