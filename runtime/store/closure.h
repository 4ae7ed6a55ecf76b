#pragma once
// Checks that every drawable frame of a store is closed: not frame by frame, which are too many, but border by border.
//
// Every frame of an octree's leaves is closed if these pairs fit: the bodies of two neighbours of one level, at their
// common face; a seam and its own chunk's body, at its face; a seam and the coarser chunk's body, in a quarter of the
// coarser chunk's face; and the ends of all seams that may meet along one edge of their chunks, some of which are in a
// frame.

#include <array>
#include <functional>
#include <string>
#include <unordered_map>

#include "mesh/packed_mesh.h"
#include "store/tile.h"

namespace sgm::store {

/// A sum over the directed edges in a border: a hash of each edge minus the hash of its reverse. The sums of two sides
/// that fit add up to 0.
using EdgeSum = uint64_t;

/// The sums of a part's borders, each in the coordinates of the part's chunk or of the finer chunk: so they depend on
/// the part's bytes alone.
struct BorderSums {
  std::array<EdgeSum, 6> own{};  ///< of a body by face; of a seam, over its face, at its own chunk's body
  std::array<std::array<EdgeSum, 4>, 6> quarters{};  ///< of a body by face, in the coordinates of its finer neighbours'
                                                     ///< seams
  EdgeSum coarser = 0;                               ///< of a seam, at the coarser chunk's body
  std::array<EdgeSum, 4> ends{};                     ///< of a seam: at the low and high border along u, then along v
  EdgeSum stray = 0;                                 ///< of a seam, all other edges: 0 unless it has a hole
  friend bool operator==(const BorderSums&, const BorderSums&) = default;
};

/// part: 0 for a body, 1 + Face for a seam. Throws std::bad_alloc.
BorderSums bordersOf(const PackedMesh& mesh, int part);

/// Takes the chunks of one region in any order, each once. Keeps only borders whose other side is still to come.
class Closure {
 public:
  /// Receives the description of a problem.
  using Tell = std::function<void(const std::string&)>;

  /// region: must outlive it.
  Closure(const BakedRegion& region, Tell tell) : region_(region), tell_(std::move(tell)) {}

  /// Adds a chunk's body and seams; null for a part without triangles. Throws std::bad_alloc.
  void add(const ChunkKey& chunk, const std::array<const BorderSums*, 7>& parts);
  /// Call when all chunks of the region have been added.
  void finish();
  /// The number of borders with edges whose two sides were compared.
  uint64_t borders() const { return borders_; }

 private:
  enum class Kind : uint8_t { bodies, levels, ends };
  /// bodies: the lower chunk, and the axis. levels: the finer chunk, and its face. ends: the chunk whose lowest edge
  /// along an axis it is, and that axis.
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
    EdgeSum sum = 0;  ///< of the two sides; for ends: the sum that each must have
    int count = 0;
    bool differ = false;  ///< for ends
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
