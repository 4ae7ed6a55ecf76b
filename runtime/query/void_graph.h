#pragma once
// The voids of a region for agents of one size, as a graph: the voids of its chunks and their connections.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "query/chunk_voids.h"
#include "world/chunk_order.h"

namespace sgm {

/// A connected void of a region.
struct RegionVoid {
  uint64_t samples = 0;
  bool sealed = false;  ///< it does not touch the region's border
  friend auto operator<=>(const RegionVoid&, const RegionVoid&) = default;
};

/// Takes chunks one by one, and keeps their voids and the contacts between voids of adjacent chunks. Of the samples it
/// keeps only the faces of the last layer: two bytes for each of a face's 1,089 samples.
class VoidGraph {
 public:
  /// order: of the region's chunks. ways: keep the data for chunksOfWay().
  VoidGraph(const ChunkOrder& order, bool ways, std::pmr::memory_resource* memory);

  /// Adds the next chunk of the order. Returns false if the region has more voids than 32 bits can number.
  bool add(ChunkVoids chunk);

  /// The graph's number for a void of the last added chunk.
  uint32_t numberOf(uint32_t void_in_chunk) const { return first_.back() + void_in_chunk; }

  // For use after the last chunk was added:

  bool joined(uint32_t a, uint32_t b) { return rootOf(a) == rootOf(b); }
  /// The number of samples in the whole void that this one belongs to.
  uint64_t samplesOf(uint32_t number);
  /// The voids of the region, largest first.
  std::vector<RegionVoid> voids();

  /// The chunks of a path from a to b, by their numbers in the order: those with the shortest sum of straight lines
  /// through the middles of the face parts that the voids share. A chunk appears each time that the path enters it;
  /// each chunk shares a face with the previous one. from, to: samples of a and b, counted from the region's lowest.
  /// Preconditions: joined(a, b), and `ways` was set.
  std::vector<uint32_t> chunksOfWay(uint32_t a, Int3 from, uint32_t b, Int3 to) const;

 private:
  using Place = std::array<double, 3>;  ///< in samples
  struct Portal {
    std::array<uint32_t, 2> sides{};  ///< voids that share these samples of a face
    Place middle{};
    uint32_t samples = 0;
  };
  using FaceVoids = std::pmr::vector<uint16_t>;
  /// A high face of a chunk, for the chunk's next neighbour.
  struct OpenFace {
    FaceVoids voids;
    uint32_t first = 0;  ///< number of the chunk's first void
  };

  uint32_t chunkOf(uint32_t number) const;
  uint32_t rootOf(uint32_t number);
  void join(const OpenFace& low, const FaceVoids& high, int axis, Int3 corner);
  std::vector<std::vector<uint32_t>> portalsByVoid() const;

  ChunkOrder order_;
  bool ways_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<uint32_t> first_;    ///< number of each chunk's first void
  std::pmr::vector<uint32_t> parent_;   ///< union-find over voids; roots are the lowest
  std::pmr::vector<uint32_t> samples_;  ///< samples of each void in its chunk
  std::pmr::vector<uint8_t> open_;      ///< 1: touches the region's border
  std::pmr::vector<Portal> portals_;    ///< only if `ways` is set
  /// By axis: the high faces of the last chunks, up to the neighbour along the axis.
  std::array<std::pmr::vector<OpenFace>, 3> awaiting_;
};

}  // namespace sgm
