#pragma once
// Identifies the vertices of different meshes that are the same vertex of the drawn surface.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "mesh/chunk.h"
#include "mesh/fans.h"

namespace sgm::cli {

/// Edge length of a chunk in the units of VertexPlace.
inline constexpr int kChunkEdge = kChunkCells * kSubcell;

/// The members of an sgm_vertex that identify the vertex.
struct VertexPlace {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;
};

/// A seam: the face of the chunk over which it lies, and the fan numbers that identify its lateral vertices (at corners
/// where two levels meet).
struct SeamOf {
  Face face = Face::x_lo;
  SeamFans fans{};
};

/// The key that identifies a vertex on the whole surface, by the rules of sgm_vertex_kind. seam: null for a vertex of a
/// body. Returns nullopt if the vertex is invalid: it lies on no grid edge, not in the seam's face, or has a kind that
/// a body cannot have.
std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam);

struct VertexKeyHash {
  size_t operator()(const VertexKey& key) const;
};

bool isFeature(const VertexPlace& vertex);

/// Whether the vertex lies on no face of its chunk, so that no other chunk can share it. Always false for feature
/// vertices, which another chunk may share even if they lie on no face.
bool isInside(const VertexPlace& vertex);

}  // namespace sgm::cli
