#pragma once
// Samples the density of a meshed region at the corners of its cells, for `sgm render --volume`.

#include "query/density_grid.h"
#include "tools/support/region.h"

namespace sgm::cli {

struct RegionDensity {
  DensityGrid grid;
  std::vector<uint8_t> values;
  DensityFigures figures;
  double seconds = 0;
};

/// Error: invalid_argument if the grammar does not declare its solid as fog; the message names the missing statement.
Result<void> checkDensity(const Program& program);

/// Samples the density in the region. Shows a progress bar if stderr is a terminal. Errors: those of sampleDensity(),
/// limit, out_of_memory.
Result<RegionDensity> sampleRegion(const WorldField& world, JobSystem& jobs, const Region& region, int level);

Json toJson(const RegionDensity& density);

}  // namespace sgm::cli
