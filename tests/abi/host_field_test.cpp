// Tests a field that the host computes, through the C interface: it is sampled, queried and streamed, and rejected
// where it cannot be used.

#include <atomic>
#include <cmath>
#include <limits>

#include "fixture.h"

namespace {

/// A field that is solid below a height in metres, and can be made to fail.
struct Ground {
  double height = 4;
  std::atomic<bool> fails{false};
  std::atomic<uint64_t> calls{0};
};

sgm_result sampleGround(void* user, const sgm_host_lattice* at, float* values) {
  auto& ground = *static_cast<Ground*>(user);
  ++ground.calls;
  if (ground.fails) return SGM_ERR_IO;
  size_t i = 0;
  for (uint32_t z = 0; z < at->count[2]; ++z) {
    for (uint32_t y = 0; y < at->count[1]; ++y) {
      const double height = (at->origin[1] + static_cast<double>(y) * at->spacing) / SGM_UNITS_PER_METRE;
      for (uint32_t x = 0; x < at->count[0]; ++x) values[i++] = static_cast<float>(height - ground.height);
    }
  }
  return SGM_OK;
}

sgm_host_field hostOf(Ground& ground) {
  sgm_host_field host = SGM_HOST_FIELD_INIT;
  host.sample = sampleGround;
  host.user = &ground;
  host.identity = 1;
  host.steepness = 1;
  return host;
}

FieldOwner makeHosted(sgm_runtime* runtime, const sgm_grammar* grammar, const sgm_host_field& host, sgm_error* error) {
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar;
  desc.cell_units = 256;
  desc.hosts = &host;
  desc.host_count = 1;
  sgm_field* field = nullptr;
  sgm_field_create(runtime, &desc, &field, error);
  return FieldOwner(field);
}

}  // namespace

TEST_CASE("a host's ground lies beside the grammar's ball: samples, rays, meshes") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  Ground ground;
  sgm_host_field host = hostOf(ground);
  host.material = 1;
  sgm_error error = SGM_ERROR_INIT;
  const FieldOwner field = makeHosted(runtime.get(), grammar.get(), host, &error);
  INFO(error.message);
  REQUIRE(field);

  const int32_t points[6] = {20 * 1024, 3 * 1024, 4096, 20 * 1024, 5 * 1024, 4096};
  float values[2] = {}, gradients[6] = {};
  uint16_t materials[2] = {};
  sgm_sample_desc sample = SGM_SAMPLE_DESC_INIT;
  sample.points = points;
  sample.count = 2;
  sample.values = values;
  sample.gradients = gradients;
  sample.materials = materials;
  REQUIRE(sgm_field_sample(field.get(), &sample, &error) == SGM_OK);
  CHECK(values[0] < 0);
  CHECK(values[1] > 0);
  CHECK(materials[0] == 1);

  sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  ray.from[0] = 20 * 1024;
  ray.from[1] = 9 * 1024;
  ray.from[2] = 4096;
  ray.length = 10;
  sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
  REQUIRE(sgm_field_ray_cast(field.get(), &ray, &hit, &error) == SGM_OK);
  REQUIRE(hit.found == 1);
  CHECK(hit.distance == Approx(5).margin(2.0 / 1024));
  CHECK(hit.normal[1] == Approx(1).margin(1e-3));
  CHECK(hit.material == 1);

  const std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 5, 0, 5}), chunkAt({0, 5, 3, 5})});
  CHECK(viewOf(meshes[0]).vertex_count == 33 * 33);
  CHECK(viewOf(meshes[1]).vertex_count == 0);
}

