#include "stream/make/collider.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "mesh/hash.h"
#include "stream/plan/chunk_set.h"

namespace sgm {

namespace {

constexpr double kKeptFarther = 1.25;

/// True if the triangle's area is not 0. Twice the area vector, in (1/256 cell)^2, is computed exactly in 64 bits.
bool hasArea(const Vertex& a, const Vertex& b, const Vertex& c) {
  const int64_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int64_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return uy * vz != uz * vy || uz * vx != ux * vz || ux * vy != uy * vx;
}

uint64_t hashOf(const Collider& collider) {
  ContentHash hash;
  addWord(hash, static_cast<uint32_t>(collider.positions.size()), 0);
  uint32_t place = 1;
  for (const float p : collider.positions) addWord(hash, std::bit_cast<uint32_t>(p), place++);
  for (const uint32_t i : collider.indices) addWord(hash, i, place++);
  for (const uint16_t m : collider.materials) addWord(hash, m, place++);
  return hash.value();
}

/// Returns a hash of the drawn parts from which a chunk's collider is made. If it is unchanged, the collider need not
/// be made again.
uint64_t hashOfParts(const DrawnChunk& chunk) {
  uint64_t hash = 0;
  for (size_t part = 0; part < chunk.surface->mesh.ranges.size(); ++part) {
    const PackedRange& range = chunk.surface->mesh.ranges[part];
    if (range.index_count == 0 || (part > 0 && !(chunk.seams >> (part - 1) & 1))) continue;
    hash = mix64(mix64(hash + part) ^ range.hash.value());
  }
  return hash;
}

/// A set of chunks that can tell whether another chunk, of any level, overlaps one of them.
class Overlaps {
 public:
  explicit Overlaps(int top) : top_(top) {}
  void add(ChunkKey key) {
    chunks_.insert(key);
    for (; key.level < top_ && around_.insert(key); key = parentOf(key)) {
    }
    around_.insert(key);
  }
  bool meets(ChunkKey key) const {
    if (around_.contains(key)) return true;
    for (; key.level < top_; key = parentOf(key)) {
      if (chunks_.contains(key)) return true;
    }
    return chunks_.contains(key);
  }

 private:
  int top_;
  ChunkSet chunks_, around_;  ///< chunks_: the chunks; around_: the chunks and all of their ancestors
};

}  // namespace

Collider colliderOf(const ChunkSurface& surface, uint8_t seams, std::pmr::memory_resource* memory) {
  constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();
  const PackedMesh& mesh = surface.mesh;
  Collider collider(memory);
  collider.key = surface.key;
  collider.grid = surface.grid;
  const double metres = static_cast<double>(surface.grid.cell) / (kSubcell * kUnitsPerMetre);
  std::vector<uint32_t> numbers(mesh.vertices.size(), kUnused);
  const auto use = [&](uint32_t i) {
    if (numbers[i] == kUnused) {
      numbers[i] = static_cast<uint32_t>(collider.positions.size() / 3);
      const Vertex& v = mesh.vertices[i];
      for (const int16_t p : {v.x, v.y, v.z}) collider.positions.push_back(static_cast<float>(p * metres));
    }
    collider.indices.push_back(numbers[i]);
  };
  for (size_t part = 0; part < mesh.ranges.size(); ++part) {
    if (part > 0 && !(seams >> (part - 1) & 1)) continue;
    const PackedRange& range = mesh.ranges[part];
    for (uint32_t at = range.first_index; at < range.first_index + range.index_count; at += 3) {
      const uint32_t* corner = &mesh.indices[at];
      if (!hasArea(mesh.vertices[corner[0]], mesh.vertices[corner[1]], mesh.vertices[corner[2]])) continue;
      for (int i = 0; i < 3; ++i) use(corner[i]);
      collider.materials.push_back(mesh.vertices[corner[0]].material);
    }
  }
  collider.positions.shrink_to_fit();
  collider.indices.shrink_to_fit();
  collider.materials.shrink_to_fit();
  collider.hash = hashOf(collider);
  return collider;
}

bool Colliders::update(const DrawnFrame& frame, const ViewerIndex& viewers, size_t most,
                       std::pmr::memory_resource* memory, std::vector<ColliderChange>& changes) {
  changes.clear();
  if (distance_ == 0) return true;
  struct Wanted {
    double away;
    const DrawnChunk* chunk;
    uint64_t parts;
  };
  std::vector<Wanted> missing;
  std::map<ChunkKey, Given> next;
  for (const DrawnChunk& chunk : frame.drawn) {
    const double away = viewers.distance(chunk.key);
    const auto has = given_.find(chunk.key);
    if (away > distance_ * (has == given_.end() ? 1 : kKeptFarther)) continue;
    if (has != given_.end()) next.insert(*has);
    const uint64_t parts = hashOfParts(chunk);
    if (has == given_.end() || has->second.parts != parts) missing.push_back({away, &chunk, parts});
  }
  std::sort(missing.begin(), missing.end(), [](const Wanted& a, const Wanted& b) {
    return a.away != b.away ? a.away < b.away : a.chunk->key < b.chunk->key;
  });
  const size_t count = std::min(most, missing.size());
  for (const Wanted& wanted : std::span(missing).first(count)) {
    const DrawnChunk& chunk = *wanted.chunk;
    auto made = std::allocate_shared<Collider>(std::pmr::polymorphic_allocator<>(memory),
                                               colliderOf(*chunk.surface, chunk.seams, memory));
    const auto [given, is_new] = next.try_emplace(chunk.key);
    const bool same = !is_new && given->second.hash == made->hash;
    given->second = {wanted.parts, made->hash, made->bytes()};
    if (!same) changes.push_back({chunk.key, std::move(made)});
  }
  // Old colliders are kept until their replacements at another level exist, so that objects do not fall through the
  // ground.
  Overlaps late(frame.tree.top());
  for (const Wanted& wanted : std::span(missing).subspan(count)) late.add(wanted.chunk->key);
  for (const auto& [key, given] : given_) {
    if (next.contains(key)) continue;
    if (late.meets(key)) {
      next.insert({key, given});
    } else {
      changes.push_back({key, nullptr});
    }
  }
  given_.swap(next);
  bytes_ = 0;
  for (const auto& [key, given] : given_) bytes_ += given.bytes;
  return count == missing.size();
}

}  // namespace sgm
