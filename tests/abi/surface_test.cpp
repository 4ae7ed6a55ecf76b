// Tests surfaces of regions: welded chunks, on request with texture coordinates and sharp features.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "mesh_places.h"

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
  const SurfaceOwner surface = surfaceOf(field.get(), desc);
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
  sgm_surface* made = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_surface_from_region(field.get(), &desc, &made, &error) == SGM_ERR_CANCELLED);
  CHECK(made == nullptr);
  // Cancelling in the last progress call has no effect, since the work is complete.
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
    const SurfaceOwner surface = surfaceOf(field.get(), desc);
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

TEST_CASE("regions and chunks have sharp features where they are asked for") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar =
      compile(runtime.get(),
              "sgm 1; units m; start Box; rule Box { at(4m, 4m, 4m) rot(y, 30deg) rot(x, 20deg) box(4m, 4m, 4m); }");
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  // Returns the distance from the box's middle to the farthest vertex, which lies at a corner of the box.
  const auto farthest = [&](uint32_t flags) {
    sgm_region_desc desc = SGM_REGION_DESC_INIT;
    for (int axis = 0; axis < 3; ++axis) desc.maximum[axis] = 8 * SGM_UNITS_PER_METRE;
    desc.flags = flags;
    const SurfaceOwner surface = surfaceOf(field.get(), desc);
    const sgm_surface_view view = viewOf(surface);
    double most = 0;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      double square = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double from_middle = static_cast<double>(view.positions[3 * v + axis]) - 4;
        square += from_middle * from_middle;
      }
      most = std::max(most, square);
    }
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
