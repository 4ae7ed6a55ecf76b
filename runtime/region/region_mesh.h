#pragma once
// Meshes a region as a single mesh, for the surfaces of the C interface and the files of the command line tool.

#include "chunk/mesh_chunks.h"
#include "mesh/weld.h"
#include "stream/plan/octree.h"

namespace sgm {

struct RegionMesh {
  WorldMesh mesh;
  IntBox extent;  ///< the region enlarged to whole chunks; hi is excluded
  uint64_t chunks = 0;
  /// number of solid samples, including those on the region's low faces, but not those on its high faces: 32^3 samples
  /// per chunk are counted
  uint64_t solid_samples = 0;
  /// number of loops (the surface's polygons in single cells) that were not sharpened, because sharp features would
  /// make the surface invalid
  uint64_t rounded = 0;
  ContentHash hash;  ///< hash of the set of the chunks' meshes (hashParts)

  explicit RegionMesh(std::pmr::memory_resource* memory) : mesh(memory) {}
};

/// Meshes the chunks of one level that meet the box lo <= p < hi. Positions are relative to the world's origin if the
/// extent lies within 4,096 m of it (float32 is then precise to 1/4,096 m or better), otherwise to the extent's lowest
/// corner. sharp: whether to sharpen features; the mesh then still has one vertex per key (mesh/split_creases.h
/// duplicates vertices at creases for drawing). Errors: range if the extent leaves the world; limit; those of
/// meshChunks and weld.
Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              int level, uint64_t max_chunks, bool sharp, const Progress& progress = {});

/// Meshes a region in chunks of several levels: the chunks of the tree's coarsest level that meet the region, split as
/// in the tree. solid_samples is then a sum over all levels, although samples of different levels stand for different
/// volumes. Precondition: the tree satisfies its rules, and all virtual nodes that meet the region, or touch a node
/// that meets it, are split, except at the ends of the world. Errors: those of the other meshRegion.
Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              const Octree& tree, uint64_t max_chunks, bool sharp, const Progress& progress = {});

}  // namespace sgm
