// Tests bodies and seams together: for any signs of the samples, the surface is closed and edge-manifold, with one
// cycle of triangles around every vertex.

#include "octree.h"

#include <cstring>
#include <map>

#include "catch.h"
#include "mesh/check.h"
#include "mesh/vertex.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

int32_t distanceToChunkFace(int32_t x) {
  const int32_t r = x & (kChunkCells - 1);
  return std::min(r, kChunkCells - r);
}

/// Random values in blocks along the edges of chunks, where up to four chunks of different levels meet; void elsewhere
/// and at the border of the world.
LatticeField edgeNoise(uint64_t seed, double density, int32_t size, bool same_field) {
  return [=](Int3 p, int level) -> int32_t {
    const auto outside = [&](int32_t x) { return x <= 0 || x >= size; };
    if (outside(p.x) || outside(p.y) || outside(p.z)) return 1000;
    const int near =
        (distanceToChunkFace(p.x) <= 4) + (distanceToChunkFace(p.y) <= 4) + (distanceToChunkFace(p.z) <= 4);
    if (near < 2) return 1000;
    const auto block = [](int32_t x) { return (x + 8) / 16; };
    if (pointHash(seed + 1, {block(p.x), block(p.y), block(p.z)}) % 100 >= 35) return 1000;
    return randomQ(pointHash(same_field ? seed : hashCombine(seed, static_cast<uint64_t>(level)), p), density);
  };
}

}  // namespace

