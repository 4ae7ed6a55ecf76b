#pragma once
// The keys of a part that came without them, from another device or a file: what its packed vertices say.

#include "mesh/chunk.h"
#include "mesh/fans.h"

namespace sgm {

/// Replaces part.keys by those that polygonizeBody and polygonizeSeam give. number: 0 for a body, 1 + Face for a seam,
/// whose lateral vertices need to know which blocks around are coarser (mesh/seam.h). Throws std::bad_alloc.
void deriveKeys(const ChunkGrid& grid, int number, Neighbourhood coarser, MeshPart& part);

}  // namespace sgm
