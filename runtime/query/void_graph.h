#pragma once
// The voids of a region for agents of one size, as a graph: the voids of its chunks, and what joins them.

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

/// Takes in chunks one by one, and keeps of each its voids and how they touch those of its neighbours; of samples no
/// more than the faces of the last layer: two bytes for each of the 1,089 of a face.
class VoidGraph {
 public:
  /// order: of the region's chunks. ways: keep what chunksOfWay() needs.
  VoidGraph(const ChunkOrder& order, bool ways, std::pmr::memory_resource* memory);

  /// The next chunk of the order. False where the region has more voids than 32 bits can number.
  bool add(ChunkVoids chunk);

  /// The number of a void of the chunk that was added last.
  uint32_t numberOf(uint32_t void_in_chunk) const { return first_.back() + void_in_chunk; }

  // Once all chunks are there:

  bool joined(uint32_t a, uint32_t b) { return rootOf(a) == rootOf(b); }
  /// The samples of all the void that this one belongs to.
  uint64_t samplesOf(uint32_t number);
  /// Of the region, the largest ones first.
  std::vector<RegionVoid> voids();

  /// Chunks that a way from a to b leads through, by their numbers in the order: those at the shortest sum of
  /// straight lines through the middles of the faces' parts that the voids share. A chunk comes once each time that the
  /// way enters it; each shares a face with the one before. from, to: samples of the two, counted from the region's
  /// lowest. Preconditions: joined(a, b), and ways were asked for.
  std::vector<uint32_t> chunksOfWay(uint32_t a, Int3 from, uint32_t b, Int3 to) const;

 private:
  using Place = std::array<double, 3>;  ///< in samples
  struct Portal {
    std::array<uint32_t, 2> sides{};  ///< voids that share these samples of a face
    Place middle{};
    uint32_t samples = 0;
  };
  using FaceVoids = std::pmr::vector<uint16_t>;
  /// What a chunk's neighbour will ask: one of its high faces.
  struct OpenFace {
    FaceVoids voids;
    uint32_t first = 0;  ///< of the chunk's voids
  };

  uint32_t chunkOf(uint32_t number) const;
  uint32_t rootOf(uint32_t number);
  void join(const OpenFace& low, const FaceVoids& high, int axis, Int3 corner);
  std::vector<std::vector<uint32_t>> portalsByVoid() const;

  ChunkOrder order_;
  bool ways_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<uint32_t> first_;    ///< of each chunk's voids
  std::pmr::vector<uint32_t> parent_;   ///< union-find over voids; roots are the lowest
  std::pmr::vector<uint32_t> samples_;  ///< of each void in its chunk
  std::pmr::vector<uint8_t> open_;      ///< 1: touches the region's border
  std::pmr::vector<Portal> portals_;    ///< where ways are asked for
  /// By axis: high faces of the last chunks, as many as come before the neighbour along it.
  std::array<std::pmr::vector<OpenFace>, 3> awaiting_;
};

}  // namespace sgm
