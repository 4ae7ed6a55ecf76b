#pragma once
// A committed frame: what is drawn at one time, and the step from one such frame to another.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "chunk/chunk_surface.h"
#include "stream/plan/octree.h"

namespace sgm {

/// A drawn chunk that has triangles or anchors.
struct DrawnChunk {
  ChunkKey key;
  std::shared_ptr<const ChunkSurface> surface;
  uint8_t seams = 0;          ///< those drawn, bit (1 << Face)
  Neighbourhood coarser = 0;  ///< the blocks around of coarser chunks, where a seam is drawn; else 0
};

/// Immutable. The union of its bodies and drawn seams is a closed surface.
struct DrawnFrame {
  uint64_t number = 0;
  uint64_t edits = 0;  ///< number of the state (WorldState) that it shows
  Octree tree;
  std::vector<DrawnChunk> drawn;  ///< by key

  explicit DrawnFrame(Octree tree_in) : tree(std::move(tree_in)) {}
  /// Null where the chunk is not drawn, or empty.
  std::shared_ptr<const ChunkSurface> find(const ChunkKey& key) const;
};

/// A leaf's surface, which has at least these seams; null where it is empty.
using SurfaceOfLeaf = std::function<std::shared_ptr<const ChunkSurface>(const ChunkKey&, uint8_t seams)>;

/// The frame that draws a tree.
DrawnFrame drawFrame(const Octree& tree, const SurfaceOfLeaf& surface);

struct FrameChange {
  enum class Kind {
    shown,     ///< drawn from now on
    replaced,  ///< drawn with another surface
    seams,     ///< the same surface, with other seams or among other neighbours
    removed,   ///< not drawn any more; surface is null
  };
  Kind kind = Kind::shown;
  DrawnChunk chunk;
};

/// The changes from one frame to another, by key. All of them together lead from closed to closed; a part of them does
/// not.
std::vector<FrameChange> changesBetween(const DrawnFrame& from, const DrawnFrame& to);

/// Of a frame whose surfaces were measured, in its order: the same bits wherever they come from.
measure::SurfaceSums measuresOf(const DrawnFrame& frame);

}  // namespace sgm
