#pragma once
// Meshes a region of one level as a single mesh, for the surfaces of the C interface and the files of the command.

#include "chunk/mesh_chunks.h"
#include "mesh/weld.h"
#include "stream/plan/octree.h"

namespace sgm {

struct RegionMesh {
  WorldMesh mesh;
  IntBox extent;  ///< the region grown to whole chunks; hi is excluded
  uint64_t chunks = 0;
  /// counted like cubes: with those on the low faces, without those on the high faces; 32^3 samples per chunk
  uint64_t solid_samples = 0;
  /// number of loops left without sharp features, because these would make the surface invalid
  uint64_t rounded = 0;
  ContentHash hash;  ///< hash of the set of the chunks' meshes (hashParts)

  explicit RegionMesh(std::pmr::memory_resource* memory) : mesh(memory) {}
};

/// Meshes lo <= p < hi, grown outward to whole chunks. Positions are relative to the world's origin if the extent lies
/// within 4,096 m of it (float32 then keeps them to 1/4,096 m or better), else to the extent's lowest corner. sharp:
/// with sharp features, without duplicated vertices (mesh/split_creases.h prepares them for drawing). Errors: range if
/// the extent leaves the world; limit; those of meshChunks and weld.
Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              int level, uint64_t max_chunks, bool sharp, const Progress& progress = {});

/// Meshes the same region in chunks of several levels: those chunks of the tree's coarsest level that meet the region,
/// split as in the tree. solid_samples counts the samples of each level without scaling. Precondition: the tree
/// satisfies its rules, and all virtual nodes that meet the region, or touch a node that does, are split, except at the
/// ends of the world. Errors: those of the other meshRegion.
Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              const Octree& tree, uint64_t max_chunks, bool sharp, const Progress& progress = {});

}  // namespace sgm
