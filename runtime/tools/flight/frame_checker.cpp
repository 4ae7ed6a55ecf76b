#include "tools/flight/frame_checker.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/hash.h"
#include "measure/bvh.h"
#include "measure/triangle_pair.h"

namespace sgm::cli {
namespace {

constexpr int kChunkEdge = kChunkCells * kSubcell;

ChunkKey keyOf(const sgm_chunk_key& key) { return {key.level, {key.x, key.y, key.z}}; }

bool isFeature(const VertexPlace& v) { return (v.kind & SGM_VERTEX_FEATURE) != 0; }

/// Whether the vertex lies on no face of its chunk, so that no other chunk can share it. Feature vertices (crisp edges)
/// may lie beside the face to which they belong, so they never count as inside.
bool isInside(const VertexPlace& v) {
  const auto inner = [](int16_t at) { return at != 0 && at != kChunkEdge; };
  return !isFeature(v) && inner(v.x) && inner(v.y) && inner(v.z);
}

/// The key of a feature vertex in a body, or in the seam over a face; nullopt if no such vertex exists there.
std::optional<VertexKey> featureKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam) {
  const bool of_cell = (vertex.kind >> 14 & 1) != 0, coarser = (vertex.kind >> 13 & 1) != 0;
  if (seam == nullptr ? coarser : of_cell) return {};
  const int step = (coarser ? 2 : 1) * kSubcell;
  const int32_t cell = grid.cell * (coarser ? 2 : 1);
  VertexKey key;
  key.level = static_cast<uint8_t>(grid.level + (coarser ? 1 : 0));
  key.axis = static_cast<uint8_t>(of_cell ? 7 : 4 + (vertex.kind >> 6 & 3));
  key.fan = static_cast<uint8_t>(of_cell ? vertex.kind >> 6 & 15 : vertex.kind >> 8 & 15);
  const std::array<int, 3> at{vertex.x, vertex.y, vertex.z};
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t corner = floorDiv(at[static_cast<size_t>(axis)], step) - ((vertex.kind >> 2 * axis & 3) - 1);
    if (corner < 0 || corner * step > kChunkEdge) return {};
    key.corner[axis] = saturate(grid.origin[axis] + corner * cell);
  }
  if (!of_cell && key.axis == 7) return {};
  if (seam == nullptr) return key;
  const int axis = faceAxis(seam->face);
  const int64_t plane = grid.origin[axis] + (faceIsHigh(seam->face) ? int64_t{kChunkCells} * grid.cell : 0);
  if (key.axis != 4 + axis || key.corner[axis] != plane) return {};
  return key;
}

Error malformed(const ChunkKey& key, const std::string& what) {
  return {Code::invalid_argument, "the mesh of chunk " + std::to_string(key.at.x) + "," + std::to_string(key.at.y) +
                                      "," + std::to_string(key.at.z) + " of level " + std::to_string(key.level) + " " +
                                      what};
}

/// Adds an edge to the counts, given the number of its uses in both directions.
template <class Counts>
void countUse(uint64_t forward, uint64_t backward, Counts& counts) {
  counts.edges += forward + backward > 0;
  counts.open += forward != backward;
  counts.nonmanifold += forward > 1 || backward > 1;
}

/// Calls use(from, to) with vertex indices for every edge of each triangle that has no repeated vertex.
template <class Use>
void forEachEdge(const std::vector<uint32_t>& indices, const std::vector<uint32_t>& ids, const Use& use) {
  for (size_t i = 0; i < indices.size(); i += 3) {
    const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
    if (ids[a] == ids[b] || ids[b] == ids[c] || ids[c] == ids[a]) continue;
    use(a, b);
    use(b, c);
    use(c, a);
  }
}

bool samePlace(const VertexPlace& a, const VertexPlace& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Runs jobs in the calling thread, because the runtime uses the other threads.
class NoThreads final : public JobSystem {
 public:
  unsigned concurrency() const override { return 1; }
  void submit(void (*function)(void*), void* argument, int) override { function(argument); }
  bool help() override { return false; }
};

template <class T>
T elementAt(const T* first, uint32_t stride, uint32_t i) {
  T element;
  std::memcpy(&element, reinterpret_cast<const char*>(first) + size_t{stride} * i, sizeof element);
  return element;
}

}  // namespace

