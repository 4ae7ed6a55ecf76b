// Tests that the world does not depend on how it is visited: order, threads, reach, place, cache.

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iostream>
#include <random>
#include <stdexcept>

#include "backend/open/open_backend.h"
#include "catch.h"
#include "chunk/mesh_chunks.h"
#include "mesh/check.h"
#include "mesh/weld.h"
#include "world/layers_below.h"
#include "world_support.h"

using namespace sgm;

namespace {

std::vector<ChunkRequest> requestsOf(const WorldField& world, const IntBox& region) {
  Result<std::pmr::vector<ChunkKey>> keys = chunksOfRegion(world, region, 0, 100'000);
  REQUIRE(keys);
  std::vector<ChunkRequest> requests;
  for (const ChunkKey& k : *keys) requests.push_back({k, 0, 0});
  return requests;
}

uint64_t hashOf(const std::pmr::vector<PlacedChunk>& chunks) {
  std::vector<PlacedPart> parts;
  for (const PlacedChunk& c : chunks) appendParts(c, parts);
  return hashParts(parts).value();
}

// The first hall of the cave's grammar cell (0, 0, 0) lies somewhere around the middle of the cell.
const IntBox kHall{{64 * 1024, 64 * 1024, 64 * 1024}, {128 * 1024, 128 * 1024, 128 * 1024}};

}  // namespace

TEST_CASE("the world's hash does not depend on visiting order, threads or the cache", "[threads]") {
  for (const char* name : {"cave.sgm", "cloud.sgm"}) {
    const std::string text = yardstick(name);
    const bool cloud = name[1] == 'l';
    const int32_t cell = cloud ? 32 * 1024 : 1024;
    const uint64_t seed = cloud ? 5 : 7;  // with this seed, there are clouds near the origin
    const IntBox region =
        cloud ? IntBox{{-2000 * 1024, 800 * 1024, -2000 * 1024}, {2000 * 1024, 2000 * 1024, 2000 * 1024}} : kHall;
    const WorldField world(settingsOf(text, cell, seed), std::pmr::get_default_resource());
    std::vector<ChunkRequest> requests = requestsOf(world, region);
    const std::pmr::vector<PlacedChunk> chunks = meshAll(world, requests, 1);
    const uint64_t expected = hashOf(chunks);
    size_t triangles = 0;
    for (const PlacedChunk& c : chunks) triangles += c.mesh.body.indices.size() / 3;
    INFO(name << ", " << triangles << " triangles");
    CHECK(triangles > 1000);

    for (unsigned threads : {2u, 3u, 8u}) {
      std::mt19937 random(threads);
      std::shuffle(requests.begin(), requests.end(), random);
      WorldFieldSettings s = settingsOf(text, cell, seed);
      s.cache_bytes = threads == 3 ? 1 : size_t{64} << 20;  // with 3 threads, a cache that holds nothing
      const WorldField fresh(s, std::pmr::get_default_resource());
      CHECK(hashOf(meshAll(fresh, requests, threads)) == expected);
    }
    // Meshes the same chunks again after everything derived was dropped.
    CHECK(hashOf(meshAll(world, requests, 2)) == expected);
    WorldFieldSettings other = settingsOf(text, cell, seed + 1);
    CHECK(hashOf(meshAll(WorldField(other, std::pmr::get_default_resource()), requests, 2)) != expected);
  }
}

TEST_CASE("chunks that need no keys are the same but for these") {
  const WorldField world(settingsOf(yardstick("cave.sgm"), 1024), std::pmr::get_default_resource());
  std::vector<ChunkRequest> requests = requestsOf(world, kHall);
  for (ChunkRequest& request : requests) request.seams = 1u << 2;
  const auto keyed = meshAll(world, requests, 2);
  for (ChunkRequest& request : requests) request.keys = false;
  const auto plain = meshAll(world, requests, 2);
  CHECK(hashOf(plain) == hashOf(keyed));
  size_t vertices = 0;
  for (size_t i = 0; i < keyed.size(); ++i) {
    const MeshPart &a = keyed[i].mesh.body, &b = plain[i].mesh.body;
    vertices += a.vertices.size();
    CHECK(a.keys.size() == a.vertices.size());
    REQUIRE(a.vertices.size() == b.vertices.size());
    if (a.vertices.empty()) continue;
    CHECK(std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)) == 0);
    CHECK(a.indices == b.indices);
  }
  CHECK(vertices > 1000);
  // Sharpening needs the keys of vertices, even if the request does not ask for keys.
  for (ChunkRequest& request : requests) {
    request.seams = 0;
    request.sharp = true;
  }
  const auto sharp = meshAll(world, requests, 2);
  for (ChunkRequest& request : requests) request.keys = true;
  CHECK(hashOf(meshAll(world, requests, 2)) == hashOf(sharp));
}

