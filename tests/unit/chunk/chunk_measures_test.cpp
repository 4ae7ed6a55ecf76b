// Tests measures of single chunks: chunks of the sample grammars are sound, and their measures add up to those of the
// whole mesh.

#include <algorithm>
#include <cmath>
#include <random>

#include "asset/triangle_mesh.h"
#include "backend/open/open_backend.h"
#include "measure/mesh_measures.h"
#include "measure/world_triangles.h"
#include "measured_chunks.h"
#include "mesh/check.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex.h"
#include "rounds.h"
#include "stream/random_tree.h"
#include "stream/streaming_support.h"

using namespace sgm;
using namespace sgm::measure;

namespace {

/// Rotated boxes in a finite world, so that the whole world can be meshed and its surface is closed.
const char* const kFewBoxes =
    "sgm 1; units m; domain finite box(96m, 96m, 96m) empty; start Heap;\n"
    "rule Heap {\n"
    "  at(4m, -3m, 5m) rot(y, 25deg) rot(x, 35deg) box(34m, 21m, 27m);\n"
    "  at(-20m, 5m, -16m) rot(y, 45deg) rot(z, 30deg) { box(24m, 30m, 16m); cut { rot(x, 15deg) box(9m, 40m, 9m); } }\n"
    "  at(22m, 18m, -20m) sphere(11m);\n"
    "}\n";

void checkSamples(bool sharp) {
  for (const Excerpt& scene : kExcerpts) {
    if (scene.sharp != sharp) continue;
    CAPTURE(scene.grammar);
    const WorldField world(settingsOf(yardstick(scene.grammar), scene.cell, 3), std::pmr::get_default_resource());
    size_t bodies = 0, seams = 0, compared = 0, features = 0;
    std::mt19937 random(5);
    std::vector<ChunkRequest> requests;
    for (unsigned i = 0; i < std::max(rounds(60), 30u); ++i) requests.push_back(randomRequest(random, scene));
    for (const PlacedChunk& chunk : meshAll(world, requests, 2)) {
      CAPTURE(chunk.key.level, chunk.key.at.x, chunk.key.at.y, chunk.key.at.z);
      const ChunkMeasures measures = measured(chunk);
      INFO(described(measures));
      SurfaceSums sums;
      sums.add(measures, chunk.grid, true, 63);
      CHECK(sums.sound());
      const MeshPart* const body = &chunk.mesh.body;
      const MeshReport report = checkParts({&body, 1});
      const BodyTopology& topology = measures.topology;
      CHECK(topology.triangles == report.triangles);
      CHECK(topology.vertices == report.vertices);
      CHECK(topology.edges == report.edges);
      CHECK(sums.border_edges == report.open_edges);
      bodies += report.triangles > 0;
      compared += topology.compared;
      features += static_cast<size_t>(std::count_if(body->vertices.begin(), body->vertices.end(),
                                                    [](const Vertex& v) { return isFeature(v.kind); }));
      seams += sums.seams;
    }
    CHECK(bodies > 2);
    CHECK(seams > 0);
    CHECK(compared > 0);
    CHECK((features > 0) == scene.sharp);
  }
}

}  // namespace

TEST_CASE("chunks of the samples have no defect, and count as checkParts does") { checkSamples(false); }

TEST_CASE("sharp chunks of the samples have no defect, and count as checkParts does") { checkSamples(true); }