std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam) {
  if (isFeature(vertex)) return featureKey(grid, vertex, seam);
  const std::array<int, 3> at{vertex.x, vertex.y, vertex.z};
  if (vertex.kind > SGM_VERTEX_LATERAL || (vertex.kind != SGM_VERTEX_OWN && seam == nullptr)) return {};
  const int step = vertex.kind == SGM_VERTEX_OWN ? kSubcell : 2 * kSubcell;
  VertexKey key;
  key.level = static_cast<uint8_t>(grid.level + (vertex.kind == SGM_VERTEX_COARSER ? 1 : 0));
  key.axis = kLateral;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int local = at[static_cast<size_t>(axis)];
    if (local < 0 || local > kChunkEdge) return {};
    if (local % step != 0) {
      key.axis = static_cast<uint8_t>(axis);
      ++axes;
    }
    key.corner[axis] = saturate(grid.origin[axis] + int64_t{local / step * (step / kSubcell)} * grid.cell);
  }
  if (axes != (vertex.kind == SGM_VERTEX_LATERAL ? 0 : 1)) return {};
  if (seam == nullptr) return key;
  const auto axis = static_cast<size_t>(faceAxis(seam->face));
  if (at[axis] != (faceIsHigh(seam->face) ? kChunkEdge : 0)) return {};
  if (vertex.kind != SGM_VERTEX_LATERAL) return key;
  const auto side = [](int local) { return local == 0 ? size_t{0} : local == kChunkEdge ? size_t{2} : size_t{1}; };
  key.fan = seam->fans[side(at[(axis + 2) % 3])][side(at[(axis + 1) % 3])];
  return key;
}

size_t FrameChecker::Hash::operator()(const VertexKey& key) const {
  const uint64_t xy = uint64_t{static_cast<uint32_t>(key.corner.x)} << 32 | static_cast<uint32_t>(key.corner.y);
  const uint64_t rest = uint64_t{static_cast<uint32_t>(key.corner.z)} << 32 | uint64_t{key.level} << 16 |
                        uint64_t{key.axis} << 8 | key.fan;
  return hashCombine(xy, rest);
}

size_t FrameChecker::Hash::operator()(const Edge& edge) const {
  return mix64(uint64_t{edge.first} << 32 | edge.second);
}

size_t FrameChecker::Hash::operator()(const ChunkKey& key) const {
  return operator()(VertexKey{key.at, static_cast<uint8_t>(key.level), 0, 0});
}

