#pragma once
// Checks that every set of chunks that can be drawn together (a frame) has a closed surface. There are too many frames
// to check each; instead, each pair of borders that may meet is checked.
//
// A frame consists of the leaves of an octree of chunks. A chunk's mesh consists of its body and of seams, which
// connect the body to coarser neighbours. Every frame is closed if these borders fit:
// - the bodies of two neighbours of one level, at their common face
// - a seam and the body of its own chunk, at the seam's face
// - a seam and the body of the coarser chunk, in a quarter of the coarser chunk's face
// - the ends of all seams that may meet along an edge of their chunks (any of them may be in a frame)

#include <array>
#include <functional>
#include <string>
#include <unordered_map>

#include "mesh/packed_mesh.h"
#include "store/tile.h"

namespace sgm::store {

/// A hash of a border of a mesh: over all of its directed edges, the sum of the hash of the edge minus the hash of the
/// reversed edge. The hashes of two borders that fit add up to 0.
using EdgeSum = uint64_t;

/// The hashes of the borders of one part (body or seam) of a chunk's mesh. Coordinates are relative to the part's own
/// chunk, or to the finer chunk at the border, so the hashes depend only on the part's bytes, and not on the chunk's
/// position.
struct BorderSums {
  std::array<EdgeSum, 6> own{};  ///< for a body: the border at each face; for a seam: only the border to its own
                                 ///< chunk's body
  /// for a body: the border in each quarter of each face, in the coordinates of the finer neighbour's seam there
  std::array<std::array<EdgeSum, 4>, 6> quarters{};
  EdgeSum coarser = 0;            ///< for a seam: the border to the coarser chunk's body
  std::array<EdgeSum, 4> ends{};  ///< for a seam: its ends at the low and the high side of axis u, then of axis v
  EdgeSum stray = 0;              ///< for a seam: all other open edges; 0 unless the seam has a hole
  friend bool operator==(const BorderSums&, const BorderSums&) = default;
};

/// Computes the hashes of a part's borders. part: 0 for the body, 1 + Face for a seam. Throws std::bad_alloc.
BorderSums bordersOf(const PackedMesh& mesh, int part);

/// Checks a region's chunks, which are added in any order, each once. Stores only the borders whose counterpart has not
/// been added yet.
class Closure {
 public:
  /// Receives the description of a problem.
  using Tell = std::function<void(const std::string&)>;

  /// region: must outlive this object. tell: called for each pair of borders that does not fit.
  Closure(const BakedRegion& region, Tell tell) : region_(region), tell_(std::move(tell)) {}

  /// Adds a chunk. parts: the border hashes of its body and seams; null for a part without triangles. Throws
  /// std::bad_alloc.
  void add(const ChunkKey& chunk, const std::array<const BorderSums*, 7>& parts);
  /// Reports the borders that have no counterpart. Call it after all chunks of the region have been added.
  void finish();
  /// Returns the number of borders that were compared with their counterpart; empty borders do not count.
  uint64_t borders() const { return borders_; }

 private:
  /// The kinds of borders: between two bodies; between a seam and the coarser body; at the ends of seams along an edge.
  enum class Kind : uint8_t { bodies, levels, ends };
  /// Identifies a border by a chunk and a number. bodies: the chunk on the low side, and the axis; levels: the finer
  /// chunk, and its face; ends: the chunk whose lowest edge along an axis is the border, and this axis.
  struct Border {
    Kind kind;
    uint8_t number;
    ChunkKey chunk;
    friend auto operator<=>(const Border&, const Border&) = default;
  };
  struct BorderHash {
    size_t operator()(const Border& border) const;
  };
  struct Sides {
    /// kinds `bodies` and `levels`: sum of the hashes added so far, which is 0 if the two sides fit; kind `ends`: the
    /// hash that all ends must have
    EdgeSum sum = 0;
    int count = 0;
    bool differ = false;  ///< only for borders of kind `ends`: true if two ends have different hashes
  };

  void addBodies(const ChunkKey& chunk, const BorderSums& body);
  void addSeam(const ChunkKey& chunk, int face, const BorderSums& body, const BorderSums& seam);
  void addToFiner(const ChunkKey& chunk, const BorderSums& body);
  void addPair(const Border& border, EdgeSum sum);
  void addEnd(const ChunkKey& chunk, int face, int side, EdgeSum sum);
  int endsAt(const Border& border) const;
  void tell(const Border& border) const;

  const BakedRegion& region_;
  const Tell tell_;
  std::unordered_map<Border, Sides, BorderHash> open_;
  uint64_t borders_ = 0;
};

}  // namespace sgm::store
