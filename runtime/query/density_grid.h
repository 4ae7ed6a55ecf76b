#pragma once
// Samples the density of a volume on a lattice, for renderers of fog. It uses the same field samples as meshing.

#include <array>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "query/queries.h"

namespace sgm {

/// A lattice of points origin + spacing * (x, y, z), with 0 <= x < size[0] and so on, in units. The density rises from
/// 0 at the surface to 1 over the distance `edge`.
struct DensityGrid {
  Int3 origin;
  int32_t spacing = kUnitsPerMetre;  ///< distance of neighbouring points in units, at least 1
  std::array<uint32_t, 3> size{};    ///< number of points on each axis, at least 1
  /// distance in units over which the density rises from 0 at the surface to 1: 1 to kMaxEdgeCells finest cells
  double edge = 10.0 * kUnitsPerMetre;
};

/// The output array: rows along x, then y, then slices along z. Pitches are in values, not bytes. Does not own the
/// array.
struct DensityRows {
  uint8_t* bytes = nullptr;  ///< densities as 0..255, rounded to the nearest
  float* values = nullptr;   ///< densities as 0..1; used if bytes is null
  size_t row_pitch = 0, slice_pitch = 0;
};

/// Statistics. bricks: number of bricks of 8^3 points; uniform: number of bricks whose density was proven to be 0 or 1
/// everywhere without evaluating their points.
struct DensityFigures {
  uint64_t bricks = 0, uniform = 0;
};

/// Writes the density (shaders/common/density.h) at every point. Gives the same bits regardless of the job system, and
/// of how a lattice is divided into grids. Each block of 32^3 points (8^3 if the field contains sampled host fields)
/// has its own program. progress is called after each block, never concurrently; returning false cancels. Errors:
/// invalid_argument (the edge); range (the grid leaves the world); cancelled; those of compiling the field. If several
/// blocks fail, the error of the first block is returned.
Result<DensityFigures> sampleDensity(const QueryField& field, const DensityGrid& grid, JobSystem& jobs,
                                     const DensityRows& rows, const Progress& progress = {});

}  // namespace sgm
