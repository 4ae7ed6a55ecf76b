#include "store/closure.h"

#include <algorithm>
#include <vector>

#include "mesh/vertex_keys.h"

namespace sgm::store {
namespace {

constexpr BorderSums kNone{};

struct FaceAxes {
  int axis, u, v;
};
FaceAxes axesOf(int face) {
  const int axis = face / 2;
  return {axis, (axis + 1) % 3, (axis + 2) % 3};
}

bool isFaceFeature(const VertexKey& key, int axis) { return key.axis == kFaceVertex + axis; }

/// True if a vertex lies in the plane of a chunk's face. key: the vertex's key, in coordinates relative to the chunk,
/// in which a cell has edge 1.
bool isIn(const VertexKey& key, int face) {
  const int axis = face / 2, plane = face % 2 == 0 ? 0 : kChunkCells;
  const bool lies_across = key.axis < 3 ? key.axis != axis : isFaceFeature(key, axis) || key.axis == kLateral;
  return lies_across && key.corner[axis] == plane;
}

/// Returns a number that identifies a vertex among all vertices of one border. a, b: the vertex's coordinates along the
/// border.
uint64_t placeOf(const VertexKey& key, int32_t a, int32_t b) {
  // A lateral vertex lies between the samples of two levels. Its number `fan` distinguishes it from other lateral
  // vertices at the same place, but depends on chunks elsewhere in the frame. So this function ignores the number.
  const uint32_t fan = key.axis == kLateral ? 0 : key.fan;
  return uint64_t{static_cast<uint32_t>(a)} << 40 | uint64_t{static_cast<uint32_t>(b) & 0xFFFFFF} << 16 |
         uint64_t{key.axis} << 8 | fan;
}

EdgeSum sumOf(uint64_t from, uint64_t to) { return hashCombine(from, to) - hashCombine(to, from); }

/// Returns the chunk of the same level on the other side of a face.
ChunkKey beyond(const ChunkKey& chunk, int face) {
  ChunkKey other = chunk;
  other.at[face / 2] += face % 2 == 0 ? -1 : 1;
  return other;
}

std::string nameOf(const ChunkKey& chunk) {
  return "chunk (" + std::to_string(chunk.at.x) + ", " + std::to_string(chunk.at.y) + ", " +
         std::to_string(chunk.at.z) + ") of level " + std::to_string(chunk.level);
}

std::string nameOf(int face) { return std::string(1, "xyz"[face / 2]) + (face % 2 == 0 ? "_lo" : "_hi"); }

void addBodyEdge(const VertexKey& p, const VertexKey& q, BorderSums& sums) {
  for (int face = 0; face < 6; ++face) {
    if (!isIn(p, face) || !isIn(q, face)) continue;
    const auto [axis, u, v] = axesOf(face);
    const auto f = static_cast<size_t>(face);
    sums.own[f] += sumOf(placeOf(p, p.corner[u], p.corner[v]), placeOf(q, q.corner[u], q.corner[v]));
    // Finds the quarter of the face that contains the edge. An edge lies in one grid square; the componentwise minimum
    // of its ends is the lowest corner of that square.
    const int half_u = std::min(p.corner[u], q.corner[u]) < kChunkCells / 2 ? 0 : 1;
    const int half_v = std::min(p.corner[v], q.corner[v]) < kChunkCells / 2 ? 0 : 1;
    const auto finer = [=, u = u, v = v](const VertexKey& key) {
      return placeOf(key, 2 * key.corner[u] - kChunkCells * half_u, 2 * key.corner[v] - kChunkCells * half_v);
    };
    sums.quarters[f][static_cast<size_t>(half_u + 2 * half_v)] += sumOf(finer(p), finer(q));
  }
}

void addSeamEdge(const VertexKey& p, const VertexKey& q, int face, BorderSums& sums) {
  const auto [axis, u, v] = axesOf(face);
  const auto place = [u = u, v = v](const VertexKey& key) { return placeOf(key, key.corner[u], key.corner[v]); };
  for (int side = 0; side < 4; ++side) {
    const int across = side < 2 ? u : v, along = side < 2 ? v : u, border = side % 2 == 0 ? 0 : kChunkCells;
    const auto isOn = [&](const VertexKey& key) {
      return (key.axis == along || key.axis == kLateral) && key.corner[across] == border;
    };
    if (!isOn(p) || !isOn(q)) continue;
    const auto placeOn = [&](const VertexKey& key) { return placeOf(key, key.corner[along], key.level); };
    sums.ends[static_cast<size_t>(side)] += sumOf(placeOn(p), placeOn(q));
    return;
  }
  const bool own = p.level == 0 && q.level == 0, lateral = p.axis == kLateral || q.axis == kLateral;
  if (lateral || p.level != q.level) {
    sums.stray += sumOf(place(p) << 1 | p.level, place(q) << 1 | q.level);
  } else if (own) {
    sums.own[static_cast<size_t>(face)] += sumOf(place(p), place(q));
  } else {
    sums.coarser += sumOf(place(p), place(q));
  }
}

}  // namespace

BorderSums bordersOf(const PackedMesh& mesh, int part) {
  BorderSums sums;
  const PackedRange& range = mesh.ranges[static_cast<size_t>(part)];
  if (range.index_count == 0) return sums;
  MeshPart own(mesh.vertices.get_allocator().resource());
  const auto first = mesh.vertices.begin() + range.first_vertex;
  own.vertices.assign(first, first + range.vertex_count);
  deriveKeys({{0, 0, 0}, 1, 0}, part, 0, own);
  const auto keyOf = [&](uint32_t i) -> const VertexKey& { return own.keys[mesh.indices[i] - range.first_vertex]; };
  for (uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
    for (uint32_t k = 0; k < 3; ++k) {
      const VertexKey &p = keyOf(i + k), &q = keyOf(i + (k + 1) % 3);
      if (part == 0) {
        addBodyEdge(p, q, sums);
      } else {
        addSeamEdge(p, q, part - 1, sums);
      }
    }
  }
  return sums;
}

size_t Closure::BorderHash::operator()(const Border& border) const {
  return static_cast<size_t>(
      hashCombine(ChunkKeyHash()(border.chunk), static_cast<uint64_t>(border.kind) << 8 | border.number));
}

void Closure::add(const ChunkKey& chunk, const std::array<const BorderSums*, 7>& parts) {
  const BorderSums& body = parts[0] != nullptr ? *parts[0] : kNone;
  addBodies(chunk, body);
  addToFiner(chunk, body);
  for (int face = 0; face < 6; ++face) {
    if (!isBakedPart(chunk, 1 + face)) continue;
    const BorderSums* seam = parts[static_cast<size_t>(1 + face)];
    addSeam(chunk, face, body, seam != nullptr ? *seam : kNone);
  }
}

void Closure::addBodies(const ChunkKey& chunk, const BorderSums& body) {
  for (int face = 0; face < 6; ++face) {
    const ChunkKey other = beyond(chunk, face);
    if (!holds(region_, other)) continue;
    addPair({Kind::bodies, static_cast<uint8_t>(face / 2), face % 2 == 0 ? other : chunk},
            body.own[static_cast<size_t>(face)]);
  }
}

void Closure::addToFiner(const ChunkKey& chunk, const BorderSums& body) {
  for (int face = 0; face < 6; ++face) {
    const auto [axis, u, v] = axesOf(face);
    const ChunkKey other = beyond(chunk, face);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const int near = face % 2 == 0 ? 1 : 0;
      const ChunkKey finer = childOf(other, near << axis | (quarter & 1) << u | (quarter >> 1) << v);
      if (!holds(region_, finer)) continue;
      addPair({Kind::levels, static_cast<uint8_t>(face ^ 1), finer},
              body.quarters[static_cast<size_t>(face)][static_cast<size_t>(quarter)]);
    }
  }
}

