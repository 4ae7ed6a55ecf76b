// Tests measures of single chunks: the samples have no defects and the measures of the whole mesh, and all damage is
// found.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "asset/triangle_mesh.h"
#include "backend/open/open_backend.h"
#include "edits_support.h"
#include "measure/measure_chunk.h"
#include "measure/mesh_measures.h"
#include "measure/world_triangles.h"
#include "mesh/check.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex.h"
#include "rounds.h"
#include "streaming_support.h"

using namespace sgm;
using namespace sgm::measure;

namespace {

ChunkMeasures measured(const PlacedChunk& chunk) {
  MeasureScratch scratch(std::pmr::get_default_resource());
  ChunkMeasures measures;
  measureBody(viewOf(chunk.mesh.body), chunk.mesh.signs, scratch, measures);
  for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) {
    measures.parts[1 + face] = measureSeam(viewOf(chunk.mesh.seams[face]));
  }
  return measures;
}

std::string described(const ChunkMeasures& measures) {
  std::string text;
  for (size_t part = 0; part < measures.parts.size(); ++part) {
    for (size_t kind = 0; kind < kDefects; ++kind) {
      if (measures.parts[part].defects[kind] == 0) continue;
      text += " part " + std::to_string(part) + ": " + std::to_string(measures.parts[part].defects[kind]) + ' ' +
              defectName(static_cast<Defect>(kind)) + ';';
    }
  }
  return text;
}

/// A grammar, and a place of its world with many surfaces.
struct Excerpt {
  const char* grammar;
  int32_t cell;
  Int3 at;         ///< middle of the place, in metres
  int32_t around;  ///< distance from the middle to each side, in metres
  bool sharp = false;
};
constexpr Excerpt kExcerpts[] = {
    {"cave.sgm", 256, {112, 96, 96}, 24},       {"city.sgm", 512, {40, 8, 40}, 30},
    {"terrain.sgm", 256, {0, 4, 0}, 30},        {"cloud.sgm", 4096, {450, 1200, 450}, 500},
    {"building.sgm", 256, {0, 6, 0}, 12, true}, {"table4/muller.sgm", 512, {0, 8, 0}, 12, true}};

ChunkRequest randomRequest(std::mt19937& random, const Excerpt& scene) {
  const Int3 middle{scene.at.x * kUnitsPerMetre, scene.at.y * kUnitsPerMetre, scene.at.z * kUnitsPerMetre};
  const Int3 at = randomPlace(random, IntBox{middle, middle}.grown(scene.around * kUnitsPerMetre));
  ChunkRequest request;
  request.key.level = static_cast<int>(random() % 3);
  const int64_t edge = int64_t{kChunkCells} * scene.cell << request.key.level;
  for (int axis = 0; axis < 3; ++axis) request.key.at[axis] = static_cast<int32_t>(floorDiv(at[axis], edge));
  request.seams = static_cast<uint8_t>(random() % 64);
  request.signs = random() % 2 == 0;
  request.sharp = scene.sharp;
  return request;
}

/// Rotated boxes in a finite world, which can be meshed completely and is closed.
const char* const kBoxes =
    "sgm 1; units m; domain finite box(96m, 96m, 96m) empty; start Heap;\n"
    "rule Heap {\n"
    "  at(4m, -3m, 5m) rot(y, 25deg) rot(x, 35deg) box(34m, 21m, 27m);\n"
    "  at(-20m, 5m, -16m) rot(y, 45deg) rot(z, 30deg) { box(24m, 30m, 16m); cut { rot(x, 15deg) box(9m, 40m, 9m); } }\n"
    "  at(22m, 18m, -20m) sphere(11m);\n"
    "}\n";
constexpr int kTop = 2;
constexpr int32_t kFinest = 512;

Octree randomTree(std::mt19937& random) {
  Octree tree(kTop, kFinest);
  for (int corner = 0; corner < 8; ++corner)
    tree.split({kTop + 1, {-(corner & 1), -(corner >> 1 & 1), -(corner >> 2)}});
  for (int i = 0; i < 5; ++i) {
    const int level = 1 + static_cast<int>(random() % kTop);
    const int32_t edge = kChunkCells * kFinest << level;
    ChunkKey key{level, {}};
    for (int axis = 0; axis < 3; ++axis)
      key.at[axis] = static_cast<int32_t>(floorDiv(static_cast<int32_t>(random() % 65536) - 32768, edge));
    tree.split(key);
  }
  refineToRules(tree);
  return tree;
}

