#pragma once
// The volume of the solid in a region by the divergence theorem: the region's surface, closed by the faces where its
// border cuts the solid.

#include "chunk/mesh_chunks.h"
#include "mesh/weld.h"

namespace sgm {

/// The vector from a place to a chunk's origin, metres.
std::array<double, 3> originFrom(Int3 place, const ChunkGrid& grid);

/// Cubic metres: a third of the flux of x, relative to the region's lowest corner, through the faces that close its
/// surface at the border. keys: the region's chunks, in order z, y, x. Errors: those of meshChunks.
Result<double> borderFlux(const WorldField& world, Backend& backend, JobSystem& jobs, std::span<const ChunkKey> keys,
                          bool sharp);

/// The same from the region's welded mesh, whose open edges bound these faces, without meshing again. mesh: with one
/// vertex a key. level: of the mesh. Errors: those of compiling a field.
Result<double> borderFlux(const WorldField& world, const IntBox& region, int level, const WorldMesh& mesh);

/// Cubic metres, whatever the domain is made of. flux: a third of the flux of x, relative to any place, through the
/// surface and the faces that close it.
double solidVolume(const WorldField& world, const IntBox& region, double flux);

}  // namespace sgm
