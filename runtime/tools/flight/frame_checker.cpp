#include "tools/flight/frame_checker.h"

#include <algorithm>
#include <array>

#include "base/hash.h"

namespace sgm::cli {
namespace {

/// Adds one edge to the counts. forward, backward: number of triangles that use the edge in each direction.
void countUse(uint64_t forward, uint64_t backward, EdgeCounts& counts) {
  counts.edges += forward + backward > 0;
  counts.open += forward != backward;
  counts.nonmanifold += forward > 1 || backward > 1;
}

/// Calls use(from, to) with vertex indices for each edge of each triangle. Skips triangles with a repeated vertex.
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

}  // namespace

size_t FrameChecker::Hash::operator()(const Edge& edge) const {
  return mix64(uint64_t{edge.first} << 32 | edge.second);
}

size_t FrameChecker::Hash::operator()(const ChunkKey& key) const {
  return VertexKeyHash::operator()(VertexKey{key.at, static_cast<uint8_t>(key.level), 0, 0});
}

Result<void> FrameChecker::draw(const sgm_mesh_view& mesh, const DrawnParts& parts) {
  Result<CheckedChunk> copy = copyChunk(mesh);
  if (!copy) return copy.error();
  erase(mesh.key);
  const ChunkKey key = keyOf(mesh.key);
  CheckedChunk& chunk = chunks_[key] = std::move(*copy);
  chunk.drawn = parts;
  forEachDrawn(chunk, [&](CheckedPart&, size_t number) { show(chunk, number); });
  place(key, true);
  return {};
}

Result<void> FrameChecker::redraw(const sgm_chunk_key& key, const DrawnParts& parts) {
  const auto at = chunks_.find(keyOf(key));
  if (at == chunks_.end()) return malformed(keyOf(key), "is not drawn");
  CheckedChunk& chunk = at->second;
  // Of all vertex keys, only those of a seam's lateral vertices (at corners where two levels meet) depend on the
  // neighbouring blocks, through the seam's fan numbers. If these change, the whole seam is removed and added again,
  // which is cheap because seams are small.
  std::array<bool, 1 + SGM_FACE_COUNT> stays{true};
  forEachDrawn(chunk, [&](CheckedPart&, size_t number) {
    if (number == 0) return;
    stays[number] =
        (parts.seams >> (number - 1) & 1) != 0 && seamOf(chunk.drawn, number).fans == seamOf(parts, number).fans;
    if (!stays[number]) hide(chunk, number);
  });
  chunk.drawn = parts;
  forEachDrawn(chunk, [&](CheckedPart&, size_t number) {
    if (!stays[number]) show(chunk, number);
  });
  return {};
}

bool FrameChecker::erase(const sgm_chunk_key& key) {
  const auto at = chunks_.find(keyOf(key));
  if (at == chunks_.end()) return false;
  CheckedChunk& chunk = at->second;
  forEachDrawn(chunk, [&](CheckedPart&, size_t number) { hide(chunk, number); });
  chunks_.erase(at);
  place(keyOf(key), false);
  return true;
}

void FrameChecker::show(CheckedChunk& chunk, size_t number) {
  CheckedPart& part = chunk.parts[number];
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

void FrameChecker::hide(CheckedChunk& chunk, size_t number) {
  CheckedPart& part = chunk.parts[number];
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
  EdgeCounts before, after;
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

}  // namespace sgm::cli
