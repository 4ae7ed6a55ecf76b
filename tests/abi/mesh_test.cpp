#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "fixture.h"

namespace {

using Place = std::array<int64_t, 3>;

/// A vertex's position in 1/256 units of the world, which is exact.
Place placeOf(const sgm_mesh_view& view, uint32_t index) {
  const sgm_vertex& v = view.vertices[index];
  const std::array<int16_t, 3> p{v.x, v.y, v.z};
  Place place{};
  for (size_t axis = 0; axis < 3; ++axis)
    place[axis] = int64_t{view.origin[axis]} * 256 + int64_t{p[axis]} * view.cell_units;
  return place;
}

constexpr const char* kBlobs =
    "sgm 1; units m;\n"
    "domain infinite;\n"
    "layer main cell 16m reach 9m { start Blob; }\n"
    "rule Blob { at(cell.point(jitter 0.5)) { displace 0.4m*fractal(2m) amp 0.4m { sphere(rand(3m, 7m)); } } "
    "anchor spawn \"middle\"; }\n";

}  // namespace

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

  // Vertices are written into larger elements, whose other bytes stay unchanged.
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

TEST_CASE("a region is its chunks, welded: each border vertex once, open only at its outer faces") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBlobs);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 512);
  sgm_region_desc desc = SGM_REGION_DESC_INIT;
  for (int axis = 0; axis < 3; ++axis) {
    desc.minimum[axis] = -100;
    desc.maximum[axis] = 100;
  }
  struct Progress {
    uint64_t calls = 0, last = 0, total = 0;
    bool rising = true;
  } progress;
  desc.progress_user = &progress;
  desc.progress = [](void* user, uint64_t done, uint64_t total) -> int32_t {
    auto& p = *static_cast<Progress*>(user);
    p.rising = p.rising && done == p.last + 1 && done <= total;
    p.last = done;
    p.total = total;
    ++p.calls;
    return 0;
  };
  sgm_surface* made = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_surface_from_region(field.get(), &desc, &made, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  const SurfaceOwner surface(made);
  const sgm_surface_view view = viewOf(surface);
  CHECK(progress.calls == 8);
  CHECK(progress.rising);
  CHECK(progress.last == progress.total);
  CHECK(view.chunk_count == 8);
  CHECK(view.cell_units == 512);
  CHECK(view.extent_min[0] == -16384);
  CHECK(view.extent_max[2] == 16384);

  uint64_t triangles = 0;
  std::set<Place> places;
  std::vector<sgm_chunk_request> requests;
  for (int32_t i = 0; i < 8; ++i) requests.push_back(chunkAt({0, (i & 1) - 1, (i >> 1 & 1) - 1, (i >> 2) - 1}));
  const std::vector<MeshOwner> meshes = meshChunks(field.get(), requests);
  for (const MeshOwner& mesh : meshes) {
    const sgm_mesh_view chunk = viewOf(mesh);
    triangles += chunk.index_count / 3;
    for (uint32_t v = 0; v < chunk.vertex_count; ++v) places.insert(placeOf(chunk, v));
  }
  REQUIRE(triangles > 500);
  CHECK(view.index_count / 3 == triangles);
  CHECK(view.vertex_count == places.size());

  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (uint64_t i = 0; i < view.index_count; ++i) {
    const uint32_t a = view.indices[i], b = view.indices[i % 3 == 2 ? i - 2 : i + 1];
    edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
  }
  const auto onBorder = [&](uint32_t v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double metres = static_cast<double>(view.positions[3 * size_t{v} + axis]) + view.origin[axis] / 1024.0;
      if (metres == view.extent_min[axis] / 1024.0 || metres == view.extent_max[axis] / 1024.0) return true;
    }
    return false;
  };
  for (const auto& [edge, balance] : edges)
    if (balance != 0) CHECK((onBorder(edge.first) && onBorder(edge.second)));

  desc.progress = [](void*, uint64_t, uint64_t) -> int32_t { return 1; };
  CHECK(sgm_surface_from_region(field.get(), &desc, &made, &error) == SGM_ERR_CANCELLED);
  CHECK(made == nullptr);
  // Stopping in the last progress call has no effect, since the work is done.
  desc.progress = [](void*, uint64_t done, uint64_t total) -> int32_t { return done == total ? 1 : 0; };
  CHECK(sgm_surface_from_region(field.get(), &desc, &made, &error) == SGM_OK);
  sgm_surface_destroy(made);
}

