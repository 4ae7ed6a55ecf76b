#pragma once
// A volume's density on a lattice of points, from the same samples as meshes: what a renderer of fog is fed with.

#include <array>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "query/queries.h"

namespace sgm {

/// The points origin + spacing * (x, y, z), 0 <= x < size[0] and so on, in units, and the rule for what lies there.
struct DensityGrid {
  Int3 origin;
  int32_t spacing = kUnitsPerMetre;     ///< at least 1
  std::array<uint32_t, 3> size{};       ///< points, at least 1 on each axis
  double edge = 10.0 * kUnitsPerMetre;  ///< from the surface to density 1: 1 to kMostEdgeCells finest cells, units
};

/// Where the values go, x by x along a row, rows by y, slices by z: one array, not owned. Pitches count values.
struct DensityRows {
  uint8_t* bytes = nullptr;  ///< to the nearest 255th
  float* values = nullptr;   ///< where bytes is null
  size_t row_pitch = 0, slice_pitch = 0;
};

/// What filling a grid took: bricks of 8^3 points, and those among them whose density was proven to be 0 or 1
/// everywhere, so that none of their points was evaluated.
struct DensityFigures {
  uint64_t bricks = 0, uniform = 0;
};

/// Fills the rows with the density of shaders/common/density.h at every point. The same bits whatever the job system
/// does and however a lattice is cut into grids. Work is in blocks of 32^3 points with a program each (8^3 where the
/// field is sampled), which progress is told of, one call at a time; it returns false to stop.
/// Errors: invalid_argument (the edge), range (the grid leaves the world), cancelled, and those of compiling the field,
/// of several blocks the first one's.
Result<DensityFigures> sampleDensity(const QueryField& field, const DensityGrid& grid, JobSystem& jobs,
                                     const DensityRows& rows, const Progress& progress = {});

}  // namespace sgm
