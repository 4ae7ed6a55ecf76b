#include "stream/plan/frame.h"

namespace sgm {

std::vector<ChunkRequest> frameRequests(const Octree& tree) {
  std::vector<ChunkRequest> requests;
  for (const ChunkKey& leaf : tree.leaves()) {
    ChunkRequest request;
    request.key = leaf;
    request.seams = coarserFaces(tree, leaf);
    request.coarser = coarserBlocks(tree, leaf);
    request.outermost = leaf.level == tree.top();
    requests.push_back(request);
  }
  return requests;
}

}  // namespace sgm
