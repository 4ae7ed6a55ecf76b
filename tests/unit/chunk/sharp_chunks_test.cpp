// Tests sharp features in chunks: surfaces are closed for any octree, edges are crisp, and the result does not depend
// on how a chunk was made.

#include <algorithm>
#include <cmath>
#include <random>

#include "backend/open/open_backend.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex_keys.h"
#include "rounds.h"
#include "stream/random_tree.h"
#include "stream/streaming_support.h"
#include "world/edits_support.h"

using namespace sgm;

namespace {

/// Rotated boxes. Coarse levels omit some of them, and the world's border cuts one of them.
const char* const kBoxes =
    "sgm 1; units m; domain finite box(160m, 160m, 160m) empty; start Heap;\n"
    "rule Heap {\n"
    "  at(4m, -3m, 5m) rot(y, 25deg) rot(x, 35deg) box(34m, 21m, 27m);\n"
    "  at(60m, 40m, 30m) rot(z, 20deg) box(60m, 14m, 25m);\n"
    "  at(-30m, 5m, -20m) rot(y, 45deg) rot(z, 30deg) { box(24m, 30m, 16m); cut { rot(x, 15deg) box(9m, 40m, 9m); } }\n"
    "  repeat 9 at(3m, 4m, 2m) detail 1m { at(0m, 0m, -35m) rot(y, 30deg) box(1.2m, 2m, 0.7m); }\n"
    "  at(0m, -48m, 0m) box(64m, 16m, 64m);\n"
    "}\n";
constexpr int kTop = 3;
constexpr int32_t kFinest = 256;

Octree randomTree(std::mt19937& random) { return sgm::randomTree(random, kTop, kFinest, 6, 49152); }

std::vector<ChunkRequest> sharpRequests(const Octree& tree) {
  std::vector<ChunkRequest> requests = frameRequests(tree);
  for (ChunkRequest& request : requests) request.sharp = true;
  return requests;
}

std::vector<const MeshPart*> partsOf(const std::pmr::vector<PlacedChunk>& chunks) {
  std::vector<PlacedPart> placed;
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, placed);
  std::vector<const MeshPart*> parts;
  for (const PlacedPart& part : placed) parts.push_back(part.mesh);
  return parts;
}

size_t featuresIn(const MeshPart& part) {
  return static_cast<size_t>(
      std::count_if(part.vertices.begin(), part.vertices.end(), [](const Vertex& v) { return isFeature(v.kind); }));
}

}  // namespace

TEST_CASE("random octrees of boxes and buildings are closed with sharp features, seams and outer faces included") {
  struct Scene {
    std::string text;
    int32_t cell;
  };
  const Scene scenes[] = {{kBoxes, kFinest}, {sample("building.sgm"), kFinest}, {sample("table4/muller.sgm"), kFinest}};
  for (const Scene& scene : scenes) {
    CAPTURE(scene.text.substr(0, 200));
    const WorldField world(settingsOf(scene.text, scene.cell, 3), std::pmr::get_default_resource());
    size_t in_bodies = 0, in_seams = 0, of_coarser = 0;
    for (uint32_t seed = 1; seed <= std::max(rounds(4), 4u); ++seed) {
      CAPTURE(seed);
      std::mt19937 random(seed);
      const std::pmr::vector<PlacedChunk> chunks = meshAll(world, sharpRequests(randomTree(random)), 2);
      const MeshReport report = checkParts(partsOf(chunks));
      INFO(describe(report));
      CHECK(report.closed());
      for (const PlacedChunk& chunk : chunks) {
        in_bodies += featuresIn(chunk.mesh.body);
        for (const MeshPart& seam : chunk.mesh.seams) {
          in_seams += featuresIn(seam);
          of_coarser +=
              static_cast<size_t>(std::count_if(seam.vertices.begin(), seam.vertices.end(), [](const Vertex& v) {
                return isFeature(v.kind) && isOfCoarserLevel(v.kind);
              }));
        }
      }
    }
    CHECK(in_bodies > 1000);
    CHECK(in_seams > 20);
    CHECK(of_coarser > 5);
  }
}