TEST_CASE("cells at hand give the same programs and anchors, and are not asked for again") {
  const WorldField world(settingsOf(yardstick("cave.sgm"), 1024), std::pmr::get_default_resource());
  CachedCells cached_cells;
  const std::vector<ChunkRequest> requests = requestsOf(world, kHall);
  for (const ChunkRequest& request : requests) {
    const Result<ChunkGrid> grid = chunkGrid(world, request.key);
    REQUIRE(grid);
    const IntBox box = chunkBox(*grid);
    const auto program = world.compile(box, 0), same = world.compile(box, 0, nullptr, &cached_cells);
    REQUIRE((program && same));
    CHECK((*program)->params == (*same)->params);
    REQUIRE((*program)->instrs.size() == (*same)->instrs.size());
    CHECK((*program)->groups.size() == (*same)->groups.size());
    const auto anchors = world.anchors(box), these = world.anchors(box, &cached_cells);
    REQUIRE((anchors && these));
    CHECK(anchors->size() == these->size());
  }
  CHECK_FALSE(cached_cells.empty());
  const CellCacheStats before = world.cacheStats();
  for (const ChunkRequest& request : requests)
    CHECK(world.compile(chunkBox(*chunkGrid(world, request.key)), 0, nullptr, &cached_cells));
  const CellCacheStats after = world.cacheStats();
  CHECK(after.hits == before.hits);
  CHECK(after.misses == before.misses);
}

TEST_CASE("doubling every reach changes nothing") {
  const std::string text = yardstick("cave.sgm");
  const std::string wide = replaced(replaced(text, "reach 176m", "reach 352m"), "reach 5m", "reach 10m");
  const WorldField narrow_world(settingsOf(text, 1024), std::pmr::get_default_resource());
  const WorldField wide_world(settingsOf(wide, 1024), std::pmr::get_default_resource());
  const auto requests = requestsOf(narrow_world, kHall);
  CHECK(hashOf(meshAll(narrow_world, requests, 2)) == hashOf(meshAll(wide_world, requests, 2)));
}

TEST_CASE("shapes, anchors and noise moved together by whole chunks give the same chunks, to the end of the world") {
  WorldFieldSettings s = settingsOf(yardstick("cave.sgm"), 1024);
  const WorldField home(s, std::pmr::get_default_resource());
  const auto requests = requestsOf(home, kHall);
  const std::pmr::vector<PlacedChunk> expected = meshAll(home, requests, 2);
  constexpr int32_t edge = 32 * 1024;
  for (const Int3 chunks : {Int3{1, -1, 3}, Int3{60'000, -60'000, 59'999}, Int3{-64'000, 1, 0}}) {
    s.shift = {chunks.x * edge, chunks.y * edge, chunks.z * edge};
    const WorldField moved(s, std::pmr::get_default_resource());
    std::vector<ChunkRequest> there = requests;
    for (ChunkRequest& r : there) r.key.at = saturatingAdd(r.key.at, chunks);
    const std::pmr::vector<PlacedChunk> found = meshAll(moved, there, 2);
    size_t different = 0;
    for (size_t i = 0; i < found.size(); ++i) different += found[i].mesh.body.hash != expected[i].mesh.body.hash;
    INFO("moved by " << chunks.x << ' ' << chunks.y << ' ' << chunks.z << " chunks");
    CHECK(different == 0);
  }
}

