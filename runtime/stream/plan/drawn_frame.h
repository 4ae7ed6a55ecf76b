#pragma once
// A committed frame (everything that is drawn at one time), and the changes between two frames.

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
  uint8_t seams = 0;          ///< mask of the drawn seams: bit (1 << Face)
  Neighbourhood coarser = 0;  ///< if a seam is drawn: the blocks of coarser chunks around it; otherwise 0
};

/// Immutable. The union of its bodies and drawn seams is a closed surface.
struct DrawnFrame {
  uint64_t number = 0;
  uint64_t edits = 0;  ///< number of the state (WorldState) that the frame shows
  Octree tree;
  std::vector<DrawnChunk> drawn;  ///< sorted by key

  explicit DrawnFrame(Octree tree_in) : tree(std::move(tree_in)) {}
  /// Returns the surface of a chunk; null if the chunk is not drawn or is empty.
  std::shared_ptr<const ChunkSurface> find(const ChunkKey& key) const;
};

/// Returns the surface of a leaf with at least these seams; null if the leaf is empty.
using SurfaceOfLeaf = std::function<std::shared_ptr<const ChunkSurface>(const ChunkKey&, uint8_t seams)>;

/// Returns the frame that draws a tree.
DrawnFrame drawFrame(const Octree& tree, const SurfaceOfLeaf& surface);

struct FrameChange {
  enum class Kind {
    shown,     ///< the chunk is newly drawn
    replaced,  ///< the chunk is drawn with another surface
    seams,     ///< the chunk has the same surface, but other seams or other coarser neighbours
    removed,   ///< the chunk is no longer drawn; its surface is null
  };
  Kind kind = Kind::shown;
  DrawnChunk chunk;
};

/// Returns the changes from one frame to another, sorted by key. Applied together they keep the surface closed; a
/// subset of them does not.
std::vector<FrameChange> changesBetween(const DrawnFrame& from, const DrawnFrame& to);

/// Returns the sums over the measures of a frame's surfaces, in the frame's order: the same bits regardless of where
/// the surfaces came from.
measure::SurfaceSums measuresOf(const DrawnFrame& frame);

}  // namespace sgm
