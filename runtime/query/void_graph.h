#pragma once
// The voids of a region for agents of one size, as a graph whose nodes are voids of single chunks.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "query/chunk_voids.h"
#include "world/chunk_order.h"

namespace sgm {

/// A connected void of a region. It may extend over several chunks.
struct RegionVoid {
  uint64_t samples = 0;
  bool sealed = false;  ///< true if the void does not touch the region's border
  friend auto operator<=>(const RegionVoid&, const RegionVoid&) = default;
};

/// A graph that is built chunk by chunk: it stores the voids, and the contacts between voids of adjacent chunks. It
/// keeps no samples except those in the high faces of the last layer of chunks, with two bytes for each of a face's
/// 1,089 samples.
class VoidGraph {
 public:
  /// order: the order of the region's chunks. ways: whether to store the data that chunksOfWay() needs.
  VoidGraph(const ChunkOrder& order, bool ways, std::pmr::memory_resource* memory);

  /// Adds the voids of the next chunk of the order. Returns false if the region has more voids than 32 bits can number.
  bool add(ChunkVoids chunk);

  /// Converts a void's number in the chunk that was added last to its number in the graph.
  uint32_t numberOf(uint32_t void_in_chunk) const { return first_.back() + void_in_chunk; }

  // Precondition of the following public functions: add() was called for all chunks of the region.

  bool joined(uint32_t a, uint32_t b) { return rootOf(a) == rootOf(b); }
  /// Returns the number of samples in the whole connected void that contains the chunk's void `number`.
  uint64_t samplesOf(uint32_t number);
  /// Returns the connected voids of the region, largest first.
  std::vector<RegionVoid> voids();

  /// Returns the chunks of a path from void a to void b, as numbers of the order. Chooses the sequence of voids with
  /// the shortest sum of straight lines through the middles of the portals (the parts of faces that two voids share). A
  /// chunk appears each time that the path enters it; each chunk shares a face with the previous one. from, to: samples
  /// of a and b, relative to the region's lowest sample. Preconditions: joined(a, b), and `ways` was true.
  std::vector<uint32_t> chunksOfWay(uint32_t a, Int3 from, uint32_t b, Int3 to) const;

 private:
  using Place = std::array<double, 3>;  ///< a position in samples, relative to the region's lowest sample
  struct Portal {
    std::array<uint32_t, 2> sides{};  ///< the two voids that share the portal's samples
    Place middle{};
    uint32_t samples = 0;
  };
  using FaceVoids = std::pmr::vector<uint16_t>;
  /// A high face of a chunk, stored until the next chunk along the axis is added.
  struct OpenFace {
    FaceVoids voids;
    uint32_t first = 0;  ///< the number, in the graph, of the chunk's first void
  };

  uint32_t chunkOf(uint32_t number) const;
  uint32_t rootOf(uint32_t number);
  void join(const OpenFace& low, const FaceVoids& high, int axis, Int3 corner);
  std::vector<std::vector<uint32_t>> portalsByVoid() const;

  ChunkOrder order_;
  bool ways_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<uint32_t> first_;    ///< the number, in the graph, of each chunk's first void
  std::pmr::vector<uint32_t> parent_;   ///< union-find over voids; the root of a set is its lowest number
  std::pmr::vector<uint32_t> samples_;  ///< number of samples of each void in its own chunk
  std::pmr::vector<uint8_t> open_;      ///< for each void: 1 if it touches the region's border
  std::pmr::vector<Portal> portals_;    ///< contacts between voids; empty unless `ways` is set
  /// For each axis: high faces of the chunks that were added last. Each face waits here until the next chunk along the
  /// axis is added.
  std::array<std::pmr::vector<OpenFace>, 3> awaiting_;
};

}  // namespace sgm
