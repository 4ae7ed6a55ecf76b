// Calls every function with NULL, with structs of a wrong size and with numbers out of range: each call must return an
// error code and not crash.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "arguments.h"

TEST_CASE("functions that end a handle accept NULL") {
  CHECK(sgm_runtime_destroy(nullptr) == SGM_OK);
  CHECK(sgm_grammar_destroy(nullptr) == SGM_OK);
  CHECK(sgm_diagnostics_destroy(nullptr) == SGM_OK);
  CHECK(sgm_parameters_destroy(nullptr) == SGM_OK);
  CHECK(sgm_field_destroy(nullptr) == SGM_OK);
  CHECK(sgm_mesh_acquire(nullptr) == SGM_OK);
  CHECK(sgm_mesh_release(nullptr) == SGM_OK);
  CHECK(sgm_surface_destroy(nullptr) == SGM_OK);
  CHECK(sgm_world_destroy(nullptr) == SGM_OK);
  CHECK(sgm_collider_acquire(nullptr) == SGM_OK);
  CHECK(sgm_collider_release(nullptr) == SGM_OK);
}

TEST_CASE("questions about NULL have an answer") {
  CHECK(sgm_grammar_hash(nullptr) == 0);
  CHECK(sgm_diagnostics_count(nullptr) == 0);
  CHECK(sgm_grammar_material_count(nullptr) == 0);
  CHECK(sgm_grammar_material(nullptr, 0) == nullptr);
  CHECK(sgm_grammar_tag_count(nullptr) == 0);
  CHECK(sgm_grammar_tag(nullptr, 0) == nullptr);
  CHECK(sgm_grammar_name_count(nullptr) == 0);
  CHECK(sgm_grammar_name(nullptr, 0) == nullptr);
  CHECK(sgm_grammar_layer_count(nullptr) == 0);
  CHECK(sgm_grammar_parameter_count(nullptr) == 0);
  CHECK(sgm_surface_hash(nullptr) == 0);
  CHECK(sgm_runtime_memory(nullptr, nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  sgm_diagnostic diagnostic = SGM_DIAGNOSTIC_INIT;
  CHECK(sgm_diagnostics_get(nullptr, 0, &diagnostic) == SGM_ERR_INVALID_ARGUMENT);
  sgm_domain_info domain = SGM_DOMAIN_INFO_INIT;
  CHECK(sgm_grammar_domain(nullptr, &domain) == SGM_ERR_INVALID_ARGUMENT);
  sgm_layer_info layer = SGM_LAYER_INFO_INIT;
  CHECK(sgm_grammar_layer(nullptr, 0, &layer) == SGM_ERR_INVALID_ARGUMENT);
  sgm_parameter_info parameter = SGM_PARAMETER_INFO_INIT;
  CHECK(sgm_grammar_parameter(nullptr, 0, &parameter) == SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("runtime descriptors are checked") {
  const auto call = [](sgm_runtime_desc* desc) {
    sgm_runtime* runtime = nullptr;
    return sgm_runtime_create(desc, &runtime, nullptr);
  };
  sgm_runtime_desc good = SGM_RUNTIME_DESC_INIT;
  for (const uint32_t size : {0u, good.struct_size - 1, good.struct_size + 8}) {
    sgm_runtime_desc bad = good;
    bad.struct_size = size;
    CHECK(call(&bad) == SGM_ERR_STRUCT_SIZE);
  }
  good.next = &extension;
  CHECK(call(&good) == SGM_ERR_UNSUPPORTED);
  CHECK(sgm_runtime_create(nullptr, nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);

  const sgm_allocator no_functions{};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.allocator = &no_functions;
  CHECK(call(&desc) == SGM_ERR_INVALID_ARGUMENT);
  const sgm_job_system no_jobs{};
  desc = SGM_RUNTIME_DESC_INIT;
  desc.jobs = &no_jobs;
  CHECK(call(&desc) == SGM_ERR_INVALID_ARGUMENT);
  const sgm_log_sink no_sink{};
  desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &no_sink;
  CHECK(call(&desc) == SGM_ERR_INVALID_ARGUMENT);
  for (const bool begins : {false, true}) {
    sgm_profiler half{};
    if (begins) half.begin = [](void*, const char*) -> uint64_t { return 0; };
    if (!begins) half.end = [](void*, uint64_t) {};
    desc = SGM_RUNTIME_DESC_INIT;
    desc.profiler = &half;
    CHECK(call(&desc) == SGM_ERR_INVALID_ARGUMENT);
  }
  desc = SGM_RUNTIME_DESC_INIT;
  desc.threads = 1025;
  CHECK(call(&desc) == SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("backend queries are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  checkStruct(sgm_backend_info SGM_BACKEND_INFO_INIT, [&](sgm_backend_info* info) {
    return sgm_backend_query(world.runtime.get(), SGM_BACKEND_CPU, info, &error);
  });
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  CHECK(sgm_backend_query(nullptr, SGM_BACKEND_CPU, &info, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_backend_query(world.runtime.get(), static_cast<sgm_backend>(77), &info, &error) ==
        SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("grammar calls are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  sgm_grammar_desc good = SGM_GRAMMAR_DESC_INIT;
  good.text = kBall;
  sgm_grammar* out = nullptr;
  const auto compileWith = [&](const sgm_grammar_desc* desc) {
    sgm_diagnostics* diagnostics = reinterpret_cast<sgm_diagnostics*>(&world);
    out = reinterpret_cast<sgm_grammar*>(&world);
    const sgm_result result = sgm_grammar_compile(world.runtime.get(), desc, &out, &diagnostics, &error);
    CHECK(out == nullptr);
    CHECK(diagnostics == nullptr);
    CHECK(std::strlen(error.message) > 0);
    return result;
  };
  checkStruct(good, compileWith);
  sgm_grammar_desc no_text = good;
  no_text.text = nullptr;
  CHECK(compileWith(&no_text) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_grammar_compile(nullptr, &good, &out, nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_grammar_compile(world.runtime.get(), &good, nullptr, nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);

  sgm_grammar_desc wrong = good;
  wrong.text = "sgm 1; start";
  sgm_diagnostics* diagnostics = nullptr;
  REQUIRE(sgm_grammar_compile(world.runtime.get(), &wrong, &out, &diagnostics, nullptr) == SGM_ERR_GRAMMAR);
  const DiagnosticsOwner owner(diagnostics);
  checkStruct(sgm_diagnostic SGM_DIAGNOSTIC_INIT,
              [&](sgm_diagnostic* d) { return sgm_diagnostics_get(diagnostics, 0, d); });
  checkStruct(sgm_domain_info SGM_DOMAIN_INFO_INIT,
              [&](sgm_domain_info* d) { return sgm_grammar_domain(world.grammar.get(), d); });
  checkStruct(sgm_layer_info SGM_LAYER_INFO_INIT,
              [&](sgm_layer_info* l) { return sgm_grammar_layer(world.grammar.get(), 0, l); });
  checkStruct(sgm_parameter_info SGM_PARAMETER_INFO_INIT,
              [&](sgm_parameter_info* p) { return sgm_grammar_parameter(world.grammar.get(), 0, p); });
}

TEST_CASE("parameter calls are checked") {
  World world;
  sgm_parameters* parameters = nullptr;
  CHECK(sgm_parameters_create(nullptr, &parameters, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_create(world.grammar.get(), nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  REQUIRE(sgm_parameters_create(world.grammar.get(), &parameters, nullptr) == SGM_OK);
  const ParametersOwner owner(parameters);
  double value = 0;
  CHECK(sgm_parameters_set(nullptr, "radius", 2, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_set(parameters, nullptr, 2, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_set_text(nullptr, "radius", "2m", nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_set_text(parameters, nullptr, "2m", nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_set_text(parameters, "radius", nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_get(nullptr, "radius", &value, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_get(parameters, nullptr, &value, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_get(parameters, "radius", nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_get(parameters, "", &value, nullptr) == SGM_ERR_NOT_FOUND);
}

TEST_CASE("field descriptors are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  sgm_field_desc good = SGM_FIELD_DESC_INIT;
  good.grammar = world.grammar.get();
  const auto create = [&](const sgm_field_desc* desc) {
    sgm_field* out = nullptr;
    const sgm_result result = sgm_field_create(world.runtime.get(), desc, &out, &error);
    CHECK(out == nullptr);
    return result;
  };
  checkStruct(good, create);
  const auto with = [&](auto change) {
    sgm_field_desc desc = good;
    change(desc);
    return create(&desc);
  };
  CHECK(with([](auto& d) { d.grammar = nullptr; }) == SGM_ERR_INVALID_ARGUMENT);
  for (const int32_t cell :
       {0, -1, (1 << 20) + 1, std::numeric_limits<int32_t>::max(), std::numeric_limits<int32_t>::min()})
    CHECK(with([&](auto& d) { d.cell_units = cell; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.backend = static_cast<sgm_backend>(77); }) == SGM_ERR_INVALID_ARGUMENT);

  GrammarOwner other = compile(world.runtime.get(), "sgm 1; units m; start R; rule R { sphere(1m); }");
  sgm_parameters* parameters = nullptr;
  REQUIRE(sgm_parameters_create(other.get(), &parameters, nullptr) == SGM_OK);
  const ParametersOwner owner(parameters);
  CHECK(with([&](auto& d) { d.parameters = parameters; }) == SGM_ERR_INVALID_ARGUMENT);

  sgm_field* out = nullptr;
  CHECK(sgm_field_create(nullptr, &good, &out, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_field_create(world.runtime.get(), &good, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);

  int32_t units = 0;
  CHECK(sgm_cell_from_metres(0.5, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  for (const double metres : {0.0, -1.0, std::nan(""), 1e-9, 0.499 / 1024, 1024.001, 1e9, HUGE_VAL})
    CHECK(sgm_cell_from_metres(metres, &units, &error) == SGM_ERR_INVALID_ARGUMENT);
  REQUIRE(sgm_cell_from_metres(0.501 / 1024, &units, &error) == SGM_OK);
  CHECK(units == 1);
  REQUIRE(sgm_cell_from_metres(0.1, &units, &error) == SGM_OK);
  CHECK(units == 102);
  REQUIRE(sgm_cell_from_metres(1024, &units, &error) == SGM_OK);
  CHECK(units == 1 << 20);
}

TEST_CASE("density calls are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  std::vector<float> values(64 * 64 * 4, -1.0f);
  sgm_density_desc good = SGM_DENSITY_DESC_INIT;
  good.format = SGM_DENSITY_FLOAT32;
  good.values = values.data();
  for (uint32_t& size : good.size) size = 4;
  checkStruct(good, [&](sgm_density_desc* desc) { return sgm_field_sample_density(world.field.get(), desc, &error); });
  const auto with = [&](auto change) {
    sgm_density_desc desc = good;
    change(desc);
    return sgm_field_sample_density(world.field.get(), &desc, &error);
  };
  const sgm_result wrong = SGM_ERR_INVALID_ARGUMENT;
  CHECK(with([](auto&) {}) == SGM_OK);
  CHECK(sgm_field_sample_density(nullptr, &good, &error) == wrong);
  CHECK(with([](auto& d) { d.spacing = 0; }) == wrong);
  CHECK(with([](auto& d) { d.spacing = -5; }) == wrong);
  CHECK(with([](auto& d) { d.size[2] = 0; }) == wrong);
  CHECK(with([](auto& d) { d.size[0] = 16385; }) == wrong);
  CHECK(with([](auto& d) {
          for (uint32_t& size : d.size) size = 16384;
        }) == SGM_ERR_LIMIT);
  CHECK(with([](auto& d) { d.level = -1; }) == wrong);
  CHECK(with([](auto& d) { d.level = SGM_MAX_LEVEL + 1; }) == wrong);
  CHECK(with([](auto& d) { d.level = 15; }) == SGM_ERR_RANGE);
  CHECK(with([](auto& d) { d.level = 3; }) == SGM_OK);
  for (const double edge : {-1.0, 0.9 / 1024, 4096.0 * 256 / 1024 + 1, std::nan(""), HUGE_VAL})
    CHECK(with([&](auto& d) { d.edge = edge; }) == wrong);
  CHECK(with([](auto& d) { d.edge = 4096.0 * 256 / 1024; }) == SGM_OK);
  CHECK(with([](auto& d) { d.format = static_cast<sgm_density_format>(2); }) == wrong);
  CHECK(with([](auto& d) { d.reserved = 1; }) == wrong);
  CHECK(with([](auto& d) { d.values = nullptr; }) == wrong);
  CHECK(with([](auto& d) { d.row_pitch = 12; }) == wrong);
  CHECK(with([](auto& d) { d.row_pitch = 18; }) == wrong);
  CHECK(with([](auto& d) { d.row_pitch = 20; }) == SGM_OK);
  CHECK(with([](auto& d) { d.slice_pitch = 60; }) == wrong);
  CHECK(with([](auto& d) { d.slice_pitch = 68; }) == SGM_OK);
  CHECK(with([](auto& d) { d.row_pitch = SIZE_MAX - 3; }) == wrong);
  CHECK(with([](auto& d) { d.slice_pitch = SIZE_MAX - 3; }) == wrong);
  CHECK(with([](auto& d) { d.origin[1] = std::numeric_limits<int32_t>::max() - 3 * 1024; }) == SGM_OK);
  CHECK(with([](auto& d) { d.origin[1] = std::numeric_limits<int32_t>::max() - 3 * 1024 + 1; }) == SGM_ERR_RANGE);
  CHECK(with([](auto& d) { d.progress = [](void*, uint64_t, uint64_t) -> int32_t { return 1; }; }) == SGM_OK);
  CHECK(with([](auto& d) {
          d.size[0] = 64;
          d.size[1] = 64;
          d.progress = [](void*, uint64_t, uint64_t) -> int32_t { return 1; };
        }) == SGM_ERR_CANCELLED);
}

TEST_CASE("sampling calls are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  const int32_t points[] = {0, 0, 0};
  int32_t q = 0;
  sgm_sample_desc good = SGM_SAMPLE_DESC_INIT;
  good.points = points;
  good.count = 1;
  good.q = &q;
  checkStruct(good, [&](sgm_sample_desc* desc) { return sgm_field_sample(world.field.get(), desc, &error); });
  const auto with = [&](auto change) {
    sgm_sample_desc desc = good;
    change(desc);
    return sgm_field_sample(world.field.get(), &desc, &error);
  };
  CHECK(sgm_field_sample(nullptr, &good, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.points = nullptr; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.point_stride = 8; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.point_stride = 13; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.level = -1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.level = SGM_MAX_LEVEL + 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.count = SIZE_MAX; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) {
          d.count = 0;
          d.points = nullptr;
        }) == SGM_OK);
  CHECK(with([](auto& d) { d.q = nullptr; }) == SGM_OK);

  const int32_t lo[3] = {0, 0, 0}, hi[3] = {8192, 8192, 8192};
  size_t count = 0;
  sgm_field* field = world.field.get();
  CHECK(sgm_field_anchors(nullptr, lo, hi, nullptr, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_field_anchors(field, nullptr, hi, nullptr, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_field_anchors(field, lo, nullptr, nullptr, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_field_anchors(field, lo, hi, nullptr, 0, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_field_anchors(field, hi, lo, nullptr, 0, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
  for (const size_t stride : {size_t{1}, sizeof(sgm_anchor) - 8, sizeof(sgm_anchor) + 4})
    CHECK(sgm_field_anchors(field, lo, hi, nullptr, stride, &count, &error) == SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("questions to the field are checked") {
  World world;
  sgm_field* field = world.field.get();
  sgm_error error = SGM_ERROR_INIT;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");

  const sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  checkStruct(ray, [&](sgm_ray_desc* desc) { return sgm_field_ray_cast(field, desc, &point, &error); });
  checkStruct(point, [&](sgm_surface_point* out) { return sgm_field_ray_cast(field, &ray, out, &error); });
  CHECK(sgm_field_ray_cast(nullptr, &ray, &point, &error) == SGM_ERR_INVALID_ARGUMENT);
  const auto cast = [&](auto change) {
    sgm_ray_desc desc = ray;
    change(desc);
    error = SGM_ERROR_INIT;
    const sgm_result result = sgm_field_ray_cast(field, &desc, &point, &error);
    CHECK((result == SGM_OK) == (error.message[0] == 0));
    return result;
  };
  CHECK(cast([](auto&) {}) == SGM_OK);
  for (const double bad : {nan, infinite, -infinite}) {
    CHECK(cast([&](auto& d) { d.from[1] = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(cast([&](auto& d) { d.direction[2] = bad; }) == SGM_ERR_INVALID_ARGUMENT);
  }
  CHECK(cast([](auto& d) { d.direction[1] = 0; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(cast([&](auto& d) { d.length = nan; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(cast([](auto& d) { d.length = -1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(cast([](auto& d) { d.length = 4096; }) == SGM_OK);
  CHECK(cast([](auto& d) { d.length = 4096.1; }) == SGM_ERR_LIMIT);
  CHECK(cast([](auto& d) { d.from[0] = 2147483648.0; }) == SGM_ERR_RANGE);

  const sgm_closest_desc closest = SGM_CLOSEST_DESC_INIT;
  checkStruct(closest, [&](sgm_closest_desc* desc) { return sgm_field_closest_point(field, desc, &point, &error); });
  checkStruct(point, [&](sgm_surface_point* out) { return sgm_field_closest_point(field, &closest, out, &error); });
  CHECK(sgm_field_closest_point(nullptr, &closest, &point, &error) == SGM_ERR_INVALID_ARGUMENT);
  const auto nearest = [&](auto change) {
    sgm_closest_desc desc = closest;
    change(desc);
    return sgm_field_closest_point(field, &desc, &point, &error);
  };
  CHECK(nearest([](auto&) {}) == SGM_OK);
  CHECK(nearest([&](auto& d) { d.position[0] = nan; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(nearest([](auto& d) { d.position[2] = -2147483649.0; }) == SGM_ERR_RANGE);
  CHECK(nearest([](auto& d) { d.max_distance = -1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(nearest([&](auto& d) { d.max_distance = infinite; }) == SGM_ERR_LIMIT);

  sgm_walk_desc walk = SGM_WALK_DESC_INIT;
  for (int32_t& v : walk.maximum) v = 4096;
  sgm_walkable walkable = SGM_WALKABLE_INIT;
  checkStruct(walk, [&](sgm_walk_desc* desc) { return sgm_field_is_walkable(field, desc, &walkable, &error); });
  checkStruct(walkable, [&](sgm_walkable* out) { return sgm_field_is_walkable(field, &walk, out, &error); });
  CHECK(sgm_field_is_walkable(nullptr, &walk, &walkable, &error) == SGM_ERR_INVALID_ARGUMENT);
  const auto stand = [&](auto change) {
    sgm_walk_desc desc = walk;
    change(desc);
    return sgm_field_is_walkable(field, &desc, &walkable, &error);
  };
  CHECK(stand([](auto&) {}) == SGM_OK);
  CHECK(stand([](auto& d) { d.minimum[1] = d.maximum[1]; }) == SGM_ERR_INVALID_ARGUMENT);
  for (const double bad : {nan, -1.0}) {
    CHECK(stand([&](auto& d) { d.radius = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(stand([&](auto& d) { d.height = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(stand([&](auto& d) { d.step = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(stand([&](auto& d) { d.slope = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(stand([&](auto& d) { d.area = bad; }) == SGM_ERR_INVALID_ARGUMENT);
  }
  CHECK(stand([](auto& d) { d.minimum[0] = std::numeric_limits<int32_t>::min(); }) == SGM_ERR_RANGE);
  CHECK(stand([](auto& d) { d.minimum[0] = -1'000'000'000; }) == SGM_ERR_LIMIT);

  sgm_way_desc way_desc = SGM_WAY_DESC_INIT;
  for (int32_t& v : way_desc.maximum) v = 4096;
  sgm_way way = SGM_WAY_INIT;
  checkStruct(way_desc, [&](sgm_way_desc* desc) { return sgm_field_find_way(field, desc, &way, &error); });
  checkStruct(way, [&](sgm_way* out) { return sgm_field_find_way(field, &way_desc, out, &error); });
  CHECK(sgm_field_find_way(nullptr, &way_desc, &way, &error) == SGM_ERR_INVALID_ARGUMENT);
  const auto seek = [&](auto change) {
    sgm_way_desc desc = way_desc;
    change(desc);
    error = SGM_ERROR_INIT;
    way.verdict = 77;
    const sgm_result result = sgm_field_find_way(field, &desc, &way, &error);
    CHECK((result == SGM_OK) == (error.message[0] == 0));
    CHECK((result == SGM_OK) == (way.verdict != 77));
    return result;
  };
  CHECK(seek([](auto&) {}) == SGM_OK);
  CHECK(seek([](auto& d) { d.minimum[1] = d.maximum[1]; }) == SGM_ERR_INVALID_ARGUMENT);
  for (const double bad : {nan, infinite, -1.0}) {
    CHECK(seek([&](auto& d) { d.radius = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(seek([&](auto& d) { d.from[0] = bad; }) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(seek([&](auto& d) { d.to[2] = bad; }) == SGM_ERR_INVALID_ARGUMENT);
  }
  CHECK(seek([](auto& d) { d.flags = 2; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(seek([](auto& d) { d.reserved = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(seek([](auto& d) { d.minimum[0] = std::numeric_limits<int32_t>::min(); }) == SGM_ERR_RANGE);
  CHECK(seek([](auto& d) { d.minimum[0] = -1'000'000'000; }) == SGM_ERR_LIMIT);
  CHECK(seek([](auto& d) {
          d.maximum[0] = 100'000;
          d.max_chunks = 2;
        }) == SGM_ERR_LIMIT);
}
