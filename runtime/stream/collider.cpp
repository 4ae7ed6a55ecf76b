#include "stream/collider.h"

#include <algorithm>
#include <limits>

namespace sgm {

namespace {

constexpr double kKeptFarther = 1.25;

/// Twice the area's vector, in 1/256 of a cell, is exact in 64 bits.
bool hasArea(const Vertex& a, const Vertex& b, const Vertex& c) {
  const int64_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int64_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return uy * vz != uz * vy || uz * vx != ux * vz || ux * vy != uy * vx;
}

double nearest(const ChunkKey& key, std::span<const Viewer> viewers, int32_t finest_cell) {
  double least = std::numeric_limits<double>::infinity();
  for (const Viewer& viewer : viewers) least = std::min(least, distanceToChunk(viewer.position, key, finest_cell));
  return least;
}

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
  return collider;
}

bool Colliders::update(const DrawnFrame& frame, std::span<const Viewer> viewers, size_t most,
                       std::pmr::memory_resource* memory) {
  if (distance_ == 0) return true;
  if (!changes_.empty()) return false;
  struct Wanted {
    double away;
    const DrawnChunk* chunk;
  };
  std::vector<Wanted> missing;
  std::map<ChunkKey, Given> next;
  std::vector<ColliderChange> changes;
  for (const DrawnChunk& chunk : frame.drawn) {
    const double away = nearest(chunk.key, viewers, finest_cell_);
    const auto has = given_.find(chunk.key);
    if (away > distance_ * (has == given_.end() ? 1 : kKeptFarther)) continue;
    if (has != given_.end()) next.insert(*has);
    if (has == given_.end() || has->second.surface != chunk.surface || has->second.seams != chunk.seams) {
      missing.push_back({away, &chunk});
    }
  }
  std::sort(missing.begin(), missing.end(), [](const Wanted& a, const Wanted& b) {
    return a.away != b.away ? a.away < b.away : a.chunk->key < b.chunk->key;
  });
  for (const Wanted& wanted : std::span(missing).first(std::min(most, missing.size()))) {
    const DrawnChunk& chunk = *wanted.chunk;
    auto made = std::allocate_shared<Collider>(std::pmr::polymorphic_allocator<>(memory),
                                               colliderOf(*chunk.surface, chunk.seams, memory));
    next[chunk.key] = {chunk.surface, chunk.seams, made->bytes()};
    changes.push_back({chunk.key, std::move(made)});
  }
  for (const auto& [key, given] : given_) {
    if (!next.contains(key)) changes.push_back({key, nullptr});
  }
  given_.swap(next);
  bytes_ = 0;
  for (const auto& [key, given] : given_) bytes_ += given.bytes;
  changes_.swap(changes);
  return missing.size() <= most;
}

}  // namespace sgm