TEST_CASE("chunks and regions have texture coordinates where they are asked for, and the same blends") {
  const RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(),
                                       "sgm 1; units m; domain infinite;\n"
                                       "layer main cell 24m reach 9m { start Blob; }\n"
                                       "rule Blob { at(12m, 12m, 12m) { Low; at(0m, 2m, 0m) High; } }\n"
                                       "rule Low { box(8m, 8m, 8m); mat chalk; }\n"
                                       "rule High { sphere(5m); mat flint; }\n");
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 512);
  const std::vector<sgm_chunk_request> requests{chunkAt({0, 0, 0, 0}, 63), chunkAt({1, 0, 0, 0}),
                                                chunkAt({0, 1, 0, 0})};
  for (const MeshOwner& mesh : meshChunks(field.get(), requests)) CHECK(viewOf(mesh).wedges == nullptr);
  size_t seam_vertices = 0;
  using Blend = std::tuple<uint16_t, uint16_t, uint8_t>;
  std::map<Place, std::set<Blend>> of_chunk;
  for (const MeshOwner& mesh : meshChunks(field.get(), requests, SGM_MESHING_TEXTURE)) {
    const sgm_mesh_view view = viewOf(mesh);
    REQUIRE(view.index_count > 100);
    checkWedges(view);
    seam_vertices += view.vertex_count - view.body.vertex_count;
    if (view.key.level != 0 || view.key.x != 0) continue;
    for (uint32_t i = 0; i < view.wedge_count; ++i) {
      const sgm_wedge& wedge = view.wedges[i];
      if (view.vertices[wedge.vertex].kind != SGM_VERTEX_OWN) continue;
      of_chunk[placeOf(view, wedge.vertex)].emplace(wedge.materials[0], wedge.materials[1], wedge.share);
    }
  }
  CHECK(seam_vertices > 0);
  sgm_region_desc desc = SGM_REGION_DESC_INIT;
  for (int32_t& v : desc.maximum) v = 16384;
  for (const uint32_t flags : {0u, uint32_t{SGM_MESHING_TEXTURE}}) {
    desc.flags = flags;
    sgm_surface* made = nullptr;
    REQUIRE(sgm_surface_from_region(field.get(), &desc, &made, nullptr) == SGM_OK);
    const SurfaceOwner surface(made);
    const sgm_surface_view view = viewOf(surface);
    if (flags == 0) {
      CHECK((view.wedges == nullptr && view.wedge_indices == nullptr && view.wedge_count == 0));
      continue;
    }
    checkWedges(view);
    size_t same = 0, blended = 0;
    for (uint64_t i = 0; i < view.wedge_count; ++i) {
      const sgm_wedge& wedge = view.wedges[i];
      Place place{};
      for (size_t axis = 0; axis < 3; ++axis) {
        const double units = static_cast<double>(view.positions[3 * size_t{wedge.vertex} + axis]) * 1024;
        place[axis] = std::llround(units * 256);
      }
      const auto found = of_chunk.find(place);
      REQUIRE(found != of_chunk.end());
      same += found->second.count({wedge.materials[0], wedge.materials[1], wedge.share});
      blended += wedge.materials[0] != wedge.materials[1] && wedge.share > 0 && wedge.share < 255;
    }
    CHECK(same == view.wedge_count);
    CHECK(blended > 20);
  }
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
  // A box that overlaps too many cells is refused with its own message.
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

TEST_CASE("regions and chunks have sharp features where they are asked for") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar =
      compile(runtime.get(),
              "sgm 1; units m; start Box; rule Box { at(4m, 4m, 4m) rot(y, 30deg) rot(x, 20deg) box(4m, 4m, 4m); }");
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  // The distance of the farthest vertex from the middle: that of a corner of the box.
  const auto farthest = [&](uint32_t flags) {
    sgm_region_desc desc = SGM_REGION_DESC_INIT;
    for (int axis = 0; axis < 3; ++axis) desc.maximum[axis] = 8 * SGM_UNITS_PER_METRE;
    desc.flags = flags;
    sgm_surface* made = nullptr;
    REQUIRE(sgm_surface_from_region(field.get(), &desc, &made, nullptr) == SGM_OK);
    sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
    REQUIRE(sgm_surface_get_view(made, &view, nullptr) == SGM_OK);
    double most = 0;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      double square = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double from_middle = static_cast<double>(view.positions[3 * v + axis]) - 4;
        square += from_middle * from_middle;
      }
      most = std::max(most, square);
    }
    sgm_surface_destroy(made);
    return std::sqrt(most);
  };
  CHECK(farthest(0) < std::sqrt(12.0) - 0.01);
  CHECK(farthest(SGM_MESHING_SHARP) == Approx(std::sqrt(12.0)).margin(0.002));
  CHECK(farthest(SGM_MESHING_SHARP | SGM_MESHING_TEXTURE) == farthest(SGM_MESHING_SHARP));

  const auto featuresOf = [&](uint32_t flags, double& most) {
    size_t features = 0;
    for (const MeshOwner& mesh : meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 63)}, flags)) {
      const sgm_mesh_view view = viewOf(mesh);
      for (uint32_t v = 0; v < view.vertex_count; ++v) {
        const sgm_vertex& vertex = view.vertices[v];
        features += (vertex.kind & SGM_VERTEX_FEATURE) != 0;
        double square = 0;
        for (const int16_t at : {vertex.x, vertex.y, vertex.z}) {
          const double from_middle = static_cast<double>(at) * view.cell_units / (256 * 1024) - 4;
          square += from_middle * from_middle;
        }
        most = std::max(most, std::sqrt(square));
      }
    }
    return features;
  };
  double plain = 0, sharp = 0;
  CHECK(featuresOf(0, plain) == 0);
  CHECK(plain < std::sqrt(12.0) - 0.01);
  CHECK(featuresOf(SGM_MESHING_SHARP, sharp) > 100);
  CHECK(sharp == Approx(std::sqrt(12.0)).margin(0.002));
}
