#pragma once
// Checks that every frame that can be drawn from a store is closed. There are too many frames to check each; instead,
// each pair of borders that may meet is checked.
//
// Every frame, that is, the leaves of an octree, is closed if these pairs of borders fit: the bodies of two neighbours
// of one level, at their common face; a seam and the body of its own chunk, at the seam's face; a seam and the coarser
// chunk's body, in a quarter of the coarser chunk's face; and the ends of all seams that may meet along an edge of
// their chunks (any of these may be in a frame).

#include <array>
#include <functional>
#include <string>
#include <unordered_map>

#include "mesh/packed_mesh.h"
#include "store/tile.h"

namespace sgm::store {

/// A hash of a border: the sum, over its directed edges, of the hash of each edge minus the hash of the reversed edge.
/// The sums of two borders that fit add up to 0.
using EdgeSum = uint64_t;

/// The sums of a part's borders. Each is in the coordinates of the part's own chunk, or of the finer chunk at the
/// border, so that it depends only on the part's bytes.
struct BorderSums {
  std::array<EdgeSum, 6> own{};  ///< body: by face; seam: only at its face, towards the body of its own chunk
  /// body: by face and quarter, in the coordinates of the seams of the finer neighbours there
  std::array<std::array<EdgeSum, 4>, 6> quarters{};
  EdgeSum coarser = 0;            ///< seam: towards the body of the coarser chunk
  std::array<EdgeSum, 4> ends{};  ///< seam: at the low and the high border along u, then along v
  EdgeSum stray = 0;              ///< seam: all other edges; 0 unless the seam has a hole
  friend bool operator==(const BorderSums&, const BorderSums&) = default;
};

/// Computes the sums of a part. part: 0 for a body, 1 + Face for a seam. Throws std::bad_alloc.
BorderSums bordersOf(const PackedMesh& mesh, int part);

/// Receives the chunks of one region in any order, each once. Stores only borders whose other side has not arrived yet.
class Closure {
 public:
  /// Receives the description of a problem.
  using Tell = std::function<void(const std::string&)>;

  /// region: must outlive this object.
  Closure(const BakedRegion& region, Tell tell) : region_(region), tell_(std::move(tell)) {}

  /// Adds the sums of a chunk's body and seams; null for a part without triangles. Throws std::bad_alloc.
  void add(const ChunkKey& chunk, const std::array<const BorderSums*, 7>& parts);
  /// Reports the borders that remain open. Call it when all chunks of the region have been added.
  void finish();
  /// Returns the number of borders with edges that were compared from both sides.
  uint64_t borders() const { return borders_; }

 private:
  /// The pairs of borders that must fit: two bodies; a seam and the coarser body; ends of seams along an edge.
  enum class Kind : uint8_t { bodies, levels, ends };
  /// Identifies a border. bodies: the lower chunk and the axis; levels: the finer chunk and its face; ends: the chunk
  /// whose lowest edge along an axis it is, and that axis.
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
    EdgeSum sum = 0;  ///< bodies, levels: sum of the two sides so far; ends: the sum that each end must have
    int count = 0;
    bool differ = false;  ///< ends only: true if two ends have different sums
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