/// A random chunk with a large surface, without sharp features.
PlacedChunk anyChunk(std::mt19937& random) {
  static const WorldField world(settingsOf(yardstick("cave.sgm"), 256, 3), std::pmr::get_default_resource());
  for (;;) {
    ChunkRequest request = randomRequest(random, kExcerpts[0]);
    request.seams = 0;
    request.signs = true;
    std::pmr::vector<PlacedChunk> chunks = meshAll(world, {request}, 1);
    if (chunks.front().mesh.body.indices.size() > 300) return std::move(chunks.front());
  }
}

using Body = MeshPart;
uint32_t any(std::mt19937& random, size_t count) { return static_cast<uint32_t>(random() % count); }

/// Merges two distant vertices of the body, which have no common neighbour, so that the result is non-manifold.
void pinch(Body& body, std::mt19937& random) {
  std::vector<std::vector<uint32_t>> around(body.vertices.size());
  for (size_t at = 0; at < body.indices.size(); ++at) {
    const size_t first = at - at % 3;
    for (size_t k = 0; k < 3; ++k) around[body.indices[at]].push_back(body.indices[first + k]);
  }
  for (;;) {
    const uint32_t a = any(random, body.vertices.size()), b = any(random, body.vertices.size());
    const bool apart = std::none_of(around[a].begin(), around[a].end(), [&](uint32_t v) {
      return std::find(around[b].begin(), around[b].end(), v) != around[b].end();
    });
    if (a == b || around[a].empty() || around[b].empty() || !apart) continue;
    std::replace(body.indices.begin(), body.indices.end(), a, b);
    return;
  }
}

/// Moves a vertex to the middle between two others; these are moved by one step if their middle is not representable.
void putBetween(Body& body, uint32_t moved, uint32_t from, uint32_t to) {
  Vertex &v = body.vertices[moved], &a = body.vertices[from];
  const Vertex& b = body.vertices[to];
  for (int16_t Vertex::*axis : {&Vertex::x, &Vertex::y, &Vertex::z}) {
    if (((a.*axis + b.*axis) & 1) != 0) a.*axis = static_cast<int16_t>(a.*axis + (a.*axis == 0 ? 1 : -1));
    v.*axis = static_cast<int16_t>((a.*axis + b.*axis) / 2);
  }
}

struct Damage {
  const char* name;
  std::function<void(PlacedChunk&, std::mt19937&)> make;
  Defect found;
  uint32_t least;
};

