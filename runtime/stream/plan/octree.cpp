#include "stream/plan/octree.h"

#include <algorithm>
#include <limits>

#include "mesh/chunk.h"

namespace sgm {

namespace {

ChunkKey across(const ChunkKey& key, int face) {
  ChunkKey k = key;
  k.at[face >> 1] += face & 1 ? 1 : -1;
  return k;
}

void appendLeaves(const Octree& tree, const ChunkKey& node, std::vector<ChunkKey>& leaves) {
  if (!tree.isSplit(node)) {
    leaves.push_back(node);
    return;
  }
  for (int i = 0; i < 8; ++i) appendLeaves(tree, childOf(node, i), leaves);
}

}  // namespace

Octree::Octree(int top, int32_t finest_cell) : top_(top), finest_cell_(finest_cell) {
  const int64_t edge = int64_t{kChunkCells} * finest_cell << (top + 1);
  // The world's lowest coordinate need not be a multiple of the edge. Division rounds towards 0, so the first virtual
  // node lies inside the world.
  first_virtual_ = static_cast<int32_t>(std::numeric_limits<int32_t>::min() / edge);
  last_virtual_ = static_cast<int32_t>(std::numeric_limits<int32_t>::max() / edge - 1);
}

ChunkKey Octree::leafAt(Int3 place) const {
  ChunkKey key{0, {}};
  for (int axis = 0; axis < 3; ++axis)
    key.at[axis] = static_cast<int32_t>(floorDiv(place[axis], int64_t{kChunkCells} * finest_cell_));
  while (key.level < top_ && !isSplit(parentOf(key))) key = parentOf(key);
  return key;
}

bool Octree::canSplit(const ChunkKey& node) const {
  if (node.level < 1 || node.level > top_ + 1) return false;
  const int up = top_ + 1 - node.level;
  for (int axis = 0; axis < 3; ++axis) {
    const int32_t place = node.at[axis] >> up;
    if (place < first_virtual_ || place > last_virtual_) return false;
  }
  return true;
}

bool Octree::split(ChunkKey node) {
  if (!canSplit(node)) return false;
  while (split_.insert(node) && node.level <= top_) node = parentOf(node);
  return true;
}

void Octree::merge(const ChunkKey& node) {
  if (!split_.erase(node) || node.level == 1) return;
  for (int i = 0; i < 8; ++i) merge(childOf(node, i));
}

std::vector<ChunkKey> Octree::splitNodes() const {
  std::vector<ChunkKey> nodes = split_.unordered();
  std::sort(nodes.begin(), nodes.end(),
            [](const ChunkKey& a, const ChunkKey& b) { return a.level != b.level ? a.level > b.level : a.at < b.at; });
  return nodes;
}

std::vector<ChunkKey> Octree::leaves() const {
  std::vector<ChunkKey> leaves;
  for (const ChunkKey& node : splitNodes()) {
    if (node.level <= top_) break;
    appendLeaves(*this, node, leaves);
  }
  return leaves;
}

void findBrokenRules(const Octree& tree, const ChunkKey& node, std::vector<BrokenRule>& broken) {
  if (node.level <= tree.top()) {
    for (int face = 0; face < 6; ++face) {
      const ChunkKey needed = parentOf(across(node, face));
      if (!tree.isSplit(needed)) broken.push_back({needed, needed, needed});
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) {
      const int u = 2 * ((axis + 1) % 3) + (side & 1), v = 2 * ((axis + 2) % 3) + (side >> 1);
      const ChunkKey a = across(node, u), b = across(node, v), crosswise = across(a, v);
      if (tree.isSplit(crosswise) && !tree.isSplit(a) && !tree.isSplit(b))
        broken.push_back({std::min(a, b), std::max(a, b), crosswise});
    }
  }
}

void refineToRules(Octree& tree) {
  std::vector<BrokenRule> broken;
  for (bool changed = true; changed;) {
    changed = false;
    for (const ChunkKey& node : tree.splitNodes()) {
      if (!tree.isSplit(node)) continue;  // already merged by an earlier iteration of this loop
      broken.clear();
      findBrokenRules(tree, node, broken);
      for (const BrokenRule& rule : broken) {
        changed = true;
        if (tree.split(rule.needed) || tree.split(rule.or_else)) continue;
        tree.merge(node);
        break;
      }
    }
  }
}

uint8_t coarserFaces(const Octree& tree, const ChunkKey& leaf) {
  uint8_t faces = 0;
  for (int face = 0; face < 6; ++face) {
    if (!tree.isSplit(parentOf(across(leaf, face)))) faces = static_cast<uint8_t>(faces | 1 << face);
  }
  return faces;
}

Neighbourhood coarserBlocks(const Octree& tree, const ChunkKey& leaf) {
  Neighbourhood blocks = 0;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!tree.isSplit(parentOf(neighbourOf(leaf, dx, dy, dz)))) blocks |= neighbourBit(dx, dy, dz);
      }
    }
  }
  return blocks;
}

}  // namespace sgm
