#pragma once
// Computes densities from arrays of quantised samples, by the rule of shaders/common/density.h.

#include <cstddef>
#include <cstdint>
#include <span>

namespace sgm {

/// The maximum width of a density edge, in finest cells. It is limited since quantised samples have a limited range.
inline constexpr int32_t kMaxEdgeCells = 4096;

/// The width of the zone (edge) over which the density rises from 0 to 1, in the scale of the quantised samples.
struct DensityEdge {
  double steps = 0;   ///< width of the zone in 1024ths of a finest cell
  float inverse = 0;  ///< 1 / steps, an argument of densityOf()
};

/// Converts the width of an edge in units, 1 to kMaxEdgeCells * finest_cell.
DensityEdge densityEdge(double edge, int32_t finest_cell);

/// Writes a density from 0 to 1 for each sample; out has as many elements as q.
void densities(std::span<const int32_t> q, const DensityEdge& edge, float* out);
/// Same as the function above, with densities 0 to 255, rounded to the nearest.
void densities(std::span<const int32_t> q, const DensityEdge& edge, uint8_t* out);

}  // namespace sgm
