#pragma once
// Derives the keys of a part that comes without keys, from a device or a file, from its packed vertices.

#include "mesh/chunk.h"
#include "mesh/fans.h"

namespace sgm {

/// Replaces part.keys by those that polygonizeBody and polygonizeSeam produce. number: 0 for a body, 1 + Face for a
/// seam, whose lateral vertices depend on the coarser blocks around the chunk (mesh/seam.h). Throws std::bad_alloc.
void deriveKeys(const ChunkGrid& grid, int number, Neighbourhood coarser, MeshPart& part);

}  // namespace sgm
