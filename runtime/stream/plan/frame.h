#pragma once
// The meshes of an octree: each leaf's body, and the seams towards coarser leaves and outer virtual nodes.

#include <vector>

#include "chunk/mesh_chunks.h"
#include "stream/plan/octree.h"

namespace sgm {

/// Returns one request for each leaf, in the order of Octree::leaves(), with exactly the drawn seams. Together the
/// meshes form a closed surface: the outer faces are closed against the domain's own state.
std::vector<ChunkRequest> frameRequests(const Octree& tree);

}  // namespace sgm