Result<FrameChecker::Chunk> FrameChecker::copyOf(const sgm_mesh_view& mesh) {
  const ChunkKey key = keyOf(mesh.key);
  if (key.level < 0 || key.level > kMaxLevel) return malformed(key, "has a level out of range");
  Chunk chunk;
  chunk.grid = {{mesh.origin[0], mesh.origin[1], mesh.origin[2]}, mesh.cell_units, key.level};
  for (size_t number = 0; number < chunk.parts.size(); ++number) {
    const sgm_mesh_range& range = number == 0 ? mesh.body : mesh.seams[number - 1];
    Part& part = chunk.parts[number];
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

SeamOf FrameChecker::seamOf(const DrawnParts& drawn, size_t number) {
  if (number == 0) return {};
  const auto face = static_cast<Face>(number - 1);
  return {face, seamFans(face, drawn.coarser | neighboursAcross(static_cast<uint8_t>(drawn.seams)))};
}

template <class ChunkOrConst, class Visit>
void FrameChecker::forEachDrawn(ChunkOrConst& chunk, const Visit& visit) {
  for (size_t number = 0; number < chunk.parts.size(); ++number)
    if (number == 0 || (chunk.drawn.seams >> (number - 1) & 1) != 0) visit(chunk.parts[number], number);
}

void FrameChecker::numberByEdge(const Part& part, std::vector<uint32_t>& first) {
  std::vector<std::pair<uint64_t, uint32_t>> edges;  // packed edge within the chunk, and vertex number
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
    // Differs from every feature's key, whose low bits are not 0.
    edges.push_back({(cell << 2 | axis) << 16, number});
  }
  std::sort(edges.begin(), edges.end());
  first.resize(edges.size());
  for (size_t i = 0, lowest = 0; i < edges.size(); ++i) {
    if (edges[i].first != edges[lowest].first) lowest = i;
    first[edges[i].second] = edges[lowest].second;
  }
}

Result<void> FrameChecker::draw(const sgm_mesh_view& mesh, const DrawnParts& parts) {
  Result<Chunk> copy = copyOf(mesh);
  if (!copy) return copy.error();
  erase(mesh.key);
  const ChunkKey key = keyOf(mesh.key);
  Chunk& chunk = chunks_[key] = std::move(*copy);
  chunk.drawn = parts;
  forEachDrawn(chunk, [&](Part&, size_t number) { show(chunk, number); });
  place(key, true);
  return {};
}

Result<void> FrameChecker::redraw(const sgm_chunk_key& key, const DrawnParts& parts) {
  const auto at = chunks_.find(keyOf(key));
  if (at == chunks_.end()) return malformed(keyOf(key), "is not drawn");
  Chunk& chunk = at->second;
  // A changed set of neighbouring blocks changes only lateral vertices of a seam, but seams are small: if its fans
  // change, the whole seam is added again.
  std::array<bool, 1 + SGM_FACE_COUNT> stays{true};
  forEachDrawn(chunk, [&](Part&, size_t number) {
    if (number == 0) return;
    stays[number] =
        (parts.seams >> (number - 1) & 1) != 0 && seamOf(chunk.drawn, number).fans == seamOf(parts, number).fans;
    if (!stays[number]) hide(chunk, number);
  });
  chunk.drawn = parts;
  forEachDrawn(chunk, [&](Part&, size_t number) {
    if (!stays[number]) show(chunk, number);
  });
  return {};
}

bool FrameChecker::erase(const sgm_chunk_key& key) {
  const auto at = chunks_.find(keyOf(key));
  if (at == chunks_.end()) return false;
  Chunk& chunk = at->second;
  forEachDrawn(chunk, [&](Part&, size_t number) { hide(chunk, number); });
  chunks_.erase(at);
  place(keyOf(key), false);
  return true;
}

FrameChecker::TriangleCounts FrameChecker::countTriangles(const Part& part, size_t number,
                                                          std::span<const uint32_t> ids, PairScratch& scratch) {
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

void FrameChecker::show(Chunk& chunk, size_t number) {
  Part& part = chunk.parts[number];
  if (number == 0) numberByEdge(part, first_);
  const SeamOf seam = seamOf(chunk.drawn, number);
  part.ids.resize(part.vertices.size());
  for (size_t i = 0; i < part.ids.size(); ++i) {
    if (number == 0 && isInside(part.vertices[i])) {
      part.ids[i] = kInside | first_[i];
      continue;
    }
    const auto [at, fresh] =
        vertices_.try_emplace(*vertexKey(chunk.grid, part.vertices[i], number == 0 ? nullptr : &seam));
    VertexUse& use = at->second;
    if (fresh && free_ids_.empty()) {
      use.id = next_id_++;
    } else if (fresh) {
      use.id = free_ids_.back();
      free_ids_.pop_back();
    }
    ++use.uses;
    part.ids[i] = use.id;
  }
  inside_.clear();
  part.triangles = countTriangles(part, number, part.ids, pairs_);
  forEachEdge(part.indices, part.ids, [&](uint32_t i, uint32_t j) {
    if (((part.ids[i] | part.ids[j]) & kInside) == 0) {
      useEdge(part.ids[i], part.ids[j], true);
    } else {
      const uint64_t from = first_[i], to = first_[j];
      inside_.push_back(from < to ? from << 32 | to << 1 : to << 32 | from << 1 | 1);
    }
  });
  std::sort(inside_.begin(), inside_.end());
  part.inside = {};
  for (size_t i = 0; i < inside_.size();) {
    const uint64_t edge = inside_[i] >> 1;
    std::array<uint64_t, 2> uses{};
    for (; i < inside_.size() && inside_[i] >> 1 == edge; ++i) ++uses[inside_[i] & 1];
    countUse(uses[0], uses[1], part.inside);
  }
  report_.edges += part.inside.edges;
  report_.open_edges += part.inside.open;
  report_.nonmanifold_edges += part.inside.nonmanifold;
  report_.triangles += part.indices.size() / 3;
  report_.degenerate_triangles += part.triangles.degenerate;
  report_.flat_triangles += part.triangles.flat;
  report_.folded_triangles += part.triangles.pairs.folded;
  report_.self_intersections += part.triangles.pairs.cut;
}

void FrameChecker::hide(Chunk& chunk, size_t number) {
  Part& part = chunk.parts[number];
  forEachEdge(part.indices, part.ids, [&](uint32_t i, uint32_t j) {
    if (((part.ids[i] | part.ids[j]) & kInside) == 0) useEdge(part.ids[i], part.ids[j], false);
  });
  const SeamOf seam = seamOf(chunk.drawn, number);
  for (size_t i = 0; i < part.ids.size(); ++i) {
    if ((part.ids[i] & kInside) != 0) continue;
    const auto at = vertices_.find(*vertexKey(chunk.grid, part.vertices[i], number == 0 ? nullptr : &seam));
    if (--at->second.uses != 0) continue;
    free_ids_.push_back(at->second.id);
    vertices_.erase(at);
  }
  part.ids = {};
  report_.edges -= part.inside.edges;
  report_.open_edges -= part.inside.open;
  report_.nonmanifold_edges -= part.inside.nonmanifold;
  report_.triangles -= part.indices.size() / 3;
  report_.degenerate_triangles -= part.triangles.degenerate;
  report_.flat_triangles -= part.triangles.flat;
  report_.folded_triangles -= part.triangles.pairs.folded;
  report_.self_intersections -= part.triangles.pairs.cut;
}

void FrameChecker::useEdge(uint32_t from, uint32_t to, bool more) {
  const auto at = edges_.try_emplace(std::minmax(from, to)).first;
  EdgeUse& use = at->second;
  Counts before, after;
  countUse(use.forward, use.backward, before);
  uint32_t& direction = from < to ? use.forward : use.backward;
  direction = more ? direction + 1 : direction - 1;
  countUse(use.forward, use.backward, after);
  report_.edges += after.edges - before.edges;
  report_.open_edges += after.open - before.open;
  report_.nonmanifold_edges += after.nonmanifold - before.nonmanifold;
  if (after.edges == 0) edges_.erase(at);
}

void FrameChecker::place(const ChunkKey& key, bool more) {
  uint64_t pairs = 0;
  for (ChunkKey outer = key; outer.level <= kMaxLevel; outer = parentOf(outer)) {
    const auto at = places_.try_emplace(outer).first;
    Place& place = at->second;
    if (outer == key) {
      place.drawn = more;
      pairs += place.below;
    } else {
      place.below = more ? place.below + 1 : place.below - 1;
      pairs += place.drawn;
    }
    if (!place.drawn && place.below == 0) places_.erase(at);
  }
  report_.chunks = chunks_.size();
  report_.overlaps = more ? report_.overlaps + pairs : report_.overlaps - pairs;
}

WholeReport FrameChecker::checkWhole() const {
  WholeReport whole;
  std::pmr::unsynchronized_pool_resource pool;
  std::pmr::unordered_map<VertexKey, uint32_t, Hash> shared(&pool);
  std::vector<uint32_t> indices, first, numbers;
  PairScratch scratch(std::pmr::new_delete_resource());
  uint32_t next = 0;
  for (const auto& [key, chunk] : chunks_) {
    forEachDrawn(chunk, [&](const Part& part, size_t number) {
      if (number == 0) numberByEdge(part, first);
      const SeamOf seam = seamOf(chunk.drawn, number);
      numbers.resize(part.vertices.size());
      for (size_t i = 0; i < numbers.size(); ++i) {
        if (number == 0 && isInside(part.vertices[i])) {
          numbers[i] = first[i] == i ? next++ : numbers[first[i]];
          continue;
        }
        const auto [at, fresh] =
            shared.try_emplace(*vertexKey(chunk.grid, part.vertices[i], number == 0 ? nullptr : &seam), next);
        next += fresh;
        numbers[i] = at->second;
      }
      for (const uint32_t index : part.indices) indices.push_back(numbers[index]);
      const TriangleCounts counts = countTriangles(part, number, numbers, scratch);
      whole.frame.degenerate_triangles += counts.degenerate;
      whole.frame.flat_triangles += counts.flat;
      whole.frame.folded_triangles += counts.pairs.folded;
      whole.frame.self_intersections += counts.pairs.cut;
    });
    for (ChunkKey outer = key; outer.level < kMaxLevel;) whole.frame.overlaps += chunks_.count(outer = parentOf(outer));
  }
  whole.mesh = checkTriangles(indices, next);
  whole.frame.chunks = chunks_.size();
  whole.frame.triangles = whole.mesh.triangles;
  whole.frame.edges = whole.mesh.edges;
  whole.frame.open_edges = whole.mesh.unmatched_edges;
  whole.frame.nonmanifold_edges = whole.mesh.repeated_edges;
  whole.between_parts = countBetweenParts();
  return whole;
}

uint64_t FrameChecker::countBetweenParts() const {
  struct Owner {
    int level;
    bool body;
  };
  std::vector<Owner> parts;
  std::vector<uint32_t> owners;  // the part of each triangle
  std::vector<measure::Point> points;
  std::vector<measure::Triangle> triangles;
  if (chunks_.empty()) return 0;
  const Int3 origin = chunks_.begin()->second.grid.origin;
  for (const auto& [key, chunk] : chunks_) {
    forEachDrawn(chunk, [&, &grid = chunk.grid](const Part& part, size_t number) {
      const auto first = static_cast<uint32_t>(points.size());
      for (const VertexPlace& v : part.vertices) {
        measure::Point& p = points.emplace_back();
        const std::array<int, 3> at{v.x, v.y, v.z};
        // Coordinates in 1/256 unit, which doubles represent exactly.
        for (int axis = 0; axis < 3; ++axis)
          p[axis] = static_cast<double>((int64_t{grid.origin[axis]} - origin[axis]) * kSubcell +
                                        int64_t{at[static_cast<size_t>(axis)]} * grid.cell);
      }
      for (size_t i = 0; i < part.indices.size(); i += 3) {
        triangles.push_back({first + part.indices[i], first + part.indices[i + 1], first + part.indices[i + 2]});
        owners.push_back(static_cast<uint32_t>(parts.size()));
      }
      parts.push_back({grid.level, number == 0});
    });
  }
  NoThreads jobs;
  const measure::Bvh tree({points, triangles}, jobs);
  const auto cornersOf = [&](uint32_t t) {
    const measure::Triangle& v = triangles[t];
    return std::array<measure::Point, 3>{points[v[0]], points[v[1]], points[v[2]]};
  };
  uint64_t pairs = 0;
  for (const measure::Bvh::Pair& pair : tree.parts(1)) {
    measure::Bvh::Walk walk(pair);
    tree.visitPairs(walk, UINT64_MAX, [&](uint32_t a, uint32_t b) {
      const Owner &first = parts[owners[a]], &second = parts[owners[b]];
      if (owners[a] == owners[b]) {
        // Pairs within a body are already counted; triangles of one seam may coincide.
        if (first.body) return;
      } else if (first.body && second.body && first.level == second.level) {
        pairs += measure::pairFault(cornersOf(a), cornersOf(b)) != PairFault::none;
        return;
      }
      pairs += measure::pierce(cornersOf(a), cornersOf(b));
    });
  }
  return pairs;
}

}  // namespace sgm::cli
