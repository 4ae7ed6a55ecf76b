// Tests random solids: as a region of one level they are valid; as an octree of chunks with seams they are closed,
// manifold, and without triangles that have two corners at the same place or pierce another.

#include <cstdio>
#include <map>

#include "mesh/check.h"
#include "mesh/triangle_faults.h"
#include "random_solids.h"
#include "rounds.h"
#include "stream/plan/frame.h"

using namespace sgm;
using namespace sgm::test;

namespace {

constexpr IntBox kAll{{-12 * kUnitsPerMetre, -12 * kUnitsPerMetre, -12 * kUnitsPerMetre},
                      {12 * kUnitsPerMetre, 12 * kUnitsPerMetre, 12 * kUnitsPerMetre}};

/// Number of solids: a thousand in the long run.
unsigned solidsWanted() { return rounds(100); }

/// Checks the regions of random solids with both cell sizes.
void checkSolids(bool sharp) {
  const ReportContext shop;
  size_t valid = 0, seen = 0, triangles = 0;
  Faults all;
  for (unsigned seed = 1; seed <= solidsWanted(); ++seed) {
    std::mt19937 random(seed);
    const std::string text = randomSolid(random);
    const std::shared_ptr<const Program> program = compiled(text);
    for (const double cell : kSolidCells) {
      const WorldField world(worldOf(program, cell, 1), std::pmr::get_default_resource());
      const MeshedRegion region = meshedRegion(world, shop, kAll, sharp);
      if (region.mesh.triangles.empty()) continue;
      const Faults faults = faultsOf(region.mesh, nullptr, *shop.jobs);
      CAPTURE(seed, cell, sharp, text);
      INFO(faults);
      CHECK(faults.valid);
      ++seen;
      valid += faults.valid;
      triangles += faults.triangles;
      all.triangles += faults.triangles;
      all.degenerate += faults.degenerate;
      all.without_area += faults.without_area;
      all.folded += faults.folded;
      all.cuts += faults.cuts;
      all.nonmanifold += faults.nonmanifold;
      all.others += faults.others;
    }
  }
  std::printf("%s solids: %zu of %zu valid; %s\n", sharp ? "sharp" : "plain", valid, seen,
              Catch::Detail::stringify(all).c_str());
  CHECK(seen > solidsWanted());
  CHECK(triangles > 1000 * seen);
}

/// An octree of the solid's surroundings, refined at random places.
Octree randomTree(std::mt19937& random, int32_t finest) {
  constexpr int kTop = 2;
  Octree tree(kTop, finest);
  const int32_t virtual_edge = kChunkCells * finest << (kTop + 1);
  const auto nodes = static_cast<int32_t>((kAll.hi.x + virtual_edge - 1) / virtual_edge);
  for (int32_t z = -nodes; z < nodes; ++z) {
    for (int32_t y = -nodes; y < nodes; ++y)
      for (int32_t x = -nodes; x < nodes; ++x) tree.split({kTop + 1, {x, y, z}});
  }
  for (int i = 0; i < 3; ++i) {
    const int level = 1 + static_cast<int>(random() % kTop);
    const int32_t edge = kChunkCells * finest << level;
    ChunkKey key{level, {}};
    for (int axis = 0; axis < 3; ++axis)
      key.at[axis] = static_cast<int32_t>(
          floorDiv(static_cast<int32_t>(between(random, -4 * kUnitsPerMetre, 4 * kUnitsPerMetre)), edge));
    tree.split(key);
  }
  refineToRules(tree);
  return tree;
}

/// Whether the triangles pierce each other: an edge of one triangle has its ends on both sides of the other triangle,
/// and passes through the inside of that triangle. Triangles that touch or lie on each other do not pierce.
bool pierce(std::span<const measure::Point> points, const measure::Triangle& a, const measure::Triangle& b) {
  using measure::orientation;
  const auto goesThrough = [&](const measure::Triangle& edges, const measure::Triangle& wall) {
    const measure::Point p = points[wall[0]], q = points[wall[1]], r = points[wall[2]];
    for (size_t k = 0; k < 3; ++k) {
      const measure::Point from = points[edges[k]], to = points[edges[(k + 1) % 3]];
      if (orientation(p, q, r, from) * orientation(p, q, r, to) >= 0) continue;
      const int first = orientation(from, to, p, q);
      if (first != 0 && first == orientation(from, to, q, r) && first == orientation(from, to, r, p)) return true;
    }
    return false;
  };
  return goesThrough(a, b) || goesThrough(b, a);
}

struct SeamFaults {
  size_t triangles = 0, in_seams = 0;
  size_t degenerate = 0;  ///< triangles with two corners at the same position, unless these belong to different levels
                          ///< of a seam
  size_t cuts = 0;        ///< pairs of triangles that intersect, in the bodies of one level
  size_t pierced = 0;     ///< pairs of triangles that pierce each other, anywhere

