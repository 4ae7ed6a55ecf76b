#pragma once
// Density from quantised samples: the rule of shaders/common/density.h, for arrays of them.

#include <cstddef>
#include <cstdint>
#include <span>

namespace sgm {

/// Samples are clamped there: an edge reaches no deeper than that many finest cells.
inline constexpr int32_t kMostEdgeCells = 4096;

/// The width of an edge, from the surface to where density is 1, as the samples measure it.
struct DensityEdge {
  double steps = 0;   ///< in 1024ths of a finest cell
  float inverse = 0;  ///< what densityOf() takes
};

/// edge in units, 1 to kMostEdgeCells * finest_cell.
DensityEdge densityEdge(double edge, int32_t finest_cell);

/// 0 to 1, for each sample; out has as many places.
void densities(std::span<const int32_t> q, const DensityEdge& edge, float* out);
/// The same to the nearest 255th.
void densities(std::span<const int32_t> q, const DensityEdge& edge, uint8_t* out);

}  // namespace sgm