void Closure::addSeam(const ChunkKey& chunk, int face, const BorderSums& body, const BorderSums& seam) {
  const EdgeSum own = seam.own[static_cast<size_t>(face)], of_body = body.own[static_cast<size_t>(face)];
  if (own + of_body != 0)
    tell_("the seam of " + nameOf(chunk) + " over " + nameOf(face) + " does not fit its own body");
  if (seam.stray != 0) tell_("the seam of " + nameOf(chunk) + " over " + nameOf(face) + " has a hole");
  borders_ += own != 0;
  if (holds(region_, beyond(parentOf(chunk), face)))
    addPair({Kind::levels, static_cast<uint8_t>(face), chunk}, seam.coarser);
  for (int side = 0; side < 4; ++side) addEnd(chunk, face, side, seam.ends[static_cast<size_t>(side)]);
}

void Closure::addPair(const Border& border, EdgeSum sum) {
  if (sum == 0) return;
  const auto at = open_.try_emplace(border).first;
  at->second.sum += sum;
  if (++at->second.count < 2) return;
  if (at->second.sum != 0) tell(border);
  ++borders_;
  open_.erase(at);
}

/// Adds the hash of one of a seam's four ends (its borders along the edges of the chunk's face). The vertices of an end
/// depend only on the samples along the chunk edge, at both levels. So all seams that end at this edge have the same
/// vertices there, and their hashes must be equal. Only the sign may differ: it depends on the direction in which a
/// seam runs around its border.
void Closure::addEnd(const ChunkKey& chunk, int face, int side, EdgeSum sum) {
  if (sum == 0) return;
  const auto [axis, u, v] = axesOf(face);
  const int across = side < 2 ? u : v, along = side < 2 ? v : u;
  Border border{Kind::ends, static_cast<uint8_t>(along), chunk};
  border.chunk.at[axis] += face % 2;
  border.chunk.at[across] += side % 2;
  const bool backwards = ((face + side) % 2 != 0) != (side >= 2);
  const EdgeSum forwards = backwards ? -sum : sum;
  const auto [at, is_new] = open_.try_emplace(border);
  if (is_new) at->second.sum = forwards;
  at->second.differ = at->second.differ || at->second.sum != forwards;
  if (++at->second.count < endsAt(border)) return;
  if (at->second.differ) tell(border);
  borders_ += at->second.count > 1;
  open_.erase(at);
}