  bool any() const { return degenerate + cuts + pierced > 0; }
};

size_t degenerateOf(const MeshPart& part) {
  size_t count = 0;
  for (size_t i = 0; i < part.indices.size(); i += 3) {
    bool bad = false;
    for (size_t k = 0; k < 3; ++k) {
      const Vertex &a = part.vertices[part.indices[i + k]], &b = part.vertices[part.indices[i + (k + 1) % 3]];
      bad |= a.x == b.x && a.y == b.y && a.z == b.z && !maySharePlace(a.kind, b.kind);
    }
    count += bad;
  }
  return count;
}

SeamFaults seamFaultsOf(const std::pmr::vector<PlacedChunk>& chunks, JobSystem& jobs) {
  std::vector<PlacedPart> parts;
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, parts);
  SeamFaults faults;
  std::map<int, std::vector<PlacedPart>> bodies;
  for (const PlacedPart& part : parts) {
    faults.degenerate += degenerateOf(*part.mesh);
    (part.number > 0 ? faults.in_seams : faults.triangles) += part.mesh->indices.size() / 3;
    if (part.number == 0) bodies[part.grid.level].push_back(part);
  }
  for (const auto& [level, of_level] : bodies) {
    const asset::TriangleMesh mesh = measure::trianglesOf(*weld(of_level, {}));
    const auto crossing = measure::selfIntersections(
        {mesh.points, mesh.triangles}, measure::Bvh({mesh.points, mesh.triangles}, jobs), uint64_t{1} << 40, jobs);
    faults.cuts += crossing.pairs;
  }
  const asset::TriangleMesh mesh = measure::trianglesOf(*weld(parts, {}));
  forPairs({mesh.points, mesh.triangles}, jobs, [&](uint32_t a, uint32_t b) {
    faults.pierced += pierce(mesh.points, mesh.triangles[a], mesh.triangles[b]);
  });
  return faults;
}

void checkTrees(bool sharp) {
  const ReportContext shop;
  size_t good = 0, seen = 0;
  SeamFaults all;
  for (unsigned seed = 1; seed <= solidsWanted(); ++seed) {
    std::mt19937 random(seed);
    const std::string text = randomSolid(random);
    const double cell = kSolidCells[seed % 2];
    const WorldField world(worldOf(compiled(text), cell, 1), std::pmr::get_default_resource());
    std::vector<ChunkRequest> requests = frameRequests(randomTree(random, world.settings().finest_cell));
    for (ChunkRequest& request : requests) request.sharp = sharp;
    const auto chunks = meshChunks(world, *shop.backend, *shop.jobs, requests);
    REQUIRE(chunks);
    std::vector<const MeshPart*> parts;
    for (const PlacedChunk& chunk : *chunks) {
      parts.push_back(&chunk.mesh.body);
      for (const MeshPart& seam : chunk.mesh.seams) parts.push_back(&seam);
    }
    const MeshReport report = checkParts(parts);
    const SeamFaults faults = seamFaultsOf(*chunks, *shop.jobs);
    CAPTURE(seed, cell, sharp, text);
    INFO(describe(report));
    INFO(faults.degenerate << " degenerate, " << faults.cuts << " cuts in bodies, " << faults.pierced << " pierced");
    CHECK(report.closed());
    CHECK(faults.degenerate == 0);
    CHECK(faults.cuts == 0);
    CHECK(faults.pierced == 0);
    ++seen;
    good += report.closed() && !faults.any();
    all.triangles += faults.triangles;
    all.in_seams += faults.in_seams;
    all.degenerate += faults.degenerate;
    all.cuts += faults.cuts;
    all.pierced += faults.pierced;
  }
  std::printf(
      "%s octrees: %zu of %zu good; %zu triangles in bodies, %zu in seams, %zu degenerate, %zu cuts, %zu pierced\n",
      sharp ? "sharp" : "plain", good, seen, all.triangles, all.in_seams, all.degenerate, all.cuts, all.pierced);
  CHECK(all.in_seams > 50 * seen);
}

}  // namespace

TEST_CASE("random solids are valid as marching cubes make them", "[validity][solids][plain][costly]") {
  checkSolids(false);
}

TEST_CASE("random solids are valid with sharp features", "[validity][solids][sharp][costly]") { checkSolids(true); }

TEST_CASE("a speck that an edge grows round stays outside of the solid", "[validity][solids][sharp]") {
  // With this seed, a sample next to an edge of the solid touches the surface. The mesh has a separate, closed surface
  // around that sample, 1/256 of a cell wide. In an earlier version, the sharp edge, which is exact only to 1/25
  // of a cell, enclosed this small surface.
  const ReportContext shop;
  std::mt19937 random(312);
  const WorldField world(worldOf(compiled(randomSolid(random)), 0.5, 1), std::pmr::get_default_resource());
  const Faults faults = faultsOf(meshedRegion(world, shop, kAll, true).mesh, nullptr, *shop.jobs);
  INFO(faults);
  CHECK(faults.valid);
}

TEST_CASE("octrees of random solids are closed, and nothing pierces anything", "[validity][octrees][plain][costly]") {
  checkTrees(false);
}

TEST_CASE("octrees of random solids are closed with sharp features, and nothing pierces anything",
          "[validity][octrees][sharp][costly]") {
  checkTrees(true);
}
