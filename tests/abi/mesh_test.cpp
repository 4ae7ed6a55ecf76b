// Tests meshes of chunks: views, copies, hashes, samples and anchors.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "mesh_places.h"

TEST_CASE("a chunk's view: ranges, bounds, tags and anchors agree with its arrays") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  const std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 63), chunkAt({0, 9, 9, 9})});
  const sgm_mesh_view view = viewOf(meshes[0]);
  REQUIRE(view.index_count > 300);
  CHECK(view.index_count % 3 == 0);
  CHECK(view.cell_units == 256);
  CHECK(view.vertex_stride == sizeof(sgm_vertex));
  CHECK(view.body.first_vertex == 0);
  uint32_t vertices = view.body.vertex_count, indices = view.body.index_count;
  for (const sgm_mesh_range& seam : view.seams) {
    CHECK(seam.first_vertex == vertices);
    CHECK(seam.first_index == indices);
    vertices += seam.vertex_count;
    indices += seam.index_count;
  }
  CHECK(vertices == view.vertex_count);
  CHECK(indices == view.index_count);
  for (uint32_t i = 0; i < view.index_count; ++i) REQUIRE(view.indices[i] < view.vertex_count);
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    CHECK(view.vertices[v].material == 1);
    CHECK(view.vertices[v].tag == 1);
    const Place p = placeOf(view, v);
    for (size_t axis = 0; axis < 3; ++axis) {
      CHECK(p[axis] >= int64_t{view.bounds_min[axis]} * 256);
      CHECK(p[axis] <= int64_t{view.bounds_max[axis]} * 256);
    }
    double square = 0;
    for (const int64_t axis : p)
      square += (static_cast<double>(axis) / 262144 - 4) * (static_cast<double>(axis) / 262144 - 4);
    CHECK(std::sqrt(square) == Approx(3).margin(0.02));
  }
  REQUIRE(view.tag_count == 1);
  CHECK(view.tags[0] == 1);
  const sgm_mesh_view empty = viewOf(meshes[1]);
  CHECK(empty.index_count == 0);
  CHECK(empty.vertex_count == 0);
  CHECK(empty.tag_count == 0);
}

TEST_CASE("copies are what the view shows, and say how much room they need") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  const std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 0)});
  const sgm_mesh_view view = viewOf(meshes[0]);
  size_t vertex_count = 0, index_count = 0;
  REQUIRE(sgm_mesh_copy(meshes[0].get(), nullptr, 0, &vertex_count, nullptr, 0, &index_count, nullptr) == SGM_OK);
  CHECK(vertex_count == view.vertex_count);
  CHECK(index_count == view.index_count);
  std::vector<sgm_vertex> vertices(vertex_count);
  std::vector<uint32_t> indices(index_count);
  REQUIRE(sgm_mesh_copy(meshes[0].get(), vertices.data(), 0, &vertex_count, indices.data(), 0, &index_count, nullptr) ==
          SGM_OK);
  CHECK(std::memcmp(vertices.data(), view.vertices, vertex_count * sizeof(sgm_vertex)) == 0);
  CHECK(std::equal(indices.begin(), indices.end(), view.indices));
  size_t too_few = index_count - 1;
  CHECK(sgm_mesh_copy(meshes[0].get(), vertices.data(), 0, &vertex_count, indices.data(), 0, &too_few, nullptr) ==
        SGM_INCOMPLETE);
  CHECK(too_few == index_count);

  // A vertex format of the caller, larger than sgm_vertex: copying vertices into it must leave the other bytes
  // unchanged.
  struct Wide {
    sgm_vertex vertex;
    uint32_t index, mine;
  };
  std::vector<Wide> wide(std::max(vertex_count, index_count), Wide{{}, 0, 77});
  REQUIRE(sgm_mesh_copy(meshes[0].get(), &wide[0].vertex, sizeof(Wide), &vertex_count, &wide[0].index, sizeof(Wide),
                        &index_count, nullptr) == SGM_OK);
  bool same = true;
  for (size_t i = 0; i < vertex_count; ++i)
    same = same && std::memcmp(&wide[i].vertex, view.vertices + i, sizeof(sgm_vertex)) == 0;
  for (size_t i = 0; i < index_count; ++i) same = same && wide[i].index == view.indices[i];
  for (const Wide& w : wide) same = same && w.mine == 77;
  CHECK(same);
}

TEST_CASE("a mesh outlives the field and ends with its last owner") {
  RuntimeOwner runtime = makeRuntime();
  GrammarOwner grammar = compile(runtime.get(), kBall);
  FieldOwner field = makeField(runtime.get(), grammar.get());
  std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 0)});
  const uint64_t hash = viewOf(meshes[0]).hash;
  sgm_mesh_acquire(meshes[0].get());
  sgm_mesh* kept = meshes[0].get();
  meshes.clear();
  field.reset();
  grammar.reset();
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  REQUIRE(sgm_mesh_get_view(kept, &view, nullptr) == SGM_OK);
  CHECK(view.hash == hash);
  sgm_mesh_release(kept);
}

