// Calls every function with NULL, with structs of a wrong size and with numbers out of range: each call must return an
// error code and not crash.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "fixture.h"

namespace {

struct World {
  RuntimeOwner runtime = makeRuntime();
  GrammarOwner grammar = compile(runtime.get(), kBall);
  FieldOwner field = makeField(runtime.get(), grammar.get());
};

sgm_chain extension = {sizeof(sgm_chain), 1, nullptr};

/// Calls a function with structs that are too small, too large, or continued by an unknown extension.
template <class Desc, class Call>
void checkStruct(Desc good, Call&& call) {
  for (const uint32_t size : {0u, 4u, good.struct_size - 1, good.struct_size + 8, 0xFFFFFFFFu}) {
    Desc bad = good;
    bad.struct_size = size;
    CHECK(call(&bad) == SGM_ERR_STRUCT_SIZE);
  }
  Desc extended = good;
  extended.next = &extension;
  CHECK(call(&extended) == SGM_ERR_UNSUPPORTED);
  CHECK(call(static_cast<Desc*>(nullptr)) == SGM_ERR_INVALID_ARGUMENT);
}

}  // namespace

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

TEST_CASE("chunk calls are checked") {
  World world;
  sgm_error error = SGM_ERROR_INIT;
  sgm_chunk_request request = SGM_CHUNK_REQUEST_INIT;
  sgm_chunks_desc good = SGM_CHUNKS_DESC_INIT;
  good.requests = &request;
  good.count = 1;
  // More entries than any call here may write, filled with an invalid mesh pointer.
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
  // The chunk itself (block 13), and bits beyond the 27 blocks.
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
  // The chunk's edge is 8192 units, so 2^31 / 8192 chunks fit on each side of the origin.
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
  // A number of chunks that no memory holds, and one just above the limit.
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
