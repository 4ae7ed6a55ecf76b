#pragma once
// The meshes that an octree draws: each leaf's body, and the seams towards coarser leaves and the outer virtual ones.

#include <vector>

#include "chunk/mesh_chunks.h"
#include "stream/plan/octree.h"

namespace sgm {

/// One request a leaf, in the order of Octree::leaves(), each with exactly the seams that are drawn. What comes of them
/// is together a closed surface: the outer faces are cut off against the domain's own state.
std::vector<ChunkRequest> frameRequests(const Octree& tree);

}  // namespace sgm
