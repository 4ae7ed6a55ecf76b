#pragma once
// Meshes a region and computes every measure of the language.

#include <cstdint>

#include "chunk/mesh_chunks.h"
#include "region/components.h"
#include "region/topology.h"

namespace sgm {

/// The measures that cost more than sums, which a device computes without downloading its meshes: topology needs all
/// meshes of the region at once, components need all signs.
struct WantedMeasures {
  bool topology = false;
  bool components = false;  ///< pieces of solid and air
  bool volume = false;
};

struct RegionMeasures {
  IntBox extent;  ///< the region grown to whole chunks; hi is outside
  uint64_t chunks = 0;
  uint64_t triangles = 0;  ///< each once; without the faces where the border cuts the solid
  double volume = 0;       ///< m3 of the solid, by the divergence theorem (solid_volume.h); 0 if not wanted
  double cubes = 0;        ///< m3 of the solid: equation 8 of the paper (cubeVolume() in measure.h)
  double sample = 0;       ///< m3 of one sample
  int32_t cell = 0;        ///< from one sample to the next, units; the first lies at extent.lo
  double area = 0;         ///< m2, equation 7, of the surface without the cut faces (areaOf() in part_sums.h)
  Pieces pieces;           ///< of all samples of the region, including those on its high faces; empty if not wanted
  Topology topology;       ///< empty if not wanted
};

/// Meshes the chunks of level 0 that meet the box lo <= p < hi, and measures them.
/// Errors: those of chunksOfRegion, meshChunks and weld.
Result<RegionMeasures> measureRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                                     uint64_t max_chunks, const WantedMeasures& wanted, const Progress& progress = {});

}  // namespace sgm