/// Returns the number of seams in the region that end at this chunk edge.
int Closure::endsAt(const Border& border) const {
  const int a = (border.number + 1) % 3, b = (border.number + 2) % 3;
  int ends = 0;
  for (int corner = 0; corner < 4; ++corner) {
    ChunkKey chunk = border.chunk;
    const int high_a = corner & 1, high_b = corner >> 1;
    chunk.at[a] -= high_a;
    chunk.at[b] -= high_b;
    if (!holds(region_, chunk)) continue;
    ends += isBakedPart(chunk, 1 + 2 * a + high_a);
    ends += isBakedPart(chunk, 1 + 2 * b + high_b);
  }
  return ends;
}

void Closure::tell(const Border& border) const {
  if (border.kind == Kind::ends) {
    tell_("seams do not fit together at the lowest edge along " + std::string(1, "xyz"[border.number]) + " of " +
          nameOf(border.chunk));
  } else if (border.kind == Kind::levels) {
    tell_("the seam of " + nameOf(border.chunk) + " over " + nameOf(int{border.number}) +
          " does not fit the coarser chunk");
  } else {
    tell_("the surface is not closed between " + nameOf(border.chunk) + " and " +
          nameOf(beyond(border.chunk, 2 * border.number + 1)));
  }
}

void Closure::finish() {
  std::vector<Border> borders;
  for (const auto& [border, sides] : open_) borders.push_back(border);
  open_.clear();
  std::sort(borders.begin(), borders.end());
  for (const Border& border : borders) tell(border);
}

}  // namespace sgm::store