TEST_CASE("chunks and seams of mixed levels add up to the area and the volume of the welded surface") {
  const WorldField world(settingsOf(kFewBoxes, 512, 3), std::pmr::get_default_resource());
  const auto jobs = *makeThreadPool(2);
  for (uint32_t seed = 1; seed <= std::max(rounds(6), 2u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<ChunkRequest> requests = frameRequests(randomTree(random, 2, 512, 5, 32768));
    for (ChunkRequest& request : requests) request.sharp = seed % 2 == 0;
    const std::pmr::vector<PlacedChunk> chunks = meshAll(world, requests, 2);
    SurfaceSums sums;
    std::array<int64_t, 3> cross{};
    std::vector<PlacedPart> parts;
    for (const PlacedChunk& chunk : chunks) {
      const ChunkMeasures measures = measured(chunk);
      INFO(described(measures));
      sums.add(measures, chunk.grid, true, 63);
      appendParts(chunk, parts);
      for (const PartMeasures& part : measures.parts) {
        for (size_t axis = 0; axis < 3; ++axis) cross[axis] += part.cross[axis] << 2 * chunk.grid.level;
      }
    }
    CHECK(sums.sound());
    CHECK(sums.seams > 0);
    // The sum is exactly 0, because integers cancel without rounding.
    CHECK(cross == std::array<int64_t, 3>{});
    const Result<WorldMesh> welded = weld(parts, {0, 0, 0});
    REQUIRE(welded);
    const asset::TriangleMesh triangles = trianglesOf(*welded);
    const AreaVolume whole = areaVolume({triangles.points, triangles.triangles}, *jobs);
    REQUIRE(whole.area > 1000);
    REQUIRE(whole.volume > 1000);
    CHECK(sums.triangles == triangles.triangles.size());
    CHECK(std::fabs(sums.area - whole.area) < 1e-9 * whole.area);
    CHECK(std::fabs(sums.flux - whole.volume) < 1e-9 * whole.volume);
    for (const double component : sums.area_vector) CHECK(std::fabs(component) < 1e-12 * whole.area);
  }
}

TEST_CASE("open chunks have the area and the flux of their triangles") {
  const auto jobs = *makeThreadPool(1);
  std::mt19937 random(17);
  for (unsigned round = 0; round < rounds(20); ++round) {
    const PlacedChunk chunk = anyChunk(random);
    SurfaceSums sums;
    sums.add(measured(chunk), chunk.grid, true, 0);
    std::vector<PlacedPart> parts;
    appendParts(chunk, parts);
    const Result<WorldMesh> welded = weld(parts, {0, 0, 0});
    REQUIRE(welded);
    const asset::TriangleMesh triangles = trianglesOf(*welded);
    const AreaVolume whole = areaVolume({triangles.points, triangles.triangles}, *jobs);
    CHECK(std::fabs(sums.area - whole.area) < 1e-9 * whole.area);
    // The origin is some 100 m away, so the summed terms are far larger than their sum.
    CHECK(std::fabs(sums.flux - whole.volumeAbout({0, 0, 0})) < 1e-9 * 300 * whole.area);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::fabs(sums.area_vector[static_cast<size_t>(axis)] - whole.area_vector[axis]) < 1e-9 * whole.area);
    }
  }
}

TEST_CASE("measures are the same whoever has meshed the chunk") {
  const Excerpt& scene = kExcerpts[0];
  const WorldField world(settingsOf(yardstick(scene.grammar), scene.cell, 3), std::pmr::get_default_resource());
  std::mt19937 random(23);
  std::vector<ChunkRequest> requests;
  for (unsigned i = 0; i < std::max(rounds(30), 10u); ++i) requests.push_back(randomRequest(random, scene));
  std::vector<ChunkMeasures> first;
  size_t triangles = 0;
  BackendRequest scalar;
  scalar.instruction_set = "scalar";
  const std::pair<BackendRequest, unsigned> makers[] = {{scalar, 1}, {BackendRequest{}, 3}, {testedBackend(), 2}};
  for (const auto& [request, threads] : makers) {
    const auto jobs = *makeThreadPool(threads);
    const Result<std::unique_ptr<Backend>> backend = makeBackend(request, *jobs, world.memory());
    REQUIRE(backend);
    const Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, **backend, *jobs, requests);
    REQUIRE(chunks);
    std::vector<ChunkMeasures> all;
    for (const PlacedChunk& chunk : *chunks) all.push_back(measured(chunk));
    if (first.empty()) first = all;
    CHECK(all == first);
    for (const ChunkMeasures& one : all) triangles += one.parts[0].triangles;
  }
  CHECK(triangles > 3000);
}

TEST_CASE("roots are rounded to the nearest, and normals unfold as they are unpacked") {
  std::mt19937_64 random(7);
  for (unsigned i = 0; i < rounds(200000); ++i) {
    const auto x = static_cast<int64_t>(random() >> (2 + random() % 62));
    const int64_t root = roundedRoot(x);
    // (root - 1/2)^2 < x < (root + 1/2)^2
    CHECK((root == 0 || x > root * root - root));
    CHECK(x <= root * root + root);
    const auto px = static_cast<int16_t>(random() % 65535 - 32767), py = static_cast<int16_t>(random() % 65535 - 32767);
    const PackedDirection d = unfoldNormal(px, py);
    const std::array<double, 3> n = unpackNormal(px, py);
    const double length = std::hypot(d.x, d.y, d.z);
    CHECK(std::fabs(d.x / length - n[0]) + std::fabs(d.y / length - n[1]) + std::fabs(d.z / length - n[2]) < 1e-12);
  }
}
