#pragma once
// Computes the volume of the solid in a region by the divergence theorem, from the region's surface and the faces that
// close it where the region's border cuts the solid.

#include "chunk/mesh_chunks.h"
#include "mesh/weld.h"

namespace sgm {

/// Returns the vector from a place to a chunk's origin, in metres.
std::array<double, 3> originFrom(Int3 place, const ChunkGrid& grid);

/// Returns a third of the flux of the position vector through the faces that close the region's surface at its border,
/// in m3. Position vectors are relative to the region's lowest corner. keys: the region's chunks, in order z, y, x.
/// Errors: those of meshChunks.
Result<double> borderFlux(const WorldField& world, Backend& backend, JobSystem& jobs, std::span<const ChunkKey> keys,
                          bool sharp);

/// Same as the borderFlux() above, but does not mesh the chunks again: computes the flux from the open edges of the
/// region's welded mesh, which bound the missing faces. mesh: has one vertex per key. level: level of the mesh. Errors:
/// those of compiling a field.
Result<double> borderFlux(const WorldField& world, const IntBox& region, int level, const WorldMesh& mesh);

/// Returns the volume in m3 of the solid in the region. The domain may be solid or void. flux: a third of the flux of
/// the position vector, relative to any origin, through the solid's surface and the faces that close it.
double solidVolume(const WorldField& world, const IntBox& region, double flux);

}  // namespace sgm