TEST_CASE("a region's chunks, welded by key, have no open edge inside") {
  const WorldField world(settingsOf(yardstick("cave.sgm"), 1024), std::pmr::get_default_resource());
  const std::pmr::vector<PlacedChunk> chunks = meshAll(world, requestsOf(world, kHall), 2);
  std::vector<PlacedPart> parts;
  for (const PlacedChunk& c : chunks) appendParts(c, parts);
  Result<WorldMesh> mesh = weld(parts, kHall.lo);
  REQUIRE(mesh);
  const MeshReport report = checkTriangles(mesh->indices, mesh->keys.size());
  INFO(describe(report));
  CHECK(report.manifold());
  // All open edges lie in the region's outer faces.
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < mesh->indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) edges.emplace_back(mesh->indices[i + k], mesh->indices[i + (k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  size_t inside = 0;
  for (const auto& [a, b] : edges) {
    if (std::binary_search(edges.begin(), edges.end(), std::pair(b, a))) continue;
    auto onBorder = [&](uint32_t v) {
      const VertexKey& key = mesh->keys[v];
      for (int axis = 0; axis < 3; ++axis) {
        if (key.axis != axis && (key.corner[axis] == kHall.lo[axis] || key.corner[axis] == kHall.hi[axis])) return true;
      }
      return false;
    };
    inside += !onBorder(a) || !onBorder(b);
  }
  CHECK(inside == 0);
}

TEST_CASE("a probe in one go answers as the probe step by step") {
  class StepByStep final : public LowerLayers {
   public:
    explicit StepByStep(const LayersBelow& below) : below_(below) {}
    bool solid(uint32_t layer, Int3 p) const override { return below_.solid(layer, p); }

   private:
    const LayersBelow& below_;
  };
  const WorldField world(settingsOf(yardstick("cave.sgm"), 512), std::pmr::get_default_resource());
  const LayersBelow below(world, kHall);
  const StepByStep slow(below);
  std::mt19937 random(11);
  size_t hits = 0;
  for (int i = 0; i < 400; ++i) {
    Int3 from;
    for (int axis = 0; axis < 3; ++axis) from[axis] = kHall.lo[axis] + static_cast<int32_t>(random() % (64 * 1024));
    const std::array<double, 3> direction = i % 3 == 0   ? std::array<double, 3>{0, 1, 0}
                                            : i % 3 == 1 ? std::array<double, 3>{0, -1, 0}
                                                         : std::array<double, 3>{0.6, 0, 0.8};
    const auto length = static_cast<int32_t>(random() % 8000);
    const auto fast = below.probe(0, from, direction, length);
    INFO("probe " << i);
    CHECK(fast == slow.probe(0, from, direction, length));
    hits += fast.has_value();
  }
  CHECK_FALSE(below.error());
  CHECK(hits > 0);
}

TEST_CASE("chunks and regions outside of the world are refused with a reason") {
  const WorldField world(settingsOf(sample("sphere.sgm"), 512), std::pmr::get_default_resource());
  CHECK(chunkGrid(world, {0, {131'070, 0, 0}}));
  CHECK(chunkGrid(world, {0, {-131'072, 0, 0}}));
  const auto codeOf = [&](const ChunkKey& key) {
    const auto grid = chunkGrid(world, key);
    REQUIRE_FALSE(grid);
    return grid.error().code;
  };
  for (const Int3 at : {Int3{131'071, 0, 0}, Int3{0, -131'073, 0}}) CHECK(codeOf({0, at}) == Code::range);
  for (const int level : {-1, kMaxLevel + 1}) CHECK(codeOf({level, {}}) == Code::invalid_argument);
  CHECK(chunksOfRegion(world, {{0, 0, 0}, {0, 1, 1}}, 0, 10).error().code == Code::invalid_argument);
  CHECK(chunksOfRegion(world, IntBox::everything(), 0, 10).error().code == Code::range);
  // No memory can hold so many chunks, so the call fails whatever the limit is.
  const IntBox vast{{-(1 << 30), -(1 << 30), -(1 << 30)}, {1 << 30, 1 << 30, 1 << 30}};
  CHECK(chunksOfRegion(world, vast, 0, ~uint64_t{0}).error().code == Code::limit);
  CHECK(chunksOfRegion(world, {{0, 0, 0}, {1 << 20, 1 << 20, 1 << 20}}, 0, 10).error().code == Code::limit);
}

TEST_CASE("cancelled meshing says so, and a job system of one thread does not wait for itself", "[threads]") {
  const WorldField world(settingsOf(sample("sphere.sgm"), 256), std::pmr::get_default_resource());
  const auto jobs = *makeThreadPool(1);
  auto backend = makeBackend({}, *jobs, world.memory());
  REQUIRE(backend);
  const auto requests = requestsOf(world, {{-64 * 1024, -64 * 1024, -64 * 1024}, {64 * 1024, 64 * 1024, 64 * 1024}});
  const auto stopped = meshChunks(world, **backend, *jobs, requests, [](uint64_t, uint64_t) { return false; });
  REQUIRE_FALSE(stopped);
  CHECK(stopped.error().code == Code::cancelled);
  CHECK(meshChunks(world, **backend, *jobs, {}));
}

TEST_CASE("progress is told after every chunk, on any number of threads", "[threads]") {
  const WorldField world(settingsOf(sample("sphere.sgm"), 256), std::pmr::get_default_resource());
  const auto requests = requestsOf(world, {{-64 * 1024, -64 * 1024, 0}, {64 * 1024, 64 * 1024, 8 * 1024}});
  REQUIRE(requests.size() > 100);
  for (const unsigned threads : {1u, 4u}) {
    const auto jobs = *makeThreadPool(threads);
    auto backend = makeBackend({}, *jobs, world.memory());
    REQUIRE(backend);
    uint64_t calls = 0, wrong = 0;
    const auto all = [&](uint64_t done, uint64_t total) {
      wrong += done != ++calls || total != requests.size();
      return done < total;  // the result of the last call is ignored
    };
    CHECK(meshChunks(world, **backend, *jobs, requests, all));
    CHECK(calls == requests.size());
    CHECK(wrong == 0);
    calls = 0;
    const auto some = [&](uint64_t, uint64_t) { return ++calls < 70; };
    const auto stopped = meshChunks(world, **backend, *jobs, requests, some);
    REQUIRE_FALSE(stopped);
    CHECK(stopped.error().code == Code::cancelled);
    CHECK(calls == 70);
  }
}

TEST_CASE("what a layer of anchors alone leaves out is noted") {
  const WorldField world(settingsOf("sgm 1; units m;\ndomain infinite;\nlayer main cell 8m reach 1m { start Post; }\n"
                                    "rule Post { at(20m, 0m, 0m) anchor post \"here\"; }\n",
                                    1024),
                         std::pmr::get_default_resource());
  const auto notes = world.notes({{0, 0, 0}, {1024, 1024, 1024}}, 1024);
  REQUIRE(notes);
  CHECK_FALSE(notes->empty());
}

TEST_CASE("anchors are found in more cells than one chunk may have", "[costly]") {
  // A chunk's program may be made of at most 2^20 cells.
  const IntBox box{{-530'000 * 1024, 0, 0}, {530'000 * 1024, 1024, 1024}};
  const WorldField world(settingsOf("sgm 1; units m;\ndomain infinite axes x;\n"
                                    "layer main cell 1m reach 1m { start Post; }\n"
                                    "rule Post weight 1 { anchor post \"here\"; sphere(10cm); }\n"
                                    "rule Post weight 9999 { }\n",
                                    1024),
                         std::pmr::get_default_resource());
  const auto anchors = world.anchors(box);
  INFO((anchors ? "" : anchors.error().message));
  REQUIRE(anchors);
  CHECK(anchors->size() > 50);
  const auto program = world.compile(box, 0);
  REQUIRE_FALSE(program);
  CHECK(program.error().code == Code::limit);
  CHECK(program.error().message.find("`main` reach into one chunk") != std::string::npos);
}
