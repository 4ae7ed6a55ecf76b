#pragma once
// Lists the meshes that draw an octree: the body of each leaf, and its seams towards coarser leaves and towards virtual
// nodes (undrawn roots, octree.h).

#include <vector>

#include "chunk/mesh_chunks.h"
#include "stream/plan/octree.h"

namespace sgm {

/// Returns one request per leaf, in the order of Octree::leaves(), with exactly the seams that are drawn. Together the
/// meshes form a closed surface: outer faces are closed against the domain's own state (solid or void; octree.h).
std::vector<ChunkRequest> frameRequests(const Octree& tree);

}  // namespace sgm