const std::vector<Damage>& damages() {
  // A triangle with a corner that is not on the border: an edge on the border has only one triangle anyway.
  static const auto triangle = [](PlacedChunk& chunk, std::mt19937& random) {
    Body& body = chunk.mesh.body;
    for (;;) {
      const auto at = body.indices.begin() + 3 * any(random, body.indices.size() / 3);
      const Vertex& p = body.vertices[at[0]];
      if (std::min({p.x, p.y, p.z}) > 0 && std::max({p.x, p.y, p.z}) < kChunkCells * kSubcell) return at;
    }
  };
  static const std::vector<Damage> all{
      {"a triangle is missing",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         chunk.mesh.body.indices.erase(at, at + 3);
       },
       Defect::open_edge, 1},
      {"a triangle is turned over",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         std::swap(at[0], at[1]);
       },
       Defect::turned_edge, 1},
      {"a triangle is there twice",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         const uint32_t copy[3] = {at[1], at[2], at[0]};
         chunk.mesh.body.indices.insert(chunk.mesh.body.indices.end(), copy, copy + 3);
       },
       Defect::duplicate, 1},
      {"a triangle is there twice, and once turned over",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         const uint32_t copy[3] = {at[1], at[0], at[2]};
         chunk.mesh.body.indices.insert(chunk.mesh.body.indices.end(), copy, copy + 3);
       },
       Defect::duplicate, 1},
      {"a triangle hangs on an edge of two others",
       [](PlacedChunk& chunk, std::mt19937& random) {
         Body& body = chunk.mesh.body;
         const auto at = triangle(chunk, random);
         uint32_t far = 0;
         while (far == at[0] || far == at[1] || far == at[2]) ++far;
         const uint32_t more[3] = {at[0], at[1], far};
         body.indices.insert(body.indices.end(), more, more + 3);
       },
       Defect::nonmanifold_edge, 1},
      {"a corner is there twice",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         at[2] = at[0];
       },
       Defect::degenerate, 1},
      {"a vertex has left its edge",
       [](PlacedChunk& chunk, std::mt19937& random) {
         Vertex& v = chunk.mesh.body.vertices[any(random, chunk.mesh.body.vertices.size())];
         const int axis = (edgeOfBodyVertex(v).axis + 1 + static_cast<int>(any(random, 2))) % 3;
         int16_t& at = axis == 0 ? v.x : axis == 1 ? v.y : v.z;
         at = static_cast<int16_t>(at + (at == 0 ? 1 : -1));
       },
       Defect::misplaced, 1},
      {"two vertices are on one edge",
       [](PlacedChunk& chunk, std::mt19937& random) {
         auto& vertices = chunk.mesh.body.vertices;
         const uint32_t i = 1 + any(random, vertices.size() - 1);
         vertices[i] = vertices[i - 1];
       },
       Defect::misplaced, 1},
      {"a vertex is outside",
       [](PlacedChunk& chunk, std::mt19937& random) {
         Vertex& v = chunk.mesh.body.vertices[any(random, chunk.mesh.body.vertices.size())];
         v.y =
             static_cast<int16_t>(random() % 2 == 0 ? -1 - static_cast<int>(random() % 32768)
                                                    : kChunkCells * kSubcell + 1 + static_cast<int>(random() % 20000));
       },
       Defect::outside, 1},
      {"an index is out of range",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto count = static_cast<uint32_t>(chunk.mesh.body.vertices.size());
         triangle(chunk, random)[any(random, 3)] = random() % 2 == 0 ? count : UINT32_MAX;
       },
       Defect::index, 1},
      {"two corners of a triangle lie in one place",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         chunk.mesh.body.vertices[at[0]] = chunk.mesh.body.vertices[at[1]];
       },
       Defect::degenerate, 1},
      {"two feature vertices of a triangle lie in one place",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         Vertex &first = chunk.mesh.body.vertices[at[0]], &second = chunk.mesh.body.vertices[at[1]];
         first = second;
         first.kind = kFeature | kFeatureOfCell | 21;
         second.kind = kFeature | 21;
       },
       Defect::degenerate, 1},
      {"a triangle is flat",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         putBetween(chunk.mesh.body, at[0], at[1], at[2]);
       },
       Defect::flat, 1},
      {"a triangle with a feature vertex is flat",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const auto at = triangle(chunk, random);
         putBetween(chunk.mesh.body, at[0], at[1], at[2]);
         chunk.mesh.body.vertices[at[0]].kind = kFeature | kFeatureOfCell | 21;
       },
       Defect::flat, 1},
      {"a triangle is folded onto its neighbour",
       [](PlacedChunk& chunk, std::mt19937& random) {
         Body& body = chunk.mesh.body;
         const auto at = triangle(chunk, random);
         const std::array<uint32_t, 3> t{at[0], at[1], at[2]};
         const auto apex = static_cast<uint32_t>(body.vertices.size());
         body.vertices.push_back(body.vertices[t[2]]);
         putBetween(body, apex, t[0], t[2]);
         const uint32_t more[3] = {t[1], t[0], apex};
         body.indices.insert(body.indices.end(), more, more + 3);
       },
       Defect::folded, 1},
      {"a triangle goes through another",
       [](PlacedChunk& chunk, std::mt19937& random) {
         Body& body = chunk.mesh.body;
         // Chooses a triangle whose middle is inside the chunk on every grid.
         std::array<uint32_t, 3> t{};
         std::array<int, 3> middle{}, across{};
         do {
           const auto at = triangle(chunk, random);
           t = {at[0], at[1], at[2]};
           const Vertex &a = body.vertices[t[0]], &b = body.vertices[t[1]], &c = body.vertices[t[2]];
           middle = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
           const TriangleTerms terms = termsOf(a, b, c);
           const double length = std::sqrt(static_cast<double>(terms.square));
           across = {static_cast<int>(100 * terms.x / length), static_cast<int>(100 * terms.y / length),
                     static_cast<int>(100 * terms.z / length)};
           // It must not be a sliver, and its middle must be far enough inside the chunk.
           if (isSliver(terms) || terms.square < int64_t{1} << 28) middle[0] = 0;
         } while (*std::min_element(middle.begin(), middle.end()) < 200 ||
                  *std::max_element(middle.begin(), middle.end()) > kChunkCells * kSubcell - 200);
         const auto first = static_cast<uint32_t>(body.vertices.size());
         for (const int side : {-1, 1, 2}) {
           Vertex& v = body.vertices.emplace_back(body.vertices[t[0]]);
           v.x = static_cast<int16_t>(middle[0] + (side == 2 ? 90 : side * across[0]));
           v.y = static_cast<int16_t>(middle[1] + (side == 2 ? 70 : side * across[1]));
           v.z = static_cast<int16_t>(middle[2] + (side == 2 ? -80 : side * across[2]));
         }
         const uint32_t more[3] = {first, first + 1, first + 2};
         body.indices.insert(body.indices.end(), more, more + 3);
       },
       Defect::self_intersection, 1},
      {"two vertices are one", [](PlacedChunk& chunk, std::mt19937& random) { pinch(chunk.mesh.body, random); },
       Defect::pinched_vertex, 1},
      {"a sample is of the other sign",
       [](PlacedChunk& chunk, std::mt19937& random) {
         const SampleEdge edge =
             edgeOfBodyVertex(chunk.mesh.body.vertices[any(random, chunk.mesh.body.vertices.size())]);
         chunk.mesh.signs[static_cast<size_t>(edge.y + kChunkSamples * edge.z)] ^= uint64_t{1} << edge.x;
       },
       Defect::unlike_samples, 1},
  };
  return all;
}

}  // namespace

