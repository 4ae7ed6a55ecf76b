// Tests the claims of the row GK-M in the paper's Table 4, column by column, with the sample that represents it:
// clouds, buildings and caves in one world, levels of detail, control, morphing, texturing, no hidden surfaces, welded
// vertices, no holes. The sample's own `expect` statements test that it is closed and connected.

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "chunk/surface_shapes.h"
#include "field/evaluate.h"
#include "mesh/check.h"
#include "mesh/vertex.h"
#include "mesh/weld.h"
#include "rounds.h"
#include "seed.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr IntBox kPatch{{-200 * 1024, -60 * 1024, -200 * 1024}, {200 * 1024, 120 * 1024, 200 * 1024}};

/// A box that contains clouds, which are few and far apart.
constexpr IntBox kSky{{-900 * 1024, 380 * 1024, -900 * 1024}, {900 * 1024, 480 * 1024, 900 * 1024}};

WorldField worldOf(uint64_t seed, const char* parameter = "round", double value = 0.6) {
  WorldFieldSettings settings = settingsOf(sample("table4/gkm.sgm"), 512, seed);
  REQUIRE(settings.parameters.set(*settings.program, parameter, value));
  return {std::move(settings), std::pmr::get_default_resource()};
}

std::vector<Int3> placesOf(const WorldField& world, const char* rule) {
  const auto found = world.instances(ruleNamed(*world.settings().program, rule), kPatch, 10'000);
  REQUIRE(found);
  std::vector<Int3> places;
  for (const RuleInstance& one : *found) places.push_back(one.origin);
  return places;
}

size_t cloudsOf(const WorldField& world) {
  const auto found = world.instances(ruleNamed(*world.settings().program, "Cumulus"), kSky, 10'000);
  REQUIRE(found);
  return found->size();
}

bool solidAt(const WorldField& world, Int3 p) {
  const auto program = world.compile({p, p}, 0);
  REQUIRE(program);
  int32_t q = 0;
  EvalScratch scratch;
  scalarKernels().samples((*program)->view(), {&p.x, &p.y, &p.z, 1}, scratch, &q);
  return q < 0;
}

Int3 moved(Int3 p, double x, double y, double z) {
  const auto units = [](double metres) { return static_cast<int32_t>(std::lround(metres * kUnitsPerMetre)); };
  return {p.x + units(x), p.y + units(y), p.z + units(z)};
}

/// Chunks around the tower at the world's origin, from the caves to the clouds; half as many with a sanitizer, because
/// these tests spend most of their time on the chunks.
std::pmr::vector<PlacedChunk> chunksOf(const WorldField& world, int level) {
  std::vector<ChunkRequest> requests;
  const int32_t edge = kChunkCells * world.cellAt(level) / kUnitsPerMetre;
  for (int32_t z = rounds(4) < 4 ? 0 : -64 / edge; z < 64 / edge; ++z) {
    for (int32_t y = -64 / edge; y < 128 / edge; ++y) {
      for (int32_t x = -64 / edge; x < 64 / edge; ++x) requests.emplace_back().key = {level, {x, y, z}};
    }
  }
  return meshAll(world, requests, 2);
}

/// The texel density on a chunk's surface.
TexelDensity textureOf(const WorldField& world, const PlacedChunk& chunk) {
  const MeshPart& body = chunk.mesh.body;
  std::vector<TexturePoint> positions;
  for (const Vertex& vertex : body.vertices) {
    const auto at = [&](int axis, int16_t local) {
      return chunk.grid.origin[axis] + double{1} * local * chunk.grid.cell / kSubcell;
    };
    positions.push_back({at(0, vertex.x), at(1, vertex.y), at(2, vertex.z)});
  }
  PackedMesh packed;
  packed.vertices.assign(body.vertices.begin(), body.vertices.end());
  packed.indices.assign(body.indices.begin(), body.indices.end());
  const Result<Unwrapped> unwrapped = unwrapChunk(world, packed, chunk.grid, nullptr, kTile, world.memory());
  REQUIRE(unwrapped);
  UnwrapInput input;
  input.positions = positions;
  input.indices = packed.indices;
  return texelDensity(input, *unwrapped, kTile);
}

size_t trianglesOf(const std::pmr::vector<PlacedChunk>& chunks) {
  size_t triangles = 0;
  for (const PlacedChunk& chunk : chunks) triangles += chunk.mesh.body.indices.size() / 3;
  return triangles;
}

}  // namespace

TEST_CASE("GK-M: clouds, towers and caves follow their parameters", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(3); ++round) {
    const uint64_t of = random();
    // The height of a tower is proportional to its number of floors.
    for (const int floors : {2, 5, 9}) {
      const WorldField world = worldOf(of, "floors", floors);
      const std::vector<Int3> towers = placesOf(world, "Tower");
      REQUIRE(towers.size() >= 4);
      for (const Int3& foot : {towers.front(), towers.back()}) {
        CHECK(solidAt(world, moved(foot, 0, 6 + 3.0 * floors - 0.5, 0)));
        CHECK(!solidAt(world, moved(foot, 0, 6 + 3.0 * floors + 3, 0)));
      }
    }
  }
  // The number of clouds follows the parameter `cover`. The eight worlds are fixed: clouds are grouped, so that eight
  // random worlds would exceed these bounds once in some thousand runs.
  size_t none = 0, some = 0, all = 0;
  for (uint64_t of = 1; of <= 8; ++of) {
    none += cloudsOf(worldOf(of, "cover", 0));
    some += cloudsOf(worldOf(of, "cover", 0.5));
    all += cloudsOf(worldOf(of, "cover", 1));
  }
  CAPTURE(some, all);
  CHECK(none == 0);
  CHECK(10 * some > all);
  CHECK(10 * some < 9 * all);
}

