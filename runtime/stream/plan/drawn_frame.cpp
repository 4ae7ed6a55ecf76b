#include "stream/plan/drawn_frame.h"

#include <algorithm>

namespace sgm {

namespace {

bool byKey(const DrawnChunk& a, const DrawnChunk& b) { return a.key < b.key; }

}  // namespace

std::shared_ptr<const ChunkSurface> DrawnFrame::find(const ChunkKey& key) const {
  const auto at = std::lower_bound(drawn.begin(), drawn.end(), key,
                                   [](const DrawnChunk& chunk, const ChunkKey& k) { return chunk.key < k; });
  return at != drawn.end() && at->key == key ? at->surface : nullptr;
}

DrawnFrame drawFrame(const Octree& tree, const SurfaceOfLeaf& surface) {
  DrawnFrame frame(tree);
  for (const ChunkKey& leaf : tree.leaves()) {
    const uint8_t seams = coarserFaces(tree, leaf);
    std::shared_ptr<const ChunkSurface> drawn = surface(leaf, seams);
    if (drawn == nullptr) continue;
    frame.drawn.push_back({leaf, std::move(drawn), seams, seams != 0 ? coarserBlocks(tree, leaf) : 0});
  }
  std::sort(frame.drawn.begin(), frame.drawn.end(), byKey);
  return frame;
}

std::vector<FrameChange> changesBetween(const DrawnFrame& from, const DrawnFrame& to) {
  using Kind = FrameChange::Kind;
  std::vector<FrameChange> changes;
  auto old = from.drawn.begin();
  for (const DrawnChunk& now : to.drawn) {
    for (; old != from.drawn.end() && old->key < now.key; ++old) {
      changes.push_back({Kind::removed, {old->key, nullptr, 0, 0}});
    }
    if (old == from.drawn.end() || old->key != now.key) {
      changes.push_back({Kind::shown, now});
      continue;
    }
    if (old->surface != now.surface) {
      changes.push_back({Kind::replaced, now});
    } else if (old->seams != now.seams || old->coarser != now.coarser) {
      changes.push_back({Kind::seams, now});
    }
    ++old;
  }
  for (; old != from.drawn.end(); ++old) changes.push_back({Kind::removed, {old->key, nullptr, 0, 0}});
  return changes;
}

measure::SurfaceSums measuresOf(const DrawnFrame& frame) {
  measure::SurfaceSums sums;
  for (const DrawnChunk& chunk : frame.drawn) {
    if (chunk.surface->measures) sums.add(*chunk.surface->measures, chunk.surface->grid, true, chunk.seams);
  }
  return sums;
}

}  // namespace sgm
