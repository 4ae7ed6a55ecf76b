// Calls functions for chunks, surfaces, measures and worlds with NULL, with structs of a wrong size and with numbers
// out of range: each call must return an error code and not crash.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "arguments.h"

TEST_CASE("chunk calls are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  sgm_chunk_request request = SGM_CHUNK_REQUEST_INIT;
  sgm_chunks_desc good = SGM_CHUNKS_DESC_INIT;
  good.requests = &request;
  good.count = 1;
  // kTooMany: a number of entries that every call here must reject; wild: an invalid mesh pointer, with which the tests
  // fill arrays before each call.
  constexpr size_t kTooMany = (size_t{1} << 20) + 1;
  sgm_mesh* const wild = reinterpret_cast<sgm_mesh*>(&world);
  std::vector<sgm_mesh*> meshes(kTooMany + 1);
  const auto meshOn = [&](sgm_field* field, const sgm_chunks_desc* desc, bool refused) {
    std::fill(meshes.begin(), meshes.end(), wild);
    const sgm_result result = sgm_mesh_chunks(field, desc, meshes.data(), &error);
    const size_t written = refused ? 0 : desc->count;
    CHECK(std::count(meshes.begin(), meshes.end(), nullptr) == static_cast<std::ptrdiff_t>(written));
    CHECK(std::count(meshes.begin() + static_cast<std::ptrdiff_t>(written), meshes.end(), nullptr) == 0);
    return result;
  };
  const auto meshWith = [&](const sgm_chunks_desc* desc) { return meshOn(world.field.get(), desc, false); };
  checkStruct(good, [&](const sgm_chunks_desc* desc) { return meshOn(world.field.get(), desc, true); });
  const auto with = [&](auto change) {
    sgm_chunks_desc desc = good;
    change(desc);
    return meshWith(&desc);
  };
  sgm_mesh* mesh = nullptr;
  CHECK(meshOn(nullptr, &good, false) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_chunks(world.field.get(), &good, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.requests = nullptr; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.count = 0; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.count = kTooMany; }) == SGM_ERR_LIMIT);
  CHECK(with([](auto& d) { d.flags = 4; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.reserved = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  for (const size_t stride : {size_t{1}, sizeof(sgm_chunk_request) - 4, sizeof(sgm_chunk_request) + 2})
    CHECK(with([stride](auto& d) { d.request_stride = stride; }) == SGM_ERR_INVALID_ARGUMENT);
  for (const int32_t level : {-1, SGM_MAX_LEVEL + 1, std::numeric_limits<int32_t>::min()}) {
    request.key.level = level;
    CHECK(meshWith(&good) == SGM_ERR_INVALID_ARGUMENT);
  }
  request = chunkAt({0, 0, 0, 0}, 64);
  CHECK(meshWith(&good) == SGM_ERR_INVALID_ARGUMENT);
  // Of the 27 blocks around and including the chunk, 13 is the chunk itself, and 27 and above do not exist.
  for (const uint32_t block : {13u, 27u, 31u}) {
    request = chunkAt({0, 0, 0, 0});
    request.coarser = 1u << block;
    CHECK(meshWith(&good) == SGM_ERR_INVALID_ARGUMENT);
  }
  for (const size_t word : {size_t{0}, size_t{1}}) {
    request = chunkAt({0, 0, 0, 0});
    request.reserved[word] = 1;
    CHECK(meshWith(&good) == SGM_ERR_INVALID_ARGUMENT);
  }
  const int32_t far = std::numeric_limits<int32_t>::max(), low = std::numeric_limits<int32_t>::min();
  // A chunk's edge is 8192 units, so chunk coordinates must be within +-2^31 / 8192 = +-262144.
  for (const sgm_chunk_key key :
       {sgm_chunk_key{0, far, 0, 0}, sgm_chunk_key{0, 0, low, 0}, sgm_chunk_key{0, 0, 0, 262144},
        sgm_chunk_key{0, -262145, 0, 0}, sgm_chunk_key{SGM_MAX_LEVEL, 1, 0, 0}}) {
    request = chunkAt(key);
    CHECK(meshWith(&good) == SGM_ERR_RANGE);
  }
  request = chunkAt({0, -262144, 262143 - 1, 0}, 63);
  REQUIRE(sgm_mesh_chunks(world.field.get(), &good, &mesh, &error) == SGM_OK);
  const MeshOwner owner(mesh);
  checkStruct(sgm_mesh_view SGM_MESH_VIEW_INIT,
              [&](sgm_mesh_view* view) { return sgm_mesh_get_view(mesh, view, &error); });
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  CHECK(sgm_mesh_get_view(nullptr, &view, &error) == SGM_ERR_INVALID_ARGUMENT);
  checkStruct(sgm_mesh_measures SGM_MESH_MEASURES_INIT,
              [&](sgm_mesh_measures* measures) { return sgm_mesh_get_measures(mesh, 0, measures, &error); });
  sgm_mesh_measures measures = SGM_MESH_MEASURES_INIT;
  CHECK(sgm_mesh_get_measures(nullptr, 0, &measures, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_get_measures(mesh, 0, &measures, &error) == SGM_ERR_UNSUPPORTED);
  size_t vertices = 0, indices = 0;
  CHECK(sgm_mesh_copy(nullptr, nullptr, 0, &vertices, nullptr, 0, &indices, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_copy(mesh, nullptr, 0, nullptr, nullptr, 0, &indices, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_copy(mesh, nullptr, 0, &vertices, nullptr, 0, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_copy(mesh, nullptr, 8, &vertices, nullptr, 0, &indices, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_copy(mesh, nullptr, 17, &vertices, nullptr, 0, &indices, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_copy(mesh, nullptr, 0, &vertices, nullptr, 2, &indices, &error) == SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("surface calls are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  sgm_region_desc good = SGM_REGION_DESC_INIT;
  for (int axis = 0; axis < 3; ++axis) good.maximum[axis] = 8192;
  const auto meshWith = [&](const sgm_region_desc* desc) {
    sgm_surface* out = nullptr;
    const sgm_result result = sgm_surface_from_region(world.field.get(), desc, &out, &error);
    CHECK(out == nullptr);
    return result;
  };
  checkStruct(good, meshWith);
  const auto with = [&](auto change) {
    sgm_region_desc desc = good;
    change(desc);
    return meshWith(&desc);
  };
  sgm_surface* surface = nullptr;
  CHECK(sgm_surface_from_region(nullptr, &good, &surface, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_surface_from_region(world.field.get(), &good, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.maximum[1] = 0; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.flags = 4; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.level = SGM_MAX_LEVEL + 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.level = -1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) {
          d.maximum[0] = 8193;
          d.max_chunks = 1;
        }) == SGM_ERR_LIMIT);
  // Two regions with too many chunks: for the first, the list would not fit into memory; the second only exceeds the
  // limit.
  for (const int32_t far : {1 << 30, 300 * 8192})
    CHECK(with([far](auto& d) {
            for (int32_t& v : d.maximum) v = far;
            d.max_chunks = std::numeric_limits<uint64_t>::max();
          }) == SGM_ERR_LIMIT);
  CHECK(with([](auto& d) {
          for (int axis = 0; axis < 3; ++axis) {
            d.minimum[axis] = std::numeric_limits<int32_t>::min();
            d.maximum[axis] = std::numeric_limits<int32_t>::max();
          }
        }) == SGM_ERR_RANGE);

  sgm_grid_desc grid = SGM_GRID_DESC_INIT;
  const std::vector<float> values(8, 1.0f);
  grid.values = values.data();
  for (uint32_t& size : grid.size) size = 2;
  checkStruct(grid, [&](sgm_grid_desc* desc) {
    sgm_surface* out = nullptr;
    return sgm_surface_from_grid(world.runtime.get(), desc, &out, &error);
  });
  CHECK(sgm_surface_from_grid(nullptr, &grid, &surface, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_surface_from_grid(world.runtime.get(), &grid, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  REQUIRE(sgm_surface_from_grid(world.runtime.get(), &grid, &surface, &error) == SGM_OK);
  const SurfaceOwner owner(surface);
  checkStruct(sgm_surface_view SGM_SURFACE_VIEW_INIT,
              [&](sgm_surface_view* view) { return sgm_surface_get_view(surface, view, &error); });
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
  CHECK(sgm_surface_get_view(nullptr, &view, &error) == SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("measuring is checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  sgm_measures measures = SGM_MEASURES_INIT;
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double doubles[9] = {};
  const uint32_t indices[3] = {0, 1, 2};
  double histogram[33];
  sgm_measure_desc good = SGM_MEASURE_DESC_INIT;
  good.positions = positions;
  good.position_count = 3;
  good.indices = indices;
  good.index_count = 3;
  const auto with = [&](const sgm_measure_desc* desc) {
    return sgm_measure(world.runtime.get(), desc, &measures, &error);
  };
  checkStruct(good, with);
  checkStruct(sgm_measures SGM_MEASURES_INIT,
              [&](sgm_measures* out) { return sgm_measure(world.runtime.get(), &good, out, &error); });
  CHECK(sgm_measure(nullptr, &good, &measures, &error) == SGM_ERR_INVALID_ARGUMENT);
  REQUIRE(with(&good) == SGM_OK);
  CHECK(measures.open_edges == 3);

  const auto refused = [&](auto&& change) {
    sgm_measure_desc desc = good;
    change(desc);
    CHECK(with(&desc) == SGM_ERR_INVALID_ARGUMENT);
    return std::string(error.message);
  };
  CHECK(refused([&](sgm_measure_desc& d) { d.position_count = uint64_t{1} << 32; }) ==
        "desc.position_count is more than 2^32 - 1");
  CHECK(refused([&](sgm_measure_desc& d) { d.index_count = 2; }) ==
        "desc.index_count is not a multiple of 3 or is above 2^32 - 1");
  CHECK(refused([&](sgm_measure_desc& d) { d.positions = nullptr; }) ==
        "exactly one of desc.positions and desc.positions_double must be given");
  CHECK(refused([&](sgm_measure_desc& d) { d.positions_double = doubles; }) ==
        "exactly one of desc.positions and desc.positions_double must be given");
  CHECK(refused([&](sgm_measure_desc& d) { d.position_stride = 8; }) ==
        "desc.position_stride is below the size of three coordinates or not a multiple of the size of one");
  CHECK(refused([&](sgm_measure_desc& d) { d.position_stride = uint64_t{1} << 63; }) ==
        "desc.position_stride is too large");
  CHECK(refused([&](sgm_measure_desc& d) { d.indices = nullptr; }) == "desc.indices is NULL");
  CHECK(refused([&](sgm_measure_desc& d) { d.position_count = 2; }) == "desc.indices[2] is 2, but there are 2 points");
  CHECK(refused([&](sgm_measure_desc& d) { d.weld = -1; }) == "desc.weld is not a finite number of at least 0");
  CHECK(refused([&](sgm_measure_desc& d) { d.weld = std::nan(""); }) ==
        "desc.weld is not a finite number of at least 0");
  CHECK(refused([&](sgm_measure_desc& d) { d.cubes = HUGE_VAL; }) == "desc.cubes is not a finite number of at least 0");
  CHECK(refused([&](sgm_measure_desc& d) { d.histogram_mode = 3; }) ==
        "desc.histogram_mode is not a valid sgm_histogram_mode");
  CHECK(refused([&](sgm_measure_desc& d) { d.histogram_bins = 0; }) ==
        "a histogram has 1 to 4096 bins, not 0: an odd number is best");
  CHECK(refused([&](sgm_measure_desc& d) { d.curvature_length = 0; }) ==
        "the length that curvature is scaled by must be more than 0");
  CHECK(refused([&](sgm_measure_desc& d) { d.flags = 4; }) ==
        "desc.flags has unknown bits: pass 0 or values of sgm_measure_flag");
  CHECK(refused([&](sgm_measure_desc& d) { d.histogram_capacity = 3; }) == "desc.histogram is NULL");

  sgm_measure_desc small = good;
  small.histogram = histogram;
  small.histogram_capacity = 3;
  CHECK(with(&small) == SGM_INCOMPLETE);
  small.histogram_capacity = 33;
  CHECK(with(&small) == SGM_OK);
  small.cubes = 1e-6;
  CHECK(with(&small) == SGM_ERR_LIMIT);
}

TEST_CASE("world calls are checked") {
  World fixture;
  sgm_error error = SGM_ERROR_INIT;
  sgm_world_desc good = SGM_WORLD_DESC_INIT;
  good.top_level = 2;
  good.view_distance = 20;
  const auto createWith = [&](const sgm_world_desc* desc) {
    sgm_world* out = reinterpret_cast<sgm_world*>(&fixture);
    const sgm_result result = sgm_world_create(fixture.field.get(), desc, &out, &error);
    CHECK(out == nullptr);
    return result;
  };
  checkStruct(good, createWith);
  const auto with = [&](auto change) {
    sgm_world_desc desc = good;
    change(desc);
    return createWith(&desc);
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  CHECK(with([](auto& d) { d.top_level = -1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.top_level = SGM_MAX_LEVEL + 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.top_level = 15; }) == SGM_ERR_RANGE);
  CHECK(with([](auto& d) { d.flags = 64; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.flags = SGM_WORLD_RESIDENT; }) == SGM_ERR_UNSUPPORTED);
  CHECK(with([](auto& d) { d.finest_distance = 0; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.view_distance = kNaN; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.mesh_bytes = 1000; }) == SGM_ERR_LIMIT);
  sgm_world* world = nullptr;
  CHECK(sgm_world_create(nullptr, &good, &world, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_create(fixture.field.get(), &good, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  REQUIRE(sgm_world_create(fixture.field.get(), &good, &world, &error) == SGM_OK);
  const WorldOwner owner(world);

  sgm_viewer viewer = SGM_VIEWER_INIT;
  CHECK(sgm_world_set_viewers(nullptr, &viewer, 0, 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_set_viewers(world, nullptr, 0, 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_set_viewers(world, &viewer, 12, 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_set_viewers(world, nullptr, 0, 0, &error) == SGM_OK);
  viewer.position[2] = kNaN;
  CHECK(sgm_world_set_viewers(world, &viewer, 0, 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  viewer.position[2] = 3e6;
  CHECK(sgm_world_set_viewers(world, &viewer, 0, 1, &error) == SGM_ERR_RANGE);

  CHECK(sgm_world_update(nullptr, 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_update(world, 0, &error) == SGM_ERR_INVALID_ARGUMENT);
  sgm_world_event event;
  size_t count = 1;
  CHECK(sgm_world_poll(nullptr, &event, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_poll(world, nullptr, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_poll(world, &event, 0, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_poll(world, &event, 9, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  sgm_drawn_chunk drawn;
  CHECK(sgm_world_get_drawn(nullptr, &drawn, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_get_drawn(world, &drawn, 0, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_get_drawn(world, &drawn, 5, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_wait_idle(nullptr, nullptr, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  sgm_world_cancel(nullptr);
  CHECK(sgm_world_set_field(nullptr, fixture.field.get(), &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_set_field(world, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);

  CHECK(with([](auto& d) { d.collider_distance = -1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.view_distance = 1e7; }) == SGM_ERR_LIMIT);
  CHECK(with([](auto& d) { d.journal = "/no/such/folder/journal"; }) == SGM_ERR_IO);
  CHECK(with([](auto& d) { d.cache_folder = "/dev/null/folder"; }) != SGM_OK);
  CHECK(with([](auto& d) { d.store_count = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  const char* const no_stores[] = {nullptr};
  CHECK(with([&](auto& d) { d.stores = no_stores, d.store_count = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  const char* const stores[] = {"/no/such/store"};
  CHECK(with([&](auto& d) { d.stores = stores, d.store_count = 1; }) ==
        (SGM_TEST_DISK_CACHE ? SGM_ERR_DATA : SGM_ERR_UNSUPPORTED));
  const std::vector<sgm_viewer> crowd(1025, sgm_viewer SGM_VIEWER_INIT);
  CHECK(sgm_world_set_viewers(world, crowd.data(), 0, crowd.size(), &error) == SGM_ERR_LIMIT);
  sgm_brush brush = SGM_BRUSH_INIT;
  sgm_edit_id id{7, 7};
  CHECK(sgm_world_edit(nullptr, &brush, &id, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(id.number == 0);
  CHECK(sgm_world_edit(world, nullptr, &id, &error) == SGM_ERR_INVALID_ARGUMENT);
  const auto refused = [&](auto change) {
    sgm_brush wrong = SGM_BRUSH_INIT;
    change(wrong);
    return sgm_world_edit(world, &wrong, &id, &error);
  };
  CHECK(refused([](auto& b) { b.shape = static_cast<sgm_brush_shape>(9); }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(refused([](auto& b) { b.radius = 0; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(refused([](auto& b) { b.material = 999; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(refused([](auto& b) { b.from[1] = std::numeric_limits<int32_t>::max(); }) == SGM_ERR_RANGE);
  CHECK(sgm_world_undo(nullptr, &id, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_undo(world, nullptr, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  id = {5, 5};
  CHECK(sgm_world_undo(world, &id, &id, &error) == SGM_ERR_NOT_FOUND);
  size_t bytes = 0;
  CHECK(sgm_world_export_edits(nullptr, 0, nullptr, &bytes, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_export_edits(world, 0, nullptr, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_import_edits(nullptr, "x", 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_import_edits(world, nullptr, 1, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_import_edits(world, "x", 1, &error) == SGM_ERR_DATA);
  CHECK(sgm_world_flush_edits(nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_edits_hash(nullptr) == 0);
  sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  sgm_closest_desc closest = SGM_CLOSEST_DESC_INIT;
  sgm_walk_desc walk = SGM_WALK_DESC_INIT;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_walkable walkable = SGM_WALKABLE_INIT;
  CHECK(sgm_world_ray_cast(nullptr, &ray, &point, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_ray_cast(world, nullptr, &point, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_closest_point(nullptr, &closest, &point, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_closest_point(world, &closest, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_is_walkable(nullptr, &walk, &walkable, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_is_walkable(world, &walk, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  const sgm_way_desc way_desc = SGM_WAY_DESC_INIT;
  sgm_way way = SGM_WAY_INIT;
  CHECK(sgm_world_find_way(nullptr, &way_desc, &way, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_find_way(world, &way_desc, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  sgm_density_desc density = SGM_DENSITY_DESC_INIT;
  uint8_t dense = 7;
  density.values = &dense;
  for (uint32_t& size : density.size) size = 1;
  CHECK(sgm_world_sample_density(world, &density, &error) == SGM_OK);
  CHECK(sgm_world_sample_density(nullptr, &density, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_sample_density(world, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  density.level = 1;
  CHECK(sgm_world_sample_density(world, &density, &error) == SGM_OK);
  density.level = -1;
  CHECK(sgm_world_sample_density(world, &density, &error) == SGM_ERR_INVALID_ARGUMENT);
  sgm_collider_view collider = SGM_COLLIDER_VIEW_INIT;
  CHECK(sgm_collider_get_view(nullptr, &collider, &error) == SGM_ERR_INVALID_ARGUMENT);

  const int32_t low[3] = {0, 0, 0}, high[3] = {100, 100, 100};
  uint64_t hash = 0;
  CHECK(sgm_world_hash(nullptr, low, high, 0, &hash, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_hash(world, nullptr, high, 0, &hash, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_hash(world, low, nullptr, 0, &hash, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_hash(world, low, high, 0, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_hash(world, high, low, 0, &hash, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_hash(world, low, high, 99, &hash, &error) == SGM_ERR_INVALID_ARGUMENT);
  checkStruct(sgm_world_stats SGM_WORLD_STATS_INIT,
              [&](sgm_world_stats* stats) { return sgm_world_get_stats(world, stats, &error); });
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  CHECK(sgm_world_get_stats(nullptr, &stats, &error) == SGM_ERR_INVALID_ARGUMENT);
  checkStruct(sgm_world_info SGM_WORLD_INFO_INIT,
              [&](sgm_world_info* info) { return sgm_world_get_info(world, info, &error); });
  sgm_world_info info = SGM_WORLD_INFO_INIT;
  CHECK(sgm_world_get_info(nullptr, &info, &error) == SGM_ERR_INVALID_ARGUMENT);
  checkStruct(sgm_world_times SGM_WORLD_TIMES_INIT,
              [&](sgm_world_times* times) { return sgm_world_get_times(world, times, &error); });
  sgm_world_times times = SGM_WORLD_TIMES_INIT;
  CHECK(sgm_world_get_times(nullptr, &times, &error) == SGM_ERR_INVALID_ARGUMENT);
  size_t viewer_count = 0;
  CHECK(sgm_world_get_viewers(nullptr, nullptr, 0, &viewer_count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_get_viewers(world, nullptr, 0, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_get_viewers(world, nullptr, 3, &viewer_count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_get_viewers(world, nullptr, 0, &viewer_count, &error) == SGM_OK);
  checkStruct(sgm_world_measures SGM_WORLD_MEASURES_INIT,
              [&](sgm_world_measures* measures) { return sgm_world_get_measures(world, measures, &error); });
  sgm_world_measures measures = SGM_WORLD_MEASURES_INIT;
  CHECK(sgm_world_get_measures(nullptr, &measures, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_world_get_measures(world, &measures, &error) == SGM_ERR_UNSUPPORTED);
}