TEST_CASE("hashes do not depend on threads, on batches or on their order", "[threads]") {
  std::vector<sgm_chunk_request> requests;
  for (int32_t z = -1; z <= 1; ++z)
    for (int32_t x = -1; x <= 1; ++x) requests.push_back(chunkAt({0, x, 0, z}, 63));
  std::map<std::tuple<int32_t, int32_t>, uint64_t> expected;
  for (const uint32_t threads : {1u, 2u, 5u}) {
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.threads = threads;
    RuntimeOwner runtime = makeRuntime(&desc);
    const GrammarOwner grammar = compile(runtime.get(), kBlobs);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 512);
    const std::vector<MeshOwner> meshes = meshChunks(field.get(), requests);
    for (const MeshOwner& mesh : meshes) {
      const sgm_mesh_view view = viewOf(mesh);
      const auto [at, fresh] = expected.emplace(std::tuple(view.key.x, view.key.z), view.hash);
      CHECK(at->second == view.hash);
    }
    std::reverse(requests.begin(), requests.end());
    const FieldOwner cold = makeField(runtime.get(), grammar.get(), 512);
    for (const sgm_chunk_request& request : requests)
      CHECK(viewOf(meshChunks(cold.get(), {request})[0]).hash == expected[{request.key.x, request.key.z}]);
  }
  std::set<uint64_t> different;
  for (const auto& [key, hash] : expected) different.insert(hash);
  CHECK(different.size() == expected.size());
}

TEST_CASE("requests a stride apart, and blocks around that are coarser") {
  struct Wide {
    sgm_chunk_request request;
    uint64_t mine;
  };
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBlobs);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 512);
  std::vector<Wide> wide;
  for (int32_t x = -1; x <= 1; ++x) wide.push_back({chunkAt({0, x, 0, 0}, 63), ~0ull});
  wide[1].request.coarser = 0x7FFFFFF & ~(1u << 13);
  sgm_chunks_desc desc = SGM_CHUNKS_DESC_INIT;
  desc.requests = &wide[0].request;
  desc.request_stride = sizeof(Wide);
  desc.count = wide.size();
  std::array<sgm_mesh*, 3> meshes{};
  REQUIRE(sgm_mesh_chunks(field.get(), &desc, meshes.data(), nullptr) == SGM_OK);
  for (size_t i = 0; i < meshes.size(); ++i) {
    const MeshOwner mesh(meshes[i]);
    CHECK(viewOf(mesh).hash == viewOf(meshChunks(field.get(), {chunkAt(wide[i].request.key, 63)})[0]).hash);
  }
}

TEST_CASE("samples are what meshes are made of") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  struct Point {
    int32_t at[3];
    int32_t other;
  };
  std::vector<Point> points;
  for (int32_t i = 0; i < 400; ++i) points.push_back({{4096 + 20 * i, 4096 + 3 * i, 4096}, -1});
  std::vector<int32_t> q(points.size());
  std::vector<float> values(points.size()), gradients(3 * points.size());
  std::vector<uint16_t> materials(points.size()), tags(points.size());
  sgm_sample_desc desc = SGM_SAMPLE_DESC_INIT;
  desc.points = points[0].at;
  desc.point_stride = sizeof(Point);
  desc.count = points.size();
  desc.q = q.data();
  desc.values = values.data();
  desc.gradients = gradients.data();
  desc.materials = materials.data();
  desc.tags = tags.data();
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_field_sample(field.get(), &desc, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  for (size_t i = 0; i < points.size(); ++i) {
    std::array<double, 3> d{};
    double length = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      d[axis] = (points[i].at[axis] - 4096) / 1024.0;
      length += d[axis] * d[axis];
    }
    length = std::sqrt(length);
    if (length > 3.4) break;
    CHECK(static_cast<double>(values[i]) == Approx(length - 3).margin(1e-5));
    CHECK(q[i] == static_cast<int32_t>(std::floor(static_cast<double>(values[i]) * 1024 * 4 + 0.5)));
    CHECK(materials[i] == 1);
    CHECK(tags[i] == 1);
    if (i > 0) {
      for (size_t axis = 0; axis < 3; ++axis)
        CHECK(static_cast<double>(gradients[3 * i + axis]) == Approx(d[axis] / length).margin(1e-3));
    }
  }
}

