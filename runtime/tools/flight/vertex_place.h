#pragma once
// Which vertices of meshes are the same vertex of the drawn surface.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "mesh/chunk.h"
#include "mesh/fans.h"

namespace sgm::cli {

/// Edge of a chunk in the units of VertexPlace.
inline constexpr int kChunkEdge = kChunkCells * kSubcell;

/// The words of an sgm_vertex that identify the vertex.
struct VertexPlace {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;
};

/// The seam that a vertex belongs to.
struct SeamOf {
  Face face = Face::x_lo;
  SeamFans fans{};
};

/// The key of a vertex by the rules of sgm_vertex_kind; seam is null for a vertex of a body. nullopt if the vertex is
/// invalid: it lies on no edge, not in the seam's face, or has a kind that a body does not have.
std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam);

struct VertexKeyHash {
  size_t operator()(const VertexKey& key) const;
};

bool isFeature(const VertexPlace& vertex);

/// True if the vertex lies on no face of its chunk, so that no other chunk can share it. False for features, which may
/// lie off their faces.
bool isInside(const VertexPlace& vertex);

}  // namespace sgm::cli
