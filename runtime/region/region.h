#pragma once
// Meshes a region and computes all measures that statements of the language can name.

#include <cstdint>

#include "chunk/mesh_chunks.h"
#include "region/components.h"
#include "region/topology.h"

namespace sgm {

/// Selects the measures that cost more than sums over the triangles. Sums need no download of meshes from a device. But
/// topology needs all meshes of the region at once, and components need the signs of all samples.
struct WantedMeasures {
  bool topology = false;
  bool components = false;  ///< count the connected pieces of solid and void
  bool volume = false;
};

struct RegionMeasures {
  IntBox extent;  ///< the region enlarged to whole chunks; hi is excluded
  uint64_t chunks = 0;
  /// number of triangles of the surface, without the faces where the region's border cuts the solid
  uint64_t triangles = 0;
  double volume = 0;  ///< volume of the solid in m3, by the divergence theorem (solid_volume.h); 0 if not requested
  /// volume of the solid in m3, by counting cubes: equation 8 of the paper (cubeVolume() in measure.h)
  double cubes = 0;
  double sample = 0;  ///< volume in m3 that one sample stands for
  int32_t cell = 0;   ///< distance of adjacent samples in units; the first sample lies at extent.lo
  double area = 0;    ///< area of the surface in m2, without the cut faces: equation 7 (areaOf() in part_sums.h)
  /// connected pieces of all samples of the region, including those on its high faces; empty if not requested
  Pieces pieces;
  Topology topology;  ///< topology of the surface; empty if not requested
};

/// Meshes the chunks of level 0 that meet the box lo <= p < hi, and measures them. Errors: those of chunksOfRegion,
/// meshChunks and weld.
Result<RegionMeasures> measureRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                                     uint64_t max_chunks, const WantedMeasures& wanted, const Progress& progress = {});

}  // namespace sgm
