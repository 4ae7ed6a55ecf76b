#pragma once
// Marching cubes over one chunk: one vertex per crossed edge, shared by all triangles around it.

#include "mesh/chunk.h"

namespace sgm {

/// Replaces part by the surface of the chunk. Canonical order: vertices by owning sample (z, then y, then x; the sample
/// at the edge's lower end), then x-edge, y-edge, z-edge; triangles by cell (z, y, x), then loop (tables.h), then in
/// the order of triangulate.h. Crossed edges in the chunk's border belong to it and to its neighbours alike, with
/// bit-identical keys and positions. Fills x, y, z and the keys of the vertices; material, normal, tag and part.hash
/// are 0 and are filled by the caller. Precondition: grid.origin + 32 * grid.cell lies in the world. Thread-safe for
/// different parts.
void polygonizeBody(const ChunkSamples& samples, const ChunkGrid& grid, MeshPart& part);

}  // namespace sgm
