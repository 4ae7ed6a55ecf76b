// Damages chunks in every way, and tests that each defect is found and classified correctly.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "measured_chunks.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::measure;

namespace {

using Body = MeshPart;
uint32_t any(std::mt19937& random, size_t count) { return static_cast<uint32_t>(random() % count); }

/// Merges two vertices of the body that are far apart: they have no common neighbour.
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

/// Moves a vertex to the midpoint of two others. If a coordinate of the midpoint is not an integer, first moves `from`
/// by one step along that axis.
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
  // Picks a random triangle with a corner inside the chunk: in the chunk's border, an edge with one triangle is normal.
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
         // Picks a triangle whose middle lies well inside the chunk.
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
           // The loop's condition rejects triangles whose middle is near the chunk's border. Slivers and small
           // triangles are rejected by setting the middle to such a place.
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
