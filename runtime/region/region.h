#pragma once
// Meshes a region and computes every measure that statements of the language use.

#include <cstdint>

#include "chunk/mesh_chunks.h"
#include "region/components.h"
#include "region/topology.h"

namespace sgm {

/// Selects measures that cost more than sums. A device computes sums without downloading its meshes, whereas topology
/// needs all meshes of the region at once, and components need all signs.
struct WantedMeasures {
  bool topology = false;
  bool components = false;  ///< connected pieces of solid and air
  bool volume = false;
};

struct RegionMeasures {
  IntBox extent;  ///< the region grown to whole chunks; hi is excluded
  uint64_t chunks = 0;
  /// number of triangles of the surface, without those of the faces where the border cuts the solid
  uint64_t triangles = 0;
  double volume = 0;  ///< m3 of the solid, by the divergence theorem (solid_volume.h); 0 if not requested
  double cubes = 0;   ///< m3 of the solid by counting cubes: equation 8 of the paper (cubeVolume() in measure.h)
  double sample = 0;  ///< volume in m3 that one sample stands for
  int32_t cell = 0;   ///< distance of adjacent samples in units; the first one lies at extent.lo
  double area = 0;    ///< m2 of the surface without the cut faces: equation 7 (areaOf() in part_sums.h)
  /// connected pieces of all samples of the region, including those on its high faces; empty if not requested
  Pieces pieces;
  Topology topology;  ///< empty if not requested
};

/// Meshes the chunks of level 0 that meet the box lo <= p < hi, and measures them. Errors: those of chunksOfRegion,
/// meshChunks and weld.
Result<RegionMeasures> measureRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                                     uint64_t max_chunks, const WantedMeasures& wanted, const Progress& progress = {});

}  // namespace sgm