TEST_CASE("seams have the features of both levels that they join, to the bit") {
  const WorldField world(settingsOf(kBoxes, kFinest, 3), std::pmr::get_default_resource());
  size_t shared = 0;
  for (uint32_t seed = 1; seed <= std::max(rounds(3), 3u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const std::vector<ChunkRequest> requests = sharpRequests(randomTree(random));
    const std::pmr::vector<PlacedChunk> chunks = meshAll(world, requests, 2);
    struct Place {
      std::array<int64_t, 3> at;  // 1/256 unit
      bool seam;
    };
    std::map<VertexKey, Place> places;
    size_t apart = 0, wrong_keys = 0;
    for (size_t i = 0; i < chunks.size(); ++i) {
      const PlacedChunk& chunk = chunks[i];
      const auto take = [&](const MeshPart& part, int number) {
        for (size_t v = 0; v < part.vertices.size(); ++v) {
          if (!isFeature(part.vertices[v].kind)) continue;
          const Vertex& vertex = part.vertices[v];
          const std::array<int16_t, 3> local{vertex.x, vertex.y, vertex.z};
          Place place{{}, number > 0};
          for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<size_t>(axis);
            place.at[a] = int64_t{chunk.grid.origin[axis]} * kSubcell + int64_t{local[a]} * chunk.grid.cell;
          }
          const auto [known, is_new] = places.emplace(part.keys[v], place);
          apart += known->second.at != place.at;
          shared += !is_new && known->second.seam != place.seam;
        }
        MeshPart again = part;
        deriveKeys(chunk.grid, number, requests[i].coarser | neighboursAcross(requests[i].seams), again);
        wrong_keys += again.keys != part.keys;
      };
      take(chunk.mesh.body, 0);
      for (size_t f = 0; f < chunk.mesh.seams.size(); ++f) take(chunk.mesh.seams[f], 1 + static_cast<int>(f));
    }
    CHECK(apart == 0);
    CHECK(wrong_keys == 0);
  }
  CHECK(shared > 50);
}

TEST_CASE("a sharp chunk is the same with a wider field, in any company, with any number of threads") {
  const WorldField world(settingsOf(kBoxes, kFinest, 3), std::pmr::get_default_resource());
  std::mt19937 random(4);
  const std::vector<ChunkRequest> requests = sharpRequests(randomTree(random));
  const std::pmr::vector<PlacedChunk> together = meshAll(world, requests, 2);
  size_t compared = 0;
  for (size_t i = 0; i < requests.size(); ++i) {
    if (together[i].mesh.body.indices.empty() || ++compared > std::max(rounds(60), 60u)) continue;
    const std::pmr::vector<PlacedChunk> alone = meshAll(world, {requests[i]}, 1);
    CHECK(alone[0].mesh.body.hash == together[i].mesh.body.hash);
    for (size_t f = 0; f < alone[0].mesh.seams.size(); ++f)
      CHECK(alone[0].mesh.seams[f].hash == together[i].mesh.seams[f].hash);
  }
  CHECK(compared > 20);
}

