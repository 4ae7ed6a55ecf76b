// Tests ambiguous faces: parts thinner than the diagonal of a cell's face stay connected, and meshes stay valid.

#include "mesh/ambiguous_faces.h"

#include <cstdio>
#include <map>
#include <numeric>
#include <set>

#include "catch.h"
#include "mesh/body_pairs.h"
#include "mesh/border_vertices.h"
#include "rounds.h"
#include "solid_fields.h"

using namespace sgm;
using namespace sgm::test;

namespace {

constexpr ChunkGrid kChunk{{0, 0, 0}, kCell, 0};

/// The solid between two parallel planes.
struct Slab : Field {
  Vector3 normal, middle;
  double half;

  Slab(uint64_t seed, double thickness) : half(thickness / 2 * kCell) {
    const PathKey key{seed};
    normal = randomDirection(key, 10);
    for (size_t k = 0; k < 3; ++k) middle[k] = (16 + 4 * key.unit(k)) * kCell;
  }
  double at(const Vector3& p, Vector3& gradient) const override {
    const double along = dot(minus(p, middle), normal);
    for (size_t k = 0; k < 3; ++k) gradient[k] = along < 0 ? -normal[k] : normal[k];
    return std::fabs(along) - half;
  }
};

MeshPart resolved(const Field& field, MeshPart body) {
  const FieldSampler sampler = samplerOf(field);
  Creases creases(kChunk, sampler, body, std::pmr::get_default_resource());
  creases.settle();
  const BodyLoops loops(kChunk, body, std::pmr::get_default_resource());
  const auto border = borderSides(loops, creases, sampler, std::pmr::get_default_resource());
  if (auto indices = resolveAmbiguousFaces(loops, creases, border, sampler, std::pmr::get_default_resource()))
    body.indices = std::move(*indices);
  return body;
}

/// Number of connected parts of the surface.
size_t partsOf(const MeshPart& body) {
  std::vector<uint32_t> above(body.vertices.size());
  std::iota(above.begin(), above.end(), 0);
  const auto of = [&](uint32_t v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
  };
  size_t parts = above.size();
  for (size_t i = 0; i < body.indices.size(); ++i) {
    const uint32_t a = of(body.indices[i]), b = of(body.indices[i / 3 * 3]);
    if (a != b) --parts, above[a] = b;
  }
  return parts;
}

/// Number of invalid edges of a surface: edges that are used twice in one direction, or that are open inside the chunk.
size_t badEdges(const MeshPart& body) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (size_t t = 0; t < body.indices.size(); t += 3)
    for (size_t k = 0; k < 3; ++k) ++edges[{body.indices[t + k], body.indices[t + (k + 1) % 3]}];
  const auto inFace = [&](const Vertex& a, const Vertex& b) {
    const auto both = [](int p, int q) { return p == q && (p == 0 || p == kChunkCells * kSubcell); };
    return both(a.x, b.x) || both(a.y, b.y) || both(a.z, b.z);
  };
  size_t bad = 0;
  for (const auto& [edge, count] : edges) {
    const bool is_open = !edges.contains({edge.second, edge.first});
    bad += count != 1 || (is_open && !inFace(body.vertices[edge.first], body.vertices[edge.second]));
  }
  return bad;
}

PairCounts pairsOf(const MeshPart& body) {
  std::vector<PairCorner> corners;
  for (const uint32_t v : body.indices) {
    const Vertex& at = body.vertices[v];
    corners.push_back({at.x, at.y, at.z, at.kind});
  }
  PairScratch scratch(std::pmr::get_default_resource());
  return countPairs(corners, scratch);
}

size_t trianglesWithoutArea(const MeshPart& body) {
  size_t count = 0;
  for (size_t t = 0; t < body.indices.size(); t += 3) {
    const auto at = [&](size_t k) {
      const Vertex& v = body.vertices[body.indices[t + k]];
      return Vector3{1.0 * v.x, 1.0 * v.y, 1.0 * v.z};
    };
    const Vector3 area = sgm::cross(minus(at(1), at(0)), minus(at(2), at(0)));
    count += dot(area, area) == 0;
  }
  return count;
}

}  // namespace

TEST_CASE("slabs thinner than a face's diagonal have fewer parts, and stay closed", "[mesh][sharpen]") {
  size_t before = 0, after = 0, changed = 0;
  for (uint64_t seed = 1; seed <= rounds(60); ++seed) {
    const double thickness = 0.1 + 1.1 * PathKey{seed}.unit(99);
    CAPTURE(seed, thickness);
    const Slab slab(seed, thickness);
    const MeshPart plain = meshChunk(slab, kChunk);
    const MeshPart joined = resolved(slab, plain);
    CHECK(joined.vertices.size() == plain.vertices.size());
    CHECK(badEdges(joined) == 0);
    CHECK(pairsOf(joined) == PairCounts{});
    CHECK(trianglesWithoutArea(joined) == 0);
    before += partsOf(plain);
    after += partsOf(joined);
    changed += !std::equal(joined.indices.begin(), joined.indices.end(), plain.indices.begin(), plain.indices.end());
  }
  std::printf("slabs: %zu parts as meshed, %zu joined\n", before, after);
  CHECK(changed * 4 > rounds(60));
  CHECK(after * 2 < before);
}

TEST_CASE("surfaces without creases keep their triangles", "[mesh][sharpen]") {
  const Sphere ball(9.3 * kCell, {16.0 * kCell + 17, 16.0 * kCell - 5, 16.0 * kCell + 60});
  const MeshPart plain = meshChunk(ball, kChunk);
  const MeshPart joined = resolved(ball, plain);
  CHECK(std::equal(joined.indices.begin(), joined.indices.end(), plain.indices.begin(), plain.indices.end()));
}

TEST_CASE("faces of the chunk stay as they are meshed", "[mesh][sharpen]") {
  // Chunks that are meshed independently agree on their common faces.
  for (uint64_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    const Slab slab(seed, 0.5);
    const MeshPart plain = meshChunk(slab, kChunk);
    const auto openEdges = [](const MeshPart& body) {
      std::set<std::pair<uint32_t, uint32_t>> all, open;
      for (size_t t = 0; t < body.indices.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) all.insert({body.indices[t + k], body.indices[t + (k + 1) % 3]});
      for (const auto& [a, b] : all)
        if (!all.contains({b, a})) open.insert({a, b});
      return open;
    };
    CHECK(openEdges(resolved(slab, plain)) == openEdges(plain));
  }
}