namespace {

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
  const WorldField world(settingsOf(kBoxes, kFinest, 3), std::pmr::get_default_resource());
  const auto jobs = *makeThreadPool(2);
  for (uint32_t seed = 1; seed <= std::max(rounds(6), 2u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<ChunkRequest> requests = frameRequests(randomTree(random));
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
    // Equal to the last bit, since all terms are integers.
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
    // Some 100 m from the origin, the summands are far larger than their sum.
    CHECK(std::fabs(sums.flux - whole.volumeAbout({0, 0, 0})) < 1e-9 * 300 * whole.area);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::fabs(sums.area_vector[static_cast<size_t>(axis)] - whole.area_vector[axis]) < 1e-9 * whole.area);
    }
  }
}

TEST_CASE("damage of every kind is found, and as what it is") {
  std::mt19937 random(3);
  for (unsigned round = 0; round < std::max(rounds(12), 4u); ++round) {
    const PlacedChunk whole = anyChunk(random);
    REQUIRE(described(measured(whole)).empty());
    for (const Damage& damage : damages()) {
      CAPTURE(round, damage.name);
      PlacedChunk chunk = whole;
      damage.make(chunk, random);
      const ChunkMeasures measures = measured(chunk);
      INFO(described(measures));
      CHECK(measures.parts[0].defect(damage.found) >= damage.least);
      SurfaceSums sums;
      sums.add(measures, chunk.grid, true, 0);
      CHECK_FALSE(sums.sound());
    }
  }
}

TEST_CASE("a turned triangle faces against its normals, and a seam's damage is found") {
  std::mt19937 random(11);
  PlacedChunk chunk = anyChunk(random);
  const uint32_t before = measured(chunk).parts[0].against_gradient;
  for (size_t at = 0; at < chunk.mesh.body.indices.size(); at += 3)
    std::swap(chunk.mesh.body.indices[at], chunk.mesh.body.indices[at + 1]);
  const PartMeasures turned = measured(chunk).parts[0];
  CHECK(before < turned.triangles / 20);
  CHECK(turned.against_gradient > turned.triangles - turned.triangles / 20);

  MeshPart seam = chunk.mesh.body;
  CHECK(measureSeam(viewOf(seam)).defects == Defects{});
  seam.indices[0] = seam.indices[1];
  seam.indices[3] = static_cast<uint32_t>(seam.vertices.size());
  seam.vertices.back().z = -1;
  const PartMeasures damaged = measureSeam(viewOf(seam));
  CHECK(damaged.defect(Defect::degenerate) == 1);
  CHECK(damaged.defect(Defect::index) == 1);
  CHECK(damaged.defect(Defect::outside) == 1);
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

TEST_CASE("a streamed world sums the measures of what it draws", "[threads]") {
  WorldSettings settings;
  settings.measure = true;
  Scene scene(*makeThreadPool(2), caveText(), settings);
  Engine engine;
  std::mt19937 random(29);
  Viewer viewer = viewerAt(112, 96, 96);
  for (int step = 0; step < 3; ++step, viewer = wander(random, viewer)) {
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    const std::optional<WorldMeasures> measures = scene.world->measures();
    REQUIRE(measures);
    CHECK(measures->drawn.sound());
    CHECK(measures->made.sums.sound());
    CHECK(measures->drawn.area > 0);
    for (const double component : measures->drawn.area_vector)
      CHECK(std::fabs(component) < 1e-9 * measures->drawn.area);
    SurfaceSums drawn;
    for (const auto& [key, shown] : engine.shown) {
      REQUIRE(shown.surface->measures);
      ChunkMeasures again;
      MeasureScratch scratch(std::pmr::get_default_resource());
      measureBody(viewOf(shown.surface->mesh, 0), {}, scratch, again);
      for (size_t face = 0; face < 6; ++face)
        again.parts[1 + face] = measureSeam(viewOf(shown.surface->mesh, 1 + face));
      again.topology.compared = shown.surface->measures->topology.compared;
      CHECK(again == *shown.surface->measures);
      drawn.add(again, shown.surface->grid, true, shown.seams);
    }
    CHECK(drawn == measures->drawn);
    CHECK(measures->made.sums.triangles >= drawn.triangles);
    CHECK(measures->made.sums.compared > 0);
    CHECK(measures->made.measuring > 0);
    CHECK(measures->made.meshing > 0);
  }
  CHECK_FALSE(Scene(*makeThreadPool(1)).world->measures());
}