TEST_CASE("random octrees with random signs are closed", "[mesh][octree]") {
  constexpr double kDensities[] = {.5, .3, .7, .1, .9};
  size_t triangles = 0, in_seams = 0;
  for (const bool same_field : {true, false}) {
    for (uint64_t seed = 0; seed < rounds(5); ++seed) {
      const Octree octree(seed, 2, 3);
      const LatticeField field = edgeNoise(seed, kDensities[seed % 5], octree.size(), same_field);
      const std::vector<LeafMesh> meshes = meshOctree(octree, field);
      const MeshReport report = checkParts(allParts(meshes));
      INFO("seed " << seed << (same_field ? ", one field: " : ", fields differ by level: ") << describe(report));
      CHECK(report.closed());
      triangles += report.triangles;
      for (const LeafMesh& mesh : meshes)
        for (const auto& [face, seam] : mesh.seams) in_seams += seam.indices.size() / 3;
    }
  }
  CHECK(triangles > 100'000 * rounds(5));
  CHECK(in_seams > 5'000 * rounds(5));
}

TEST_CASE("every way in which eight octants meet in a corner is closed", "[mesh][octree]") {
  // Each of the eight octants around the corner (64, 64, 64) is either a chunk of level 1, or contains only the chunk
  // of level 0 that touches the corner. All other space is void.
  const auto meets = [](unsigned coarser) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      for (int low : {0, 1 << axis}) {
        const auto is = [&](int o) { return (coarser >> (low | o) & 1) != 0; };
        if (is(0) == is(u | v) && is(u) == is(v) && is(0) != is(u)) return false;
      }
    }
    return true;
  };
  size_t masks = 0, triangles = 0;
  for (unsigned coarser = 0; coarser < 256; ++coarser) {
    if (!meets(coarser)) continue;
    ++masks;
    for (const bool same_field : {true, false}) {
      const LatticeField field = [&](Int3 p, int level) -> int32_t {
        const auto far = [](int32_t x) { return std::abs(x - 64) > 5; };
        if (far(p.x) || far(p.y) || far(p.z)) return 7;
        return randomQ(pointHash(same_field ? coarser : hashCombine(coarser, static_cast<uint64_t>(level)), p),
                       0.2 + 0.1 * (coarser % 7));
      };
      std::vector<LeafMesh> meshes;
      for (int o = 0; o < 8; ++o) {
        const bool coarse = (coarser >> o & 1) != 0;
        const auto low = [&](int axis) { return (o >> axis & 1) != 0 ? 64 : coarse ? 0 : 32; };
        Neighbourhood around = 0;
        if (!coarse) {
          // i numbers the 27 blocks in and around the chunk. Along each axis, a step towards the corner leads into the
          // neighbouring octant; any other step stays in the chunk's own octant.
          for (int i = 0; i < 27; ++i) {
            const std::array<int, 3> offset{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            int octant = o;
            for (int axis = 0; axis < 3; ++axis)
              if (offset[static_cast<size_t>(axis)] == ((o >> axis & 1) != 0 ? -1 : 1)) octant ^= 1 << axis;
            if ((coarser >> octant & 1) != 0) around |= 1u << i;
          }
        }
        meshes.push_back(meshLeaf({{low(0), low(1), low(2)}, coarse ? 1 : 0}, around, field));
      }
      const MeshReport report = checkParts(allParts(meshes));
      triangles += report.triangles;
      INFO("coarser octants " << coarser << (same_field ? ", one field: " : ", fields differ by level: ")
                              << describe(report));
      REQUIRE(report.closed());
    }
  }
  CHECK(masks > 100);
  CHECK(triangles > 100000);
}

TEST_CASE("copies of a vertex in different parts lie in one place, to the bit", "[mesh][octree]") {
  const Octree octree(3, 2, 3);
  const std::vector<LeafMesh> meshes = meshOctree(octree, edgeNoise(3, 0.5, octree.size(), true));
  std::map<VertexKey, std::array<int64_t, 3>> exact;
  std::map<VertexKey, Int3> rounded;
  size_t copies = 0, moved = 0;
  const auto visit = [&](const MeshPart& part, const ChunkGrid& grid) {
    for (size_t i = 0; i < part.vertices.size(); ++i) {
      const Vertex& v = part.vertices[i];
      const auto place = [&](int32_t origin, int16_t local) {
        return int64_t{origin} * kSubcell + int64_t{local} * grid.cell;
      };
      const std::array<int64_t, 3> at{place(grid.origin.x, v.x), place(grid.origin.y, v.y), place(grid.origin.z, v.z)};
      const auto [first, is_new] = exact.try_emplace(part.keys[i], at);
      copies += !is_new;
      moved += first->second != at;
      const Int3 units = vertexUnits(grid, v);
      moved += rounded.try_emplace(part.keys[i], units).first->second != units;
      for (int axis = 0; axis < 3; ++axis) {
        const int64_t a = at[static_cast<size_t>(axis)] + kSubcell / 2;
        moved += units[axis] != static_cast<int32_t>(a >> 8);
      }
    }
  };
  for (const LeafMesh& mesh : meshes) {
    visit(mesh.body, mesh.grid);
    for (const auto& [face, seam] : mesh.seams) visit(seam, mesh.grid);
  }
  CHECK(moved == 0);
  CHECK(copies > 1000);
}

TEST_CASE("a seam's content is a function of chunk and face, not of what is around", "[mesh][octree]") {
  const ChunkGrid grid = latticeChunk({64, 0, 32}, 0);
  const LatticeField field = [](Int3 p, int level) { return randomQ(pointHash(static_cast<uint64_t>(level), p), 0.5); };
  const ChunkSamples samples = sampleChunk(field, grid);
  int with_other_fans = 0;
  for (int f = 0; f < 6; ++f) {
    const auto face = static_cast<Face>(f);
    const CoarseFace coarse = sampleFace(field, grid, face);
    MeshPart first, second;
    polygonizeSeam(face, samples, coarse, grid, neighbourBit(face), first);
    polygonizeSeam(face, samples, coarse, grid, (Neighbourhood{1} << 27) - 1, second);
    CHECK((first.indices == second.indices));
    CHECK(std::memcmp(first.vertices.data(), second.vertices.data(), first.vertices.size() * sizeof(Vertex)) == 0);
    with_other_fans += first.keys != second.keys;
    CHECK(first.indices.size() > 3000);
  }
  CHECK(with_other_fans > 0);
}

TEST_CASE("a seam between equal fields that cross nothing of the face is empty", "[mesh][octree]") {
  const LatticeField field = [](Int3 p, int) { return p.x == 16 && p.y == 16 && p.z == 16 ? -5 : 5; };
  const LeafMesh mesh = meshLeaf({{0, 0, 0}, 0}, (Neighbourhood{1} << 27) - 1, field);
  CHECK(mesh.body.indices.size() == 8 * 3);
  for (const auto& [face, seam] : mesh.seams) CHECK(seam.vertices.empty());
}