TEST_CASE("edges of turned boxes are straight in streamed chunks of every level") {
  // A randomly rotated box, which is large enough to be visible at every level.
  for (uint32_t seed = 1; seed <= std::max(rounds(3), 3u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto angle = [&] { return std::to_string(random() % 90) + "deg"; };
    const std::string text =
        "sgm 1; units m; domain finite box(160m, 160m, 160m) empty; start B; rule B { at(1m, 2m, 3m) rot(y, " +
        angle() + ") rot(x, " + angle() + ") rot(z, " + angle() + ") box(40m, 30m, 36m); }";
    const WorldField world(settingsOf(text, kFinest, 3), std::pmr::get_default_resource());
    const std::pmr::vector<PlacedChunk> chunks = meshAll(world, sharpRequests(randomTree(random)), 2);
    CHECK(checkParts(partsOf(chunks)).closed());
    // The eight corners are the points farthest from the middle: each must have a vertex within a twentieth of a cell.
    const double reach = std::sqrt(20.0 * 20 + 15.0 * 15 + 18.0 * 18) * kUnitsPerMetre;
    std::vector<Int3> corners;
    double farthest = 0;
    for (const PlacedChunk& chunk : chunks) {
      const double most = 0.05 * chunk.grid.cell;
      for (size_t v = 0; v < chunk.mesh.body.vertices.size(); ++v) {
        const Int3 p = vertexUnits(chunk.grid, chunk.mesh.body.vertices[v]);
        const double x = p.x - 1024.0, y = p.y - 2048.0, z = p.z - 3072.0, away = std::sqrt(x * x + y * y + z * z);
        farthest = std::max(farthest, (away - reach) / chunk.grid.cell);
        const auto isNear = [&](const Int3& corner) {
          return std::max({std::abs(corner.x - p.x), std::abs(corner.y - p.y), std::abs(corner.z - p.z)}) < 4096;
        };
        if (away > reach - most && std::none_of(corners.begin(), corners.end(), isNear)) corners.push_back(p);
      }
    }
    CHECK(farthest <= 0.05);
    CHECK(corners.size() == 8);
  }
}

TEST_CASE("every frame of a sharp world is the closed frame of its octree, dug or not") {
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    WorldSettings settings;
    settings.sharp = true;
    settings.by_reach = false;
    Scene scene(std::make_unique<LateJobs>(seed), kBoxes, settings);
    Engine engine;
    Viewer viewer = viewerAt(0, 20, 0);
    size_t digs = 0;
    for (int turn = 0; turn < 20; ++turn) {
      viewer = wander(random, viewer);
      for (double& at : viewer.position) at = std::clamp(at, -60.0 * kUnitsPerMetre, 60.0 * kUnitsPerMetre);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      if (turn % 5 == 4) {
        const IntBox near = IntBox{{-20000, -20000, -20000}, {20000, 20000, 20000}};
        Brush brush = randomBrush(random, near, 4096);
        brush.material = brush.tag = 0;
        REQUIRE(scene.world->edit(brush));
        ++digs;
      }
      for (int update = 0; update < 6; ++update) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        engine.take(*scene.world);
        for (auto jobs = random() % 60; jobs > 0 && scene.jobs->help(); --jobs) {
        }
      }
    }
    comeToRest(scene, engine);
    EditLog log{EditSettings{}};
    REQUIRE(log.import(scene.world->exportEdits()));
    checkFrame(scene, engine, log.snapshot().get());
    CHECK(digs > 0);
    size_t features = 0;
    for (const auto& [key, shown] : engine.shown)
      for (const Vertex& v : shown.surface->mesh.vertices) features += isFeature(v.kind);
    CHECK(features > 100);
  }
}

TEST_CASE("a sharp world has the hash of its chunks, whatever was streamed before") {
  WorldSettings settings;
  settings.sharp = true;
  settings.by_reach = false;
  Scene scene(std::make_unique<LateJobs>(1), kBoxes, settings);
  const IntBox region{{-30000, -30000, -30000}, {30000, 30000, 30000}};
  const Result<ContentHash> before = scene.world->hashBodies(region, 0);
  REQUIRE(before);
  const Viewer viewer = viewerAt(0, 0, 0);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  const Result<ContentHash> after = scene.world->hashBodies(region, 0);
  REQUIRE(after);
  CHECK(*before == *after);
  const auto keys = chunksOfRegion(scene.field, region, 0, 4096);
  REQUIRE(keys);
  std::vector<ChunkRequest> requests;
  for (const ChunkKey& key : *keys) requests.push_back({key, 0, Neighbourhood{}}), requests.back().sharp = true;
  std::vector<PlacedPart> parts;
  const std::pmr::vector<PlacedChunk> chunks = meshAll(scene.field, requests, 2);
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, parts);
  CHECK(*before == hashParts(parts));
}

TEST_CASE("progress counts sharp chunks when all is done to them, and stops them") {
  const WorldField world(settingsOf(kBoxes, kFinest, 3), std::pmr::get_default_resource());
  std::mt19937 random(2);
  const std::vector<ChunkRequest> requests = sharpRequests(randomTree(random));
  const auto jobs = *makeThreadPool(2);
  const auto backend = *makeBackend({}, *jobs, world.memory());
  uint64_t calls = 0;
  const auto stopAt = [&](uint64_t last) {
    calls = 0;
    return meshChunks(world, *backend, *jobs, requests, [&](uint64_t done, uint64_t total) {
      CHECK(done == ++calls);
      CHECK(total == requests.size());
      return done < last;
    });
  };
  CHECK(stopAt(requests.size() + 1));
  CHECK(calls == requests.size());
  const auto stopped = stopAt(3);
  REQUIRE(!stopped);
  CHECK(stopped.error().code == Code::cancelled);
  CHECK(calls == 3);
}
