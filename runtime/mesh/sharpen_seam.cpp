#include <algorithm>
#include <array>

#include "mesh/hash.h"
#include "mesh/sharpen.h"

namespace sgm {
namespace {

/// The lowest corner of the square across `axis` whose edges these are; none where they share no square.
std::optional<Int3> sharedSquare(const VertexKey& a, const VertexKey& b, int axis, int32_t cell) {
  Int3 corner;
  for (int k = 0; k < 3; ++k) corner[k] = std::min(a.corner[k], b.corner[k]);
  for (const VertexKey* key : {&a, &b}) {
    if (key->corner[axis] != corner[axis]) return std::nullopt;
    const int across = 3 - axis - key->axis;
    if (key->corner[key->axis] != corner[key->axis]) return std::nullopt;
    if (key->corner[across] != corner[across] && key->corner[across] != corner[across] + cell) return std::nullopt;
  }
  return corner;
}

/// The triangles of a polygon whose corners are a triangle's and, behind each, perhaps the middle of its side.
void divide(const std::array<uint32_t, 3>& corners, const std::array<uint32_t, 3>& middles,
            RawVector<uint32_t>& indices) {
  std::array<uint32_t, 6> ring;
  size_t count = 0, middle = 0;
  for (size_t k = 0; k < 3; ++k) {
    ring[count++] = corners[k];
    if (middles[k] == Creases::kNoVertex) continue;
    middle = count;
    ring[count++] = middles[k];
  }
  // About a middle: it is no corner of another triangle here, so that no edge comes twice.
  for (size_t i = 1; i + 1 < count; ++i) {
    indices.insert(indices.end(), {ring[middle], ring[(middle + i) % count], ring[(middle + i + 1) % count]});
  }
}

}  // namespace

void sharpenSeam(const ChunkGrid& grid, Face face, const FieldSampler& field, const FieldSampler& coarser,
                 MeshPart& seam, std::pmr::memory_resource* memory) {
  if (seam.indices.empty()) return;
  std::array<Creases, 2> levels{Creases(grid, grid.level, field, seam, memory),
                                Creases(grid, grid.level + 1, coarser, seam, memory)};
  const auto isOf = [&](uint32_t v, size_t level) {
    return seam.vertices[v].kind == (level == 0 ? kOwnEdge : kCoarserEdge);
  };
  const size_t triangles_end = seam.indices.size();
  for (size_t level = 0; level < 2; ++level) {
    std::pmr::vector<uint32_t> vertices(memory);
    for (uint32_t v = 0; v < seam.vertices.size(); ++v) {
      if (isOf(v, level)) vertices.push_back(v);
    }
    if (!vertices.empty()) levels[level].settle(vertices);
  }
  // Face vertices are appended, and have neither kind.
  for (size_t level = 0; level < 2; ++level) {
    Creases& creases = levels[level];
    for (size_t i = 0; i < triangles_end; ++i) {
      const uint32_t a = seam.indices[i], b = seam.indices[i % 3 == 2 ? i - 2 : i + 1];
      if (!isOf(a, level) || !isOf(b, level) || !creases.isSharp(a, b)) continue;
      // Both levels' squares have sides; diagonals lie in none of them.
      const std::optional<Int3> square = sharedSquare(seam.keys[a], seam.keys[b], faceAxis(face), creases.cell());
      if (square) creases.add(a, b, *square, faceAxis(face));
    }
    creases.place();
  }
  RawVector<uint32_t> indices(memory);
  indices.reserve(triangles_end);
  for (size_t i = 0; i < triangles_end; i += 3) {
    std::array<uint32_t, 3> corners, middles;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = seam.indices[i + k], b = seam.indices[i + (k + 1) % 3];
      corners[k] = a;
      middles[k] = levels[0].faceVertex(a, b);
      if (middles[k] == Creases::kNoVertex) middles[k] = levels[1].faceVertex(a, b);
    }
    if (std::count(middles.begin(), middles.end(), Creases::kNoVertex) == 3) {
      indices.insert(indices.end(), corners.begin(), corners.end());
    } else {
      divide(corners, middles, indices);
    }
  }
  seam.indices = std::move(indices);
  hashPart(seam);
}

}  // namespace sgm