TEST_CASE("anchors: listed in order, in the chunk that holds them, once") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBlobs);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 512);
  const int32_t lo[3] = {-16384 * 2, -16384, -16384}, hi[3] = {16384 * 2 - 1, 16383, 16383};
  size_t count = 0;
  REQUIRE(sgm_field_anchors(field.get(), lo, hi, nullptr, 0, &count, nullptr) == SGM_OK);
  CHECK(count == 16);
  std::vector<sgm_anchor> anchors(count);
  REQUIRE(sgm_field_anchors(field.get(), lo, hi, anchors.data(), 0, &count, nullptr) == SGM_OK);
  std::set<uint64_t> keys;
  for (const sgm_anchor& anchor : anchors) {
    CHECK(keys.insert(anchor.key).second);
    CHECK(std::string(sgm_grammar_name(grammar.get(), anchor.kind)) == "spawn");
    CHECK(std::string(sgm_grammar_name(grammar.get(), anchor.name)) == "middle");
  }
  size_t few = 3;
  CHECK(sgm_field_anchors(field.get(), lo, hi, anchors.data(), 0, &few, nullptr) == SGM_INCOMPLETE);
  CHECK(few == 16);
  struct Wide {
    sgm_anchor anchor;
    uint64_t mine;
  };
  std::vector<Wide> wide(count, Wide{{}, 77});
  REQUIRE(sgm_field_anchors(field.get(), lo, hi, &wide[0].anchor, sizeof(Wide), &count, nullptr) == SGM_OK);
  for (size_t i = 0; i < count; ++i) {
    CHECK(wide[i].anchor.key == anchors[i].key);
    CHECK(wide[i].mine == 77);
  }
  // A box that overlaps too many cells is refused with a message of its own.
  const int32_t from[3] = {INT32_MIN, INT32_MIN, INT32_MIN}, to[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_field_anchors(field.get(), from, to, nullptr, 0, &count, &error) == SGM_ERR_LIMIT);
  CHECK(std::string(error.message).find("reach into the box") != std::string::npos);

  std::set<uint64_t> in_chunks;
  std::vector<sgm_chunk_request> requests;
  for (int32_t z = -1; z < 1; ++z)
    for (int32_t y = -1; y < 1; ++y)
      for (int32_t x = -2; x < 2; ++x) requests.push_back(chunkAt({0, x, y, z}));
  for (const MeshOwner& mesh : meshChunks(field.get(), requests)) {
    const sgm_mesh_view view = viewOf(mesh);
    uint32_t batched = 0;
    for (uint32_t b = 0; b < view.batch_count; ++b) {
      const sgm_instance_batch& batch = view.batches[b];
      CHECK(batch.first == batched);
      REQUIRE(batch.first + batch.count <= view.anchor_count);
      batched += batch.count;
      for (uint32_t i = batch.first; i < batched; ++i) {
        CHECK((view.anchors[i].kind == batch.kind && view.anchors[i].name == batch.name));
        const float* t = view.transforms + 12 * size_t{i};
        for (size_t row = 0; row < 3; ++row) {
          for (size_t column = 0; column < 3; ++column) {
            CHECK(t[row * 4 + column] == view.anchors[i].rotation[column * 3 + row]);
          }
          CHECK(view.origin[row] + static_cast<double>(t[row * 4 + 3]) * SGM_UNITS_PER_METRE ==
                view.anchors[i].position[row]);
        }
      }
    }
    CHECK(batched == view.anchor_count);
    for (uint32_t i = 0; i < view.anchor_count; ++i) {
      CHECK(in_chunks.insert(view.anchors[i].key).second);
      for (size_t axis = 0; axis < 3; ++axis) {
        CHECK(view.anchors[i].position[axis] >= view.origin[axis]);
        CHECK(view.anchors[i].position[axis] < view.origin[axis] + 32 * view.cell_units);
      }
    }
  }
  CHECK(in_chunks == keys);
}

TEST_CASE("parameters and seed reach the mesh") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  sgm_parameters* parameters = nullptr;
  REQUIRE(sgm_parameters_create(grammar.get(), &parameters, nullptr) == SGM_OK);
  const ParametersOwner owner(parameters);
  REQUIRE(sgm_parameters_set(parameters, "radius", 1.5, nullptr) == SGM_OK);
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar.get();
  desc.parameters = parameters;
  desc.cell_units = 256;
  sgm_field* field = nullptr;
  REQUIRE(sgm_field_create(runtime.get(), &desc, &field, nullptr) == SGM_OK);
  const FieldOwner field_owner(field);
  // The field has its own copy of the parameters.
  REQUIRE(sgm_parameters_set(parameters, "radius", 3.5, nullptr) == SGM_OK);
  const std::vector<MeshOwner> meshes = meshChunks(field, {chunkAt({0, 0, 0, 0}, 0)});
  const sgm_mesh_view view = viewOf(meshes[0]);
  CHECK(view.bounds_max[0] - view.bounds_min[0] == Approx(3 * 1024).margin(20));

  const GrammarOwner blobs = compile(runtime.get(), kBlobs);
  std::set<uint64_t> hashes;
  for (const uint64_t seed : {0ull, 1ull, ~0ull}) {
    desc = SGM_FIELD_DESC_INIT;
    desc.grammar = blobs.get();
    desc.seed = seed;
    REQUIRE(sgm_field_create(runtime.get(), &desc, &field, nullptr) == SGM_OK);
    const FieldOwner seeded(field);
    hashes.insert(viewOf(meshChunks(field, {chunkAt({0, 0, 0, 0}, 0)})[0]).hash);
  }
  CHECK(hashes.size() == 3);
}
