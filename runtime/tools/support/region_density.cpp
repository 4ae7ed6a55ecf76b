#include "tools/support/region_density.h"

#include <fmt/core.h>

namespace sgm::cli {
namespace {

constexpr uint64_t kMaxPoints = uint64_t{1} << 30;

}  // namespace

Result<void> checkDensity(const Program& program) {
  if (program.domain.density) return {};
  return Error{Code::invalid_argument,
               "--volume draws fog, which this grammar's domain does not declare: write `output density` in it, as in "
               "`domain infinite axes xz output density;`"};
}

Result<RegionDensity> sampleRegion(const WorldField& world, JobSystem& jobs, const Region& region, int level) {
  const IntBox& extent = region.meshed.extent;
  RegionDensity density;
  density.grid.origin = extent.lo;
  density.grid.spacing = region.cell;
  density.grid.edge = world.settings().program->domain.density_edge;
  uint64_t points = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t cells = (int64_t{extent.hi[axis]} - extent.lo[axis]) / region.cell;
    density.grid.size[static_cast<size_t>(axis)] = static_cast<uint32_t>(cells + 1);
    points *= static_cast<uint64_t>(cells + 1);
    if (points > kMaxPoints)
      return Error{Code::limit,
                   "the region's cells have more than 2^30 corners: choose a smaller region or larger cells"};
  }
  density.values.resize(points);
  DensityRows rows;
  rows.bytes = density.values.data();
  rows.row_pitch = density.grid.size[0];
  rows.slice_pitch = rows.row_pitch * density.grid.size[1];
  QueryField field = queryField(world);
  field.at = [&](const IntBox& box) { return world.compile(box, level); };
  const Stopwatch watch;
  ProgressBar bar("sampling density");
  const Result<DensityFigures> figures =
      sampleDensity(field, density.grid, jobs, rows, [&bar](uint64_t done, uint64_t total) {
        bar.show(done, total);
        return true;
      });
  if (!figures) return figures.error();
  density.figures = *figures;
  density.seconds = watch.seconds();
  return density;
}

Json toJson(const RegionDensity& density) {
  return {{"points", density.values.size()},
          {"edge", density.grid.edge / kUnitsPerMetre},
          {"bricks", density.figures.bricks},
          {"uniform", density.figures.uniform},
          {"seconds", density.seconds}};
}

}  // namespace sgm::cli
