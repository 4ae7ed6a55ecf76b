#pragma once
// Samples a volume's density on a lattice, from the same field samples as meshes: input for a renderer of fog.

#include <array>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "query/queries.h"

namespace sgm {

/// The points origin + spacing * (x, y, z), 0 <= x < size[0] and so on, in units, and the rule for their density.
struct DensityGrid {
  Int3 origin;
  int32_t spacing = kUnitsPerMetre;     ///< at least 1
  std::array<uint32_t, 3> size{};       ///< points, at least 1 on each axis
  double edge = 10.0 * kUnitsPerMetre;  ///< from the surface to density 1: 1 to kMostEdgeCells finest cells, units
};

/// The output array, not owned: rows along x, then y, then slices along z. Pitches count values.
struct DensityRows {
  uint8_t* bytes = nullptr;  ///< rounded to the nearest 255th
  float* values = nullptr;   ///< used if bytes is null
  size_t row_pitch = 0, slice_pitch = 0;
};

/// Statistics: bricks of 8^3 points, and the bricks whose density was proven to be 0 or 1 everywhere, without
/// evaluating their points.
struct DensityFigures {
  uint64_t bricks = 0, uniform = 0;
};

/// Writes the density of shaders/common/density.h at every point. The same bits whatever the job system does and
/// however a lattice is cut into grids. Each block of 32^3 points (8^3 if the field is sampled) has its own program.
/// progress is called after each block, not concurrently; returning false cancels. Errors: invalid_argument (the edge),
/// range (the grid leaves the world), cancelled, and those of compiling the field; of several errors the first block's.
Result<DensityFigures> sampleDensity(const QueryField& field, const DensityGrid& grid, JobSystem& jobs,
                                     const DensityRows& rows, const Progress& progress = {});

}  // namespace sgm
