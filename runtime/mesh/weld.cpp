#include "mesh/weld.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>

#include "mesh/feature_kind.h"
#include "mesh/key_order.h"

namespace sgm {
namespace {

/// True if a vertex may have copies among the parts that are welded. Parts meet only in the faces of their chunks. So
/// an edge vertex that lies inside its chunk belongs to one part only. A feature vertex may always have copies: a face
/// vertex may lie off its face, and a part may itself contain copies of a feature vertex.
bool mayBeOneOfMany(const Vertex& v) {
  if (isFeature(v.kind)) return true;
  constexpr int kEnd = kChunkCells * kSubcell;
  return v.x == 0 || v.x == kEnd || v.y == 0 || v.y == kEnd || v.z == 0 || v.z == kEnd;
}

/// Returns the keys of all vertices that may have copies. Each key is stored with the index that the vertex has among
/// the vertices of all parts. Sorted by key, then by index.
std::pmr::vector<OrderedKey> sortedBorder(std::span<const PlacedPart> parts, std::pmr::memory_resource* memory) {
  std::pmr::vector<OrderedKey> border(memory);
  uint32_t place = 0;
  for (const PlacedPart& part : parts) {
    const MeshPart& mesh = *part.mesh;
    for (size_t i = 0; i < mesh.vertices.size(); ++i, ++place)
      if (mayBeOneOfMany(mesh.vertices[i])) border.emplace_back(mesh.keys[i], place);
  }
  std::sort(border.begin(), border.end());
  return border;
}

/// Converts a position to metres. Exact, because the position is at most 2^41 steps of 1/256 unit, which a double can
/// represent.
double metres(int32_t chunk_origin, int32_t mesh_origin, int16_t position, int32_t cell) {
  const int64_t steps = (int64_t{chunk_origin} - mesh_origin) * kSubcell + int64_t{position} * cell;
  return static_cast<double>(steps) * (1.0 / (kSubcell * kUnitsPerMetre));
}

}  // namespace

Result<WorldMesh> weld(std::span<const PlacedPart> parts, Int3 origin, std::pmr::memory_resource* memory) {
  std::pmr::vector<PlacedPart> ordered(parts.begin(), parts.end(), memory);
  std::sort(ordered.begin(), ordered.end(), [](const PlacedPart& a, const PlacedPart& b) {
    const auto rank = [](const PlacedPart& p) {
      return std::tuple(p.grid.level, p.grid.origin.z, p.grid.origin.y, p.grid.origin.x, p.number);
    };
    return rank(a) < rank(b);
  });
  size_t vertex_count = 0, index_count = 0;
  for (const PlacedPart& part : ordered) {
    vertex_count += part.mesh->vertices.size();
    index_count += part.mesh->indices.size();
  }
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  if (vertex_count >= kNone) {
    return Error{Code::limit, "the region has " + std::to_string(vertex_count) +
                                  " vertices, more than 32-bit indices can number; mesh a smaller one"};
  }

  // number: first, the index of the first vertex with the same key for each vertex that is a later copy, and kNone for
  // all other vertices. Later, the number of each vertex in the welded mesh.
  std::pmr::vector<uint32_t> number(vertex_count, kNone, memory);
  size_t welded_count = vertex_count;
  {
    const std::pmr::vector<OrderedKey> border = sortedBorder(ordered, memory);
    for (size_t i = 1, first = 0; i < border.size(); ++i) {
      if (!border[i].sameKey(border[first])) {
        first = i;
        continue;
      }
      number[border[i].place] = border[first].place;
      --welded_count;
    }
  }

  WorldMesh mesh(memory);
  mesh.origin = origin;
  mesh.positions.reserve(welded_count);
  mesh.attributes.reserve(welded_count);
  mesh.keys.reserve(welded_count);
  mesh.indices.reserve(index_count);
  size_t first = 0;
  for (const PlacedPart& part : ordered) {
    const ChunkGrid& grid = part.grid;
    const std::span<const Vertex> vertices = part.mesh->vertices;
    for (size_t i = 0; i < vertices.size(); ++i) {
      uint32_t& at = number[first + i];
      if (at != kNone) {
        at = number[at];
        continue;
      }
      at = static_cast<uint32_t>(mesh.positions.size());
      const Vertex& v = vertices[i];
      mesh.positions.push_back({metres(grid.origin.x, origin.x, v.x, grid.cell),
                                metres(grid.origin.y, origin.y, v.y, grid.cell),
                                metres(grid.origin.z, origin.z, v.z, grid.cell)});
      mesh.attributes.push_back({v.normal_x, v.normal_y, v.material, v.tag});
      mesh.keys.push_back(part.mesh->keys[i]);
    }
    for (uint32_t index : part.mesh->indices) mesh.indices.push_back(number[first + index]);
    first += vertices.size();
  }
  return mesh;
}

ContentHash hashMesh(const WorldMesh& mesh) {
  ContentHash sum;
  uint32_t place = 0;
  for (int axis = 0; axis < 3; ++axis) addWord(sum, static_cast<uint32_t>(mesh.origin[axis]), place++);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    for (double x : mesh.positions[i]) {
      const auto bits = std::bit_cast<uint64_t>(x);
      addWord(sum, static_cast<uint32_t>(bits), place++);
      addWord(sum, static_cast<uint32_t>(bits >> 32), place++);
    }
    const VertexAttributes& a = mesh.attributes[i];
    addWord(sum, uint32_t{static_cast<uint16_t>(a.normal_x)} | uint32_t{static_cast<uint16_t>(a.normal_y)} << 16,
            place++);
    addWord(sum, uint32_t{a.material} | uint32_t{a.tag} << 16, place++);
  }
  place = 1u << 31;
  for (uint32_t index : mesh.indices) addWord(sum, index, place++);
  return sum;
}

}  // namespace sgm
