#pragma once
// Marching cubes over one chunk: one vertex per crossed edge, shared by all triangles around it.

#include "mesh/chunk.h"

namespace sgm {

/// Replaces the contents of part by the surface of the chunk. Canonical order of vertices: by the sample at the lower
/// end of the crossed edge (z, then y, then x), then x-edge, y-edge, z-edge. Canonical order of triangles: by cell (z,
/// y, x), then by loop (tables.h), then as triangulate.h outputs them. Crossed edges in a face of the chunk have
/// vertices in the chunk and in its neighbours, with bit-identical keys and positions. Fills x, y, z and the keys of
/// the vertices; sets material, normal, tag and part.hash to 0, for the caller to fill. Precondition: the chunk's high
/// corner, grid.origin + 32 * grid.cell, lies in the world. Thread-safe for different parts.
void polygonizeBody(const ChunkSamples& samples, const ChunkGrid& grid, MeshPart& part);

}  // namespace sgm
