#include "tools/flight/checked_chunk.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "mesh/triangle_faults.h"

namespace sgm::cli {
namespace {

bool samePlace(const VertexPlace& a, const VertexPlace& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

template <class T>
T elementAt(const T* first, uint32_t stride, uint32_t i) {
  T element;
  std::memcpy(&element, reinterpret_cast<const char*>(first) + size_t{stride} * i, sizeof element);
  return element;
}

}  // namespace

ChunkKey keyOf(const sgm_chunk_key& key) { return {key.level, {key.x, key.y, key.z}}; }

Error malformed(const ChunkKey& key, const std::string& what) {
  return {Code::invalid_argument, "the mesh of chunk " + std::to_string(key.at.x) + "," + std::to_string(key.at.y) +
                                      "," + std::to_string(key.at.z) + " of level " + std::to_string(key.level) + " " +
                                      what};
}

Result<CheckedChunk> copyChunk(const sgm_mesh_view& mesh) {
  const ChunkKey key = keyOf(mesh.key);
  if (key.level < 0 || key.level > kMaxLevel) return malformed(key, "has a level out of range");
  CheckedChunk chunk;
  chunk.grid = {{mesh.origin[0], mesh.origin[1], mesh.origin[2]}, mesh.cell_units, key.level};
  for (size_t number = 0; number < chunk.parts.size(); ++number) {
    const sgm_mesh_range& range = number == 0 ? mesh.body : mesh.seams[number - 1];
    CheckedPart& part = chunk.parts[number];
    if (uint64_t{range.first_vertex} + range.vertex_count > mesh.vertex_count ||
        uint64_t{range.first_index} + range.index_count > mesh.index_count || range.index_count % 3 != 0)
      return malformed(key, "has a range beyond its arrays");
    const SeamOf seam = seamOf({}, number);
    part.vertices.reserve(range.vertex_count);
    for (uint32_t i = 0; i < range.vertex_count; ++i) {
      const sgm_vertex v = elementAt(mesh.vertices, mesh.vertex_stride, range.first_vertex + i);
      part.vertices.push_back({v.x, v.y, v.z, v.kind});
      if (!vertexKey(chunk.grid, part.vertices.back(), number == 0 ? nullptr : &seam))
        return malformed(key, "has a vertex without a key: " + std::to_string(range.first_vertex + i));
    }
    part.indices.reserve(range.index_count);
    for (uint32_t i = 0; i < range.index_count; ++i) {
      const uint32_t index = elementAt(mesh.indices, mesh.index_stride, range.first_index + i);
      if (index < range.first_vertex || index - range.first_vertex >= range.vertex_count)
        return malformed(key, "has an index outside of its range: number " + std::to_string(range.first_index + i));
      part.indices.push_back(index - range.first_vertex);
    }
  }
  return chunk;
}

SeamOf seamOf(const DrawnParts& drawn, size_t number) {
  if (number == 0) return {};
  const auto face = static_cast<Face>(number - 1);
  return {face, seamFans(face, drawn.coarser | neighboursAcross(static_cast<uint8_t>(drawn.seams)))};
}

void numberByEdge(const CheckedPart& part, std::vector<uint32_t>& first) {
  std::vector<std::pair<uint64_t, uint32_t>> edges;  // for each vertex: key of its grid edge within the chunk, and the
                                                     // vertex number
  edges.reserve(part.vertices.size());
  for (const VertexPlace& v : part.vertices) {
    const auto number = static_cast<uint32_t>(edges.size());
    const auto word = [](int16_t at) { return uint64_t{static_cast<uint16_t>(at)}; };
    if (isFeature(v)) {
      edges.push_back({word(v.x) << 48 | word(v.y) << 32 | word(v.z) << 16 | v.kind, number});
      continue;
    }
    const uint64_t axis = v.x % kSubcell != 0 ? 0 : v.y % kSubcell != 0 ? 1 : 2;
    const uint64_t cell = (word(v.x) / kSubcell << 16) | (word(v.y) / kSubcell << 8) | word(v.z) / kSubcell;
    // The low 16 bits of this key are 0. In the key of a feature vertex they are not 0, so the two kinds of keys never
    // coincide.
    edges.push_back({(cell << 2 | axis) << 16, number});
  }
  std::sort(edges.begin(), edges.end());
  first.resize(edges.size());
  for (size_t i = 0, lowest = 0; i < edges.size(); ++i) {
    if (edges[i].first != edges[lowest].first) lowest = i;
    first[edges[i].second] = edges[lowest].second;
  }
}

TriangleCounts countTriangles(const CheckedPart& part, size_t number, std::span<const uint32_t> ids,
                              PairScratch& scratch) {
  TriangleCounts counts;
  std::vector<PairCorner> corners;
  if (number == 0) corners.reserve(part.indices.size());
  for (size_t i = 0; i < part.indices.size(); i += 3) {
    const std::array<uint32_t, 3> t{part.indices[i], part.indices[i + 1], part.indices[i + 2]};
    bool degenerate = false;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      const VertexPlace &p = part.vertices[a], &q = part.vertices[b];
      degenerate |= ids[a] == ids[b] || (samePlace(p, q) && !(number > 0 && maySharePlace(p.kind, q.kind)));
    }
    counts.degenerate += degenerate;
    if (number > 0 || degenerate) continue;
    std::array<Int3, 3> places{};
    for (size_t k = 0; k < 3; ++k) places[k] = {part.vertices[t[k]].x, part.vertices[t[k]].y, part.vertices[t[k]].z};
    if (IntegerSigns::seenAlong(places) < 0) {
      ++counts.flat;
      continue;
    }
    for (const uint32_t v : t) {
      const VertexPlace& p = part.vertices[v];
      corners.push_back({p.x, p.y, p.z, p.kind});
    }
  }
  counts.pairs = countPairs(corners, scratch);
  return counts;
}

}  // namespace sgm::cli
