#pragma once
// The volume of the solid in a region by the divergence theorem: the region's surface is closed by the faces in which
// its border cuts the solid.

#include "chunk/mesh_chunks.h"
#include "mesh/weld.h"

namespace sgm {

/// From a place to a chunk's origin, metres.
std::array<double, 3> originFrom(Int3 place, const ChunkGrid& grid);

/// Cubic metres: a third of the flux of x about the region's lowest corner through the faces that close its surface
/// where its border cuts it. keys: the region's chunks, in order z, y, x. Errors: those of meshChunks.
Result<double> borderFlux(const WorldField& world, Backend& backend, JobSystem& jobs, std::span<const ChunkKey> keys,
                          bool sharp);

/// As the other borderFlux, from the region's welded mesh, whose open edges bound these faces: no chunk is meshed
/// again. mesh: with one vertex a key. level: of the mesh. Errors: those of compiling a field.
Result<double> borderFlux(const WorldField& world, const IntBox& region, int level, const WorldMesh& mesh);

/// Cubic metres, whatever the domain is made of. flux: a third of that of x about any place through the surface and the
/// faces that close it.
double solidVolume(const WorldField& world, const IntBox& region, double flux);

}  // namespace sgm