TEST_CASE("a host that cannot be sampled fails chunks, and the last good frame stays") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  Ground ground;
  sgm_error error = SGM_ERROR_INIT;
  const FieldOwner field = makeHosted(runtime.get(), grammar.get(), hostOf(ground), &error);
  REQUIRE(field);
  sgm_world_desc desc = smallWorld();
  desc.top_level = 2;
  const WorldOwner world = makeWorld(field.get(), desc);
  sgm_viewer viewer = SGM_VIEWER_INIT;
  viewer.position[1] = 6;
  const auto settle = [&] {
    REQUIRE(sgm_world_set_viewers(world.get(), &viewer, 0, 1, &error) == SGM_OK);
    REQUIRE(sgm_world_wait_idle(world.get(), nullptr, nullptr, &error) == SGM_OK);
    uint64_t failed = 0;
    std::array<sgm_world_event, 64> events{};
    for (;;) {
      size_t count = events.size();
      REQUIRE(sgm_world_poll(world.get(), events.data(), 0, &count, &error) == SGM_OK);
      if (count == 0) return failed;
      for (size_t i = 0; i < count; ++i) {
        failed += events[i].kind == SGM_EVENT_FAILED;
        if (events[i].mesh != nullptr) sgm_mesh_release(events[i].mesh);
      }
    }
  };
  CHECK(settle() == 0);
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  REQUIRE(sgm_world_get_stats(world.get(), &stats, &error) == SGM_OK);
  CHECK(stats.drawn > 4);
  ground.fails = true;
  viewer.position[0] = 40;
  const uint64_t failed = settle();
  CHECK(failed > 0);
  REQUIRE(sgm_world_get_stats(world.get(), &stats, &error) == SGM_OK);
  CHECK(stats.chunks_failed == failed);
  CHECK(stats.drawn > 0);

  const int32_t point[3] = {0, 0, 0};
  float value = 0;
  sgm_sample_desc sample = SGM_SAMPLE_DESC_INIT;
  sample.points = point;
  sample.count = 1;
  sample.values = &value;
  CHECK(sgm_field_sample(field.get(), &sample, &error) == SGM_ERR_IO);
  CHECK(std::string(error.message).find("SGM_ERR_IO") != std::string::npos);
}

TEST_CASE("what a host's field says of itself is checked") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  Ground ground;
  const auto refused = [&](auto&& spoil, sgm_result expected, const std::string& named) {
    sgm_host_field host = hostOf(ground);
    spoil(host);
    sgm_error error = SGM_ERROR_INIT;
    CHECK_FALSE(makeHosted(runtime.get(), grammar.get(), host, &error));
    CHECK(error.code == expected);
    INFO(error.message);
    CHECK(std::string(error.message).find(named) != std::string::npos);
  };
  using Host = sgm_host_field;
  refused([](Host& h) { h.struct_size = 3; }, SGM_ERR_STRUCT_SIZE, "desc.hosts[0]");
  refused([](Host& h) { h.next = &h; }, SGM_ERR_UNSUPPORTED, "desc.hosts[0]");
  refused([](Host& h) { h.sample = nullptr; }, SGM_ERR_INVALID_ARGUMENT, "sample");
  refused([](Host& h) { h.minimum[2] = h.maximum[2] = 1, h.minimum[2] = 2; }, SGM_ERR_INVALID_ARGUMENT, "minimum");
  refused([](Host& h) { h.steepness = -1; }, SGM_ERR_INVALID_ARGUMENT, "steepness");
  refused([](Host& h) { h.steepness = std::numeric_limits<float>::quiet_NaN(); }, SGM_ERR_INVALID_ARGUMENT,
          "steepness");
  refused([](Host& h) { h.flags = 2; }, SGM_ERR_INVALID_ARGUMENT, "flags");
  refused([](Host& h) { h.material = 99; }, SGM_ERR_INVALID_ARGUMENT, "material");
  refused([](Host& h) { h.tag = 99; }, SGM_ERR_INVALID_ARGUMENT, "tag");
  refused([](Host& h) { h.smooth = -1; }, SGM_ERR_INVALID_ARGUMENT, "smooth");
  refused([](Host& h) { h.smooth = 16385; }, SGM_ERR_INVALID_ARGUMENT, "smooth");
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar.get();
  desc.host_count = 1;
  sgm_field* field = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_field_create(runtime.get(), &desc, &field, &error) == SGM_ERR_INVALID_ARGUMENT);
  const std::vector<sgm_host_field> many(17, hostOf(ground));
  desc.hosts = many.data();
  desc.host_stride = 7;
  CHECK(sgm_field_create(runtime.get(), &desc, &field, &error) == SGM_ERR_INVALID_ARGUMENT);
  desc.host_stride = 0;
  desc.hosts = many.data();
  desc.host_count = many.size();
  CHECK(sgm_field_create(runtime.get(), &desc, &field, &error) == SGM_ERR_LIMIT);
}

TEST_CASE("a world keeps nothing on disk of a host's field without identity") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  Ground ground;
  sgm_host_field host = hostOf(ground);
  host.identity = 0;
  sgm_error error = SGM_ERROR_INIT;
  const FieldOwner field = makeHosted(runtime.get(), grammar.get(), host, &error);
  REQUIRE(field);
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 2;
  desc.view_distance = 60;
  desc.journal = "never-made.journal";
  sgm_world* world = nullptr;
  CHECK(sgm_world_create(field.get(), &desc, &world, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(std::string(error.message).find("identity") != std::string::npos);
}
