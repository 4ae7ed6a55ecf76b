#include "mesh/packed_mesh.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "mesh/hash.h"

namespace sgm {

namespace {

/// The vertices and indices that are copied into a range of a packed mesh. An index with the value `first` refers to
/// vertices[0].
struct RangeSource {
  std::span<const Vertex> vertices;
  std::span<const uint32_t> indices;
  uint32_t first = 0;
  ContentHash hash;
};

RangeSource sourceOf(const MeshPart* part, const PackedMesh* before, size_t i) {
  if (part != nullptr) return {part->vertices, part->indices, 0, part->hash};
  if (before == nullptr) return {};
  const PackedRange& r = before->ranges[i];
  return {std::span(before->vertices).subspan(r.first_vertex, r.vertex_count),
          std::span(before->indices).subspan(r.first_index, r.index_count), r.first_vertex, r.hash};
}

}  // namespace

PackedMesh packMesh(const MeshParts& parts, const PackedMesh* before, std::pmr::memory_resource* memory) {
  PackedMesh mesh(memory);
  std::array<RangeSource, 7> sources;
  size_t vertex_count = 0, index_count = 0;
  for (size_t i = 0; i < parts.size(); ++i) {
    sources[i] = sourceOf(parts[i], before, i);
    mesh.ranges[i] = {static_cast<uint32_t>(vertex_count), static_cast<uint32_t>(sources[i].vertices.size()),
                      static_cast<uint32_t>(index_count), static_cast<uint32_t>(sources[i].indices.size()),
                      sources[i].hash};
    vertex_count += sources[i].vertices.size();
    index_count += sources[i].indices.size();
  }
  mesh.vertices.reserve(vertex_count);
  mesh.indices.reserve(index_count);
  for (size_t i = 0; i < parts.size(); ++i) {
    const RangeSource& source = sources[i];
    mesh.vertices.insert(mesh.vertices.end(), source.vertices.begin(), source.vertices.end());
    mesh.indices.insert(mesh.indices.end(), source.indices.begin(), source.indices.end());
    const uint32_t by = mesh.ranges[i].first_vertex - source.first;
    for (uint32_t& index : std::span(mesh.indices).subspan(mesh.ranges[i].first_index)) index += by;
  }
  return mesh;
}

PackedMesh packBody(MeshPart&& body, std::pmr::memory_resource* memory) {
  PackedMesh mesh(memory);
  mesh.vertices = std::move(body.vertices);
  mesh.indices = std::move(body.indices);
  // Sharpening leaves spare capacity in the arrays. It is released, because packed meshes live long.
  mesh.vertices.shrink_to_fit();
  mesh.indices.shrink_to_fit();
  mesh.ranges[0] = {0, static_cast<uint32_t>(mesh.vertices.size()), 0, static_cast<uint32_t>(mesh.indices.size()),
                    body.hash};
  return mesh;
}

IntBox boundsOf(const ChunkGrid& grid, std::span<const Vertex> vertices) {
  if (vertices.empty()) return {{0, 0, 0}, {0, 0, 0}};
  // Reads all eight words of a vertex, although only the first three are needed, so that the compiler vectorises the
  // loop.
  std::array<int16_t, 8> lo, hi, words;
  lo.fill(std::numeric_limits<int16_t>::max());
  hi.fill(std::numeric_limits<int16_t>::min());
  static_assert(sizeof(words) == sizeof(Vertex));
  for (const Vertex& v : vertices) {
    std::memcpy(words.data(), &v, sizeof v);
    for (size_t i = 0; i < words.size(); ++i) {
      lo[i] = std::min(lo[i], words[i]);
      hi[i] = std::max(hi[i], words[i]);
    }
  }
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const int64_t cell = grid.cell;
    box.lo[axis] = saturate(grid.origin[axis] + floorDiv(lo[i] * cell, kSubcell));
    box.hi[axis] = saturate(grid.origin[axis] + floorDiv(hi[i] * cell + kSubcell - 1, kSubcell));
  }
  return box;
}

std::pmr::vector<uint16_t> tagsOf(std::span<const Vertex> vertices, std::pmr::memory_resource* memory) {
  std::pmr::vector<uint16_t> tags(memory);
  for (const Vertex& v : vertices) {
    if (v.tag != 0 && (tags.empty() || tags.back() != v.tag)) tags.push_back(v.tag);
  }
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

ContentHash hashOf(const PackedMesh& mesh, const ChunkGrid& grid) {
  ContentHash sum;
  for (size_t i = 0; i < mesh.ranges.size(); ++i) {
    if (mesh.ranges[i].index_count == 0) continue;
    const ContentHash placed = hashPlaced(mesh.ranges[i].hash, grid, static_cast<int>(i));
    sum.a += placed.a;
    sum.b += placed.b;
  }
  return sum;
}

}  // namespace sgm
