// Tests welding by vertex keys.

#include "mesh/weld.h"

#include <algorithm>
#include <map>

#include "catch.h"
#include "mesh/check.h"
#include "octree.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// Sets attributes as a backend would: as a function of the vertex's key.
void fillAttributes(MeshPart& part) {
  for (size_t i = 0; i < part.vertices.size(); ++i) {
    const VertexKey& k = part.keys[i];
    const uint64_t h = pointHash(static_cast<uint64_t>(k.axis) << 8 | k.level, k.corner);
    Vertex& v = part.vertices[i];
    v.material = static_cast<uint16_t>(h & 3);
    v.tag = static_cast<uint16_t>(h >> 2 & 7);
    v.normal_x = static_cast<int16_t>(h >> 16 & 0x3FFF);
    v.normal_y = static_cast<int16_t>(h >> 32 & 0x3FFF);
  }
  hashPart(part);
}

std::vector<PlacedPart> placed(std::vector<LeafMesh>& meshes) {
  std::vector<PlacedPart> parts;
  for (LeafMesh& mesh : meshes) {
    fillAttributes(mesh.body);
    parts.push_back({&mesh.body, mesh.grid, 0});
    for (auto& [face, seam] : mesh.seams) {
      fillAttributes(seam);
      parts.push_back({&seam, mesh.grid, 1 + static_cast<int>(face)});
    }
  }
  return parts;
}

LatticeField blobNoise(int32_t size) {
  return [size](Int3 p, int level) -> int32_t {
    const auto outside = [&](int32_t x) { return x <= 20 || x >= size - 20; };
    if (outside(p.x) || outside(p.y) || outside(p.z)) return 5;
    return randomQ(pointHash(static_cast<uint64_t>(level) + 7, p), 0.3);
  };
}

}  // namespace

TEST_CASE("welding makes one closed mesh, in any order of the parts", "[mesh][weld]") {
  const Octree octree(1, 2, 2);
  std::vector<LeafMesh> meshes = meshOctree(octree, blobNoise(octree.size()));
  std::vector<PlacedPart> parts = placed(meshes);
  const Int3 origin{13, -77, 1024};
  const Result<WorldMesh> first = weld(parts, origin);
  REQUIRE(first);
  CHECK(checkTriangles(first->indices, first->positions.size()).closed());
  const MeshReport by_keys = checkParts(allParts(meshes));
  CHECK(first->positions.size() == by_keys.vertices);
  CHECK(first->indices.size() == by_keys.triangles * 3);
  CHECK(first->positions.size() == first->keys.size());
  CHECK(first->positions.size() == first->attributes.size());

  const ContentHash region = hashParts(parts);
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    for (size_t i = parts.size(); i-- > 1;) std::swap(parts[i], parts[hashCombine(seed, i) % (i + 1)]);
    const Result<WorldMesh> other = weld(parts, origin);
    REQUIRE(other);
    CHECK(hashMesh(*other) == hashMesh(*first));
    CHECK((other->indices == first->indices));
    CHECK((other->keys == first->keys));
    CHECK((other->attributes == first->attributes));
    CHECK(hashParts(parts) == region);
  }
  parts.pop_back();
  CHECK(hashParts(parts) != region);
}

TEST_CASE("welded positions are exact, near and far", "[mesh][weld]") {
  for (const int32_t far : {0, 2000000000}) {
    const ChunkGrid grid{{far, -far, 512}, 512, 0};
    const ChunkSamples samples =
        sampleChunk([](Int3 p, int) { return randomQ(pointHash(1, p), 0.1); }, latticeChunk({}, 0));
    MeshPart part;
    polygonizeBody(samples, grid, part);
    const PlacedPart parts[] = {{&part, grid, 0}};
    const Int3 origin{far + 1024, -far, 0};
    const Result<WorldMesh> mesh = weld(parts, origin);
    REQUIRE(mesh);
    REQUIRE(mesh->positions.size() == part.vertices.size());
    size_t bad = 0;
    for (size_t i = 0; i < part.vertices.size(); ++i) {
      const Vertex& v = part.vertices[i];
      const std::array<double, 3>& p = mesh->positions[i];
      bad += p[0] != v.x / 512.0 - 1 || p[1] != v.y / 512.0 || p[2] != v.z / 512.0 + 0.5;
    }
    CHECK(bad == 0);
  }
}

TEST_CASE("a region's open edges lie in its border alone", "[mesh][weld]") {
  std::vector<MeshPart> bodies(8);
  std::vector<PlacedPart> parts;
  for (int i = 0; i < 8; ++i) {
    const ChunkGrid grid = latticeChunk({(i & 1) * 32, (i >> 1 & 1) * 32, (i >> 2) * 32}, 0);
    MeshPart& body = bodies[static_cast<size_t>(i)];
    polygonizeBody(sampleChunk([](Int3 p, int) { return randomQ(pointHash(2, p), 0.4); }, grid), grid, body);
    parts.push_back({&body, grid, 0});
  }
  const Result<WorldMesh> mesh = weld(parts, {});
  REQUIRE(mesh);
  const MeshReport report = checkTriangles(mesh->indices, mesh->positions.size());
  CHECK(report.manifold());
  CHECK(report.open_edges > 0);
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (size_t i = 0; i < mesh->indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh->indices[i + k], mesh->indices[i + (k + 1) % 3]);
      ++uses[{a, b}];
    }
  }
  size_t inside = 0;
  const double end = 64.0 * kSpacing / kUnitsPerMetre;
  for (const auto& [edge, times] : uses) {
    if (times != 1) continue;
    const auto& a = mesh->positions[edge.first];
    const auto& b = mesh->positions[edge.second];
    bool border = false;
    for (size_t axis = 0; axis < 3; ++axis)
      border |= (a[axis] == 0 && b[axis] == 0) || (a[axis] == end && b[axis] == end);
    inside += !border;
  }
  CHECK(inside == 0);
}

TEST_CASE("nothing welds to an empty mesh", "[mesh][weld]") {
  const Result<WorldMesh> mesh = weld({}, {1, 2, 3});
  REQUIRE(mesh);
  CHECK(mesh->positions.empty());
  CHECK(mesh->origin == Int3{1, 2, 3});
  CHECK(hashParts({}) == ContentHash{});
}
