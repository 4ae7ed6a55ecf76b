#pragma once
// Random octrees of chunks that keep the two rules of the level of detail: face neighbours at most one level apart, and
// no checkerboard of fine and coarse around a chunk edge.

#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "fields.h"

namespace sgm::test {

struct Leaf {
  Int3 origin;  // in lattice points
  int level = 0;
  friend auto operator<=>(const Leaf&, const Leaf&) = default;
};

class Octree {
 public:
  /// grid^3 roots of level levels - 1, split at random.
  Octree(uint64_t seed, int grid, int levels);

  const std::set<Leaf>& leaves() const { return leaves_; }
  int32_t size() const { return size_; }  ///< lattice points along a side
  bool contains(Int3 p) const;
  /// Precondition: contains(p). The leaf that the lattice cell from p upwards lies in.
  Leaf leafAt(Int3 p) const;
  /// Which of the blocks around a leaf belong to coarser leaves; those outside the tree do not.
  Neighbourhood coarserAround(const Leaf& leaf) const;

 private:
  void build(uint64_t key, Leaf leaf);
  void refine(Leaf leaf);
  bool tooSteep(const Leaf& leaf) const;
  bool findCheckerboard(Leaf& found) const;

  std::set<Leaf> leaves_;
  int levels_;
  int32_t size_;
};

/// Bodies and seams of one leaf each, in the octree's order.
struct LeafMesh {
  ChunkGrid grid;
  MeshPart body;
  std::vector<std::pair<Face, MeshPart>> seams;
};
std::vector<LeafMesh> meshOctree(const Octree& octree, const LatticeField& field);

/// The meshes of one leaf, given what is around it.
LeafMesh meshLeaf(const Leaf& leaf, Neighbourhood coarser, const LatticeField& field);

std::vector<const MeshPart*> allParts(const std::vector<LeafMesh>& meshes);

}  // namespace sgm::test
