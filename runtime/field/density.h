#pragma once
// Density from quantised samples: the rule of shaders/common/density.h for arrays.

#include <cstddef>
#include <cstdint>
#include <span>

namespace sgm {

/// The limit of quantised samples: an edge is at most this many finest cells deep.
inline constexpr int32_t kMostEdgeCells = 4096;

/// The width of an edge, from the surface to density 1, in the scale of the samples.
struct DensityEdge {
  double steps = 0;   ///< in 1024ths of a finest cell
  float inverse = 0;  ///< the argument of densityOf()
};

/// edge in units, 1 to kMostEdgeCells * finest_cell.
DensityEdge densityEdge(double edge, int32_t finest_cell);

/// Writes a density from 0 to 1 for each sample; out has as many elements as q.
void densities(std::span<const int32_t> q, const DensityEdge& edge, float* out);
/// The same, rounded to the nearest 255th.
void densities(std::span<const int32_t> q, const DensityEdge& edge, uint8_t* out);

}  // namespace sgm
