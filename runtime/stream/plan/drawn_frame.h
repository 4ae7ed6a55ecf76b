#pragma once
// A committed frame (all chunks that are drawn at one time), and the changes between two frames.

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
  Neighbourhood coarser = 0;  ///< the blocks around the chunk that belong to coarser chunks; 0 if no seam is drawn
};

/// All chunks that are drawn at one time. Together, their bodies and drawn seams are a closed surface. Immutable.
struct DrawnFrame {
  uint64_t number = 0;
  uint64_t edits = 0;  ///< number of the world state (WorldState) that the frame shows
  Octree tree;
  std::vector<DrawnChunk> drawn;  ///< drawn chunks, sorted by key

  explicit DrawnFrame(Octree tree_in) : tree(std::move(tree_in)) {}
  /// Returns the surface of a chunk; null if the chunk is not drawn, or has no surface.
  std::shared_ptr<const ChunkSurface> find(const ChunkKey& key) const;
};

/// Returns the surface of a leaf, with at least these seams; null if the leaf has no surface.
using SurfaceOfLeaf = std::function<std::shared_ptr<const ChunkSurface>(const ChunkKey&, uint8_t seams)>;

/// Returns the frame in which the leaves of an octree are drawn.
DrawnFrame drawFrame(const Octree& tree, const SurfaceOfLeaf& surface);

struct FrameChange {
  enum class Kind {
    shown,     ///< the chunk is drawn now, but was not drawn before
    replaced,  ///< the chunk is still drawn, but with another surface
    seams,     ///< the chunk has the same surface, but other seams or other coarser neighbours
    removed,   ///< the chunk is no longer drawn; its surface is null
  };
  Kind kind = Kind::shown;
  DrawnChunk chunk;
};

/// Returns the changes from one frame to another, sorted by key. All of them must be applied together: applying only
/// some would open the surface.
std::vector<FrameChange> changesBetween(const DrawnFrame& from, const DrawnFrame& to);

/// Adds up the measures of a frame's surfaces in the frame's order, so that the sums are bit-identical wherever the
/// surfaces came from.
measure::SurfaceSums measuresOf(const DrawnFrame& frame);

}  // namespace sgm