TEST_CASE("GK-M: one number morphs halls, storeys and clouds, and nothing else", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const WorldField cubes = worldOf(seed, "round", 0), balls = worldOf(seed, "round", 1);
  // Samples a place at the upper edge of a storey, between two ledges. It is solid if storeys are boxes; if they are
  // rounded boxes, it is void.
  size_t edges_kept = 0, edges_gone = 0, storeys = 0;
  const auto found = cubes.instances(ruleNamed(*cubes.settings().program, "Tower"), kPatch, 1000);
  REQUIRE(found);
  for (const RuleInstance& tower : *found) {
    // This place also lies inside the narrowest towers, which are 9 m wide.
    const Int3 corner = moved(tower.origin, 4.4, 7.5 + 1.1, 4.4);
    ++storeys;
    edges_kept += solidAt(cubes, corner);
    edges_gone += !solidAt(balls, corner) || solidAt(balls, moved(tower.origin, 6.0, 7.5 + 1.1, 6.0));
  }
  CHECK(storeys >= 4);
  CHECK(edges_kept == storeys);
  CHECK(edges_gone > 0);
  // The corner of a hall: it is void if the hall is a cube with an edge of 1.7 radii, and rock if it is a ball.
  size_t corners_open = 0, corners_closed = 0, halls = 0;
  for (const Int3& middle : placesOf(cubes, "Hall")) {
    ++halls;
    const Int3 corner = moved(middle, 6, -5.6, 6);  // lies in the smallest cube, too, of 8 m radius
    corners_open += !solidAt(cubes, corner);
    corners_closed += solidAt(balls, corner);
  }
  CHECK(halls >= 8);
  CHECK(corners_open == halls);
  CHECK(corners_closed > 0);
  // The cells of layers that do not use the parameter stay equal.
  const Program& program = *cubes.settings().program;
  const auto readers = [&](uint32_t layer) {
    const auto cell = cubes.cell(layer, {0, 0, 0});
    REQUIRE(cell);
    return ((*cell)->chunk.parameters & parameterBit(program.findParam("round"))) != 0;
  };
  CHECK(!readers(0));
  CHECK(readers(1));
  CHECK(readers(2));
  const auto triangles = [](const WorldField& world) { return trianglesOf(chunksOf(world, 1)); };
  CHECK(triangles(cubes) != triangles(balls));
}

TEST_CASE("GK-M: welded, nothing hidden, textured, and far less from afar", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const WorldField world = worldOf(seed);
  const std::pmr::vector<PlacedChunk> chunks = chunksOf(world, 0);
  std::vector<PlacedPart> parts;
  size_t vertices = 0, wrong_side = 0;
  for (const PlacedChunk& chunk : chunks) {
    if (chunk.mesh.body.indices.empty()) continue;
    parts.push_back({&chunk.mesh.body, chunk.grid, 0});
    // At each vertex, there is solid on the inner side of the surface and void on the outer side, so no surface lies
    // inside another shape.
    std::vector<int32_t> x, y, z;
    for (size_t v = 0; v < chunk.mesh.body.vertices.size(); v += 7) {
      const Vertex& vertex = chunk.mesh.body.vertices[v];
      const std::array<double, 3> n = unpackNormal(vertex.normal_x, vertex.normal_y);
      const Int3 at = vertexUnits(chunk.grid, vertex);
      for (const double side : {-60.0, 60.0}) {
        x.push_back(at.x + static_cast<int32_t>(std::lround(side * n[0])));
        y.push_back(at.y + static_cast<int32_t>(std::lround(side * n[1])));
        z.push_back(at.z + static_cast<int32_t>(std::lround(side * n[2])));
      }
    }
    IntBox box;
    for (size_t i = 0; i < x.size(); ++i) box = box.joined({{x[i], y[i], z[i]}, {x[i], y[i], z[i]}});
    const auto program = world.compile(box, 0);
    REQUIRE(program);
    std::vector<int32_t> q(x.size());
    EvalScratch scratch;
    scalarKernels().samples((*program)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch, q.data());
    for (size_t i = 0; i + 1 < q.size(); i += 2) {
      ++vertices;
      wrong_side += q[i] >= 0 || q[i + 1] < 0;
    }
  }
  // On nearly all of the surface of nearly every chunk, a texture tile has its stated size.
  size_t textured = 0, even = 0;
  for (const PlacedChunk& chunk : chunks) {
    if (chunk.mesh.body.indices.size() < 300) continue;
    const TexelDensity density = textureOf(world, chunk);
    ++textured;
    even += density.low > 0.5 && density.high < 2;
  }
  REQUIRE(textured > 20);
  CHECK(static_cast<double>(even) > 0.9 * static_cast<double>(textured));
  REQUIRE(vertices > 5000);
  // The few exceptions are at edges, where the normal belongs to only one of the two sides.
  CHECK(static_cast<double>(wrong_side) < 0.03 * static_cast<double>(vertices));
  const Result<WorldMesh> welded = weld(parts, {});
  REQUIRE(welded);
  std::set<std::array<double, 3>> places(welded->positions.begin(), welded->positions.end());
  CHECK(places.size() == welded->positions.size());
  CHECK(checkTriangles(welded->indices, welded->positions.size()).manifold());

  const size_t fine = trianglesOf(chunks), coarse = trianglesOf(chunksOf(world, 1)),
               far = trianglesOf(chunksOf(world, 2));
  CHECK(3 * coarse < fine);
  CHECK(3 * far < coarse);
}
