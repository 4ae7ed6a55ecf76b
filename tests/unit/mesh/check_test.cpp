// Tests that checkMesh finds every fault of a mesh.

#include "mesh/check.h"

#include <algorithm>

#include "catch.h"
#include "octree.h"

using namespace sgm;
using namespace sgm::test;

namespace {

using Triangles = std::vector<uint32_t>;

const Triangles kTetrahedron{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

Triangles joined(const Triangles& a, Triangles b, uint32_t shift) {
  for (uint32_t& i : b) i += shift;
  b.insert(b.begin(), a.begin(), a.end());
  return b;
}

}  // namespace

TEST_CASE("a closed mesh passes", "[mesh][check]") {
  const MeshReport report = checkTriangles(kTetrahedron, 4);
  CHECK(report.closed());
  CHECK(report.triangles == 4);
  CHECK(report.vertices == 4);
  CHECK(report.edges == 6);
  CHECK(describe(report) == "4 triangles, 4 vertices, 6 edges");
  CHECK(checkTriangles({}, 0).closed());
  CHECK(describe({}) == "no triangles");
}

TEST_CASE("an open mesh is a manifold with a border", "[mesh][check]") {
  const MeshReport report = checkTriangles(std::span(kTetrahedron).first(9), 4);
  CHECK(report.manifold());
  CHECK(!report.closed());
  CHECK(report.open_edges == 3);
  CHECK(report.unmatched_edges == 3);
  CHECK(report.border_vertices == 3);
}

TEST_CASE("a flipped triangle, a repeated one and a degenerate one are seen", "[mesh][check]") {
  Triangles flipped = kTetrahedron;
  std::swap(flipped[0], flipped[1]);
  MeshReport report = checkTriangles(flipped, 4);
  CHECK(!report.manifold());
  CHECK(report.unmatched_edges == 3);
  CHECK(report.repeated_edges == 3);
  CHECK(report.open_edges == 0);
  CHECK(report.pinched_vertices == 3);

  Triangles repeated = kTetrahedron;
  repeated.insert(repeated.end(), {2, 1, 0});
  report = checkTriangles(repeated, 4);
  CHECK(report.duplicate_triangles == 1);
  CHECK(report.non_manifold_edges == 3);
  CHECK(!report.manifold());

  Triangles mirrored = kTetrahedron;
  mirrored.insert(mirrored.end(), {1, 2, 0});
  CHECK(checkTriangles(mirrored, 4).duplicate_triangles == 1);

  Triangles degenerate = kTetrahedron;
  degenerate.insert(degenerate.end(), {3, 1, 1});
  report = checkTriangles(degenerate, 4);
  CHECK(report.degenerate_triangles == 1);
  CHECK(report.edges == 6);
  CHECK(!report.manifold());
}

TEST_CASE("two bodies that share a vertex are pinched there, though every edge is matched", "[mesh][check]") {
  const MeshReport report = checkTriangles(joined(kTetrahedron, kTetrahedron, 3), 7);
  CHECK(report.unmatched_edges == 0);
  CHECK(report.pinched_vertices == 1);
  CHECK(!report.closed());
  CHECK(checkTriangles(joined(kTetrahedron, kTetrahedron, 4), 8).closed());
  // Two open triangles that share one border vertex, so that the border at this vertex consists of two paths.
  CHECK(checkTriangles(Triangles{0, 1, 2, 0, 3, 4}, 5).pinched_vertices == 1);
}

TEST_CASE("a missing seam, a missing triangle and a merged fan are seen in a world", "[mesh][check]") {
  const Octree octree(4, 2, 2);
  const LatticeField field = [&](Int3 p, int level) -> int32_t {
    const auto outside = [](int32_t x) { return x <= 54 || x >= 74; };
    if (outside(p.x) || p.y <= 20 || p.y >= 108 || outside(p.z)) return 5;
    return randomQ(pointHash(static_cast<uint64_t>(level), p), 0.5);
  };
  std::vector<LeafMesh> meshes = meshOctree(octree, field);
  CHECK(checkParts(allParts(meshes)).closed());

  size_t seams = 0;
  for (LeafMesh& mesh : meshes) {
    for (auto& [face, seam] : mesh.seams) {
      if (seam.indices.empty() || ++seams > 6) continue;
      std::vector<const MeshPart*> parts = allParts(meshes);
      std::erase(parts, &seam);
      CHECK(checkParts(parts).open_edges > 0);

      std::swap(seam.indices[0], seam.indices[1]);
      CHECK(checkParts(allParts(meshes)).repeated_edges > 0);
      std::swap(seam.indices[0], seam.indices[1]);

      const std::vector<uint32_t> last(seam.indices.end() - 3, seam.indices.end());
      seam.indices.resize(seam.indices.size() - 3);
      const MeshReport report = checkParts(allParts(meshes));
      CHECK(report.open_edges + report.unmatched_edges > 0);
      seam.indices.insert(seam.indices.end(), last.begin(), last.end());
    }
  }
  CHECK(seams > 6);
  CHECK(checkParts(allParts(meshes)).closed());

  // If the keys of seam vertices named only the corner, two cycles of seam cells that meet in a corner would share a
  // vertex.
  size_t merged = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const Octree other(seed + 20, 2, 2);
    std::vector<LeafMesh> copies = meshOctree(other, field);
    for (LeafMesh& mesh : copies)
      for (auto& [face, seam] : mesh.seams)
        for (VertexKey& key : seam.keys) key.fan = 0;
    merged += !checkParts(allParts(copies)).closed();
  }
  CHECK(merged > 0);
}
