#pragma once
// Random octrees of chunks that satisfy the two rules of levels of detail: face neighbours differ by at most one level,
// and no checkerboard of fine and coarse chunks surrounds a chunk edge.

#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "fields.h"

namespace sgm::test {

struct Leaf {
  Int3 origin;  // coordinates in lattice points
  int level = 0;
  friend auto operator<=>(const Leaf&, const Leaf&) = default;
};

class Octree {
 public:
  /// Begins with grid^3 root chunks of the level `levels` - 1, and splits chunks at random.
  Octree(uint64_t seed, int grid, int levels);

  const std::set<Leaf>& leaves() const { return leaves_; }
  int32_t size() const { return size_; }  ///< number of lattice points along a side
  bool contains(Int3 p) const;
  /// The leaf that contains the lattice cell whose lowest corner is p. Precondition: contains(p).
  Leaf leafAt(Int3 p) const;
  /// A flag for each block around a leaf: whether the block belongs to a coarser leaf. Flags of blocks outside the tree
  /// are not set.
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

/// The body and seams of one leaf.
struct LeafMesh {
  ChunkGrid grid;
  MeshPart body;
  std::vector<std::pair<Face, MeshPart>> seams;
};
std::vector<LeafMesh> meshOctree(const Octree& octree, const LatticeField& field);

/// Meshes one leaf. coarser: flags of the neighbouring blocks that are coarser.
LeafMesh meshLeaf(const Leaf& leaf, Neighbourhood coarser, const LatticeField& field);

std::vector<const MeshPart*> allParts(const std::vector<LeafMesh>& meshes);

}  // namespace sgm::test
