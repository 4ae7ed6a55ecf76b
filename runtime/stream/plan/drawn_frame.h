#pragma once
// A committed frame, that is, everything drawn at one time, and the step between two frames.

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
  uint8_t seams = 0;          ///< drawn seams, bit (1 << Face)
  Neighbourhood coarser = 0;  ///< the blocks of coarser chunks around it, if a seam is drawn; else 0
};

/// Immutable. The union of its bodies and drawn seams is a closed surface.
struct DrawnFrame {
  uint64_t number = 0;
  uint64_t edits = 0;  ///< number of the state (WorldState) shown
  Octree tree;
  std::vector<DrawnChunk> drawn;  ///< by key

  explicit DrawnFrame(Octree tree_in) : tree(std::move(tree_in)) {}
  /// Null if the chunk is not drawn or is empty.
  std::shared_ptr<const ChunkSurface> find(const ChunkKey& key) const;
};

/// Returns a leaf's surface with at least these seams; null if it is empty.
using SurfaceOfLeaf = std::function<std::shared_ptr<const ChunkSurface>(const ChunkKey&, uint8_t seams)>;

/// The frame that draws a tree.
DrawnFrame drawFrame(const Octree& tree, const SurfaceOfLeaf& surface);

struct FrameChange {
  enum class Kind {
    shown,     ///< newly drawn
    replaced,  ///< drawn with another surface
    seams,     ///< the same surface, with other seams or among other neighbours
    removed,   ///< no longer drawn; surface is null
  };
  Kind kind = Kind::shown;
  DrawnChunk chunk;
};

/// The changes from one frame to another, by key. Applied together they keep the surface closed; a part of them does
/// not.
std::vector<FrameChange> changesBetween(const DrawnFrame& from, const DrawnFrame& to);

/// The sums over a frame with measured surfaces, in its order: the same bits wherever the surfaces come from.
measure::SurfaceSums measuresOf(const DrawnFrame& frame);

}  // namespace sgm
