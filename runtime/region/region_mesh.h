#pragma once
// A region of one level as a single mesh: what the C interface's surfaces and the command's files are made of.

#include "chunk/mesh_chunks.h"
#include "mesh/weld.h"
#include "stream/plan/octree.h"

namespace sgm {

struct RegionMesh {
  WorldMesh mesh;
  IntBox extent;  ///< the region grown to whole chunks; hi does not belong to it
  uint64_t chunks = 0;
  uint64_t solid_samples = 0;  ///< of the samples on the low faces and between, 32^3 a chunk
  uint64_t rounded = 0;        ///< places whose sharp features would make the surface invalid, and that have none
  ContentHash hash;            ///< of the set of its chunks' meshes

  explicit RegionMesh(std::pmr::memory_resource* memory) : mesh(memory) {}
};

/// Meshes lo <= p < hi, grown outward to whole chunks. Positions count from the world's origin where the extent lies
/// within 4,096 m of it (float32 then keeps them to 1/4,096 m or better), else from the extent's lowest corner.
/// sharp: with sharp features, each once (mesh/split_creases.h makes what is drawn). Errors: range where the extent
/// leaves the world; limit; those of meshChunks and weld.
Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              int level, uint64_t max_chunks, bool sharp, const Progress& progress = {});

/// The same region in chunks of several levels: those of the tree's coarsest level that meet it, as far as the tree has
/// split them. solid_samples counts those of each level as they are. Precondition: the tree is closed under its rules
/// and has split all virtual nodes that meet the region or touch one that does, but at the world's ends. Errors: those
/// of meshRegion.
Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              const Octree& tree, uint64_t max_chunks, bool sharp, const Progress& progress = {});

}  // namespace sgm
