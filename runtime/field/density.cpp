#include "field/density.h"

#include <cstring>

namespace sgm {

namespace density_rule {

using std::memcpy;

#include "common/common.h"

}  // namespace density_rule

DensityEdge densityEdge(double edge, int32_t finest_cell) {
  const double steps = edge * 1024 / finest_cell;
  return {steps, static_cast<float>(1 / steps)};
}

void densities(std::span<const int32_t> q, const DensityEdge& edge, float* out) {
  for (size_t i = 0; i < q.size(); ++i) out[i] = density_rule::densityOf(q[i], edge.inverse);
}

void densities(std::span<const int32_t> q, const DensityEdge& edge, uint8_t* out) {
  for (size_t i = 0; i < q.size(); ++i)
    out[i] = static_cast<uint8_t>(density_rule::densityByte(density_rule::densityOf(q[i], edge.inverse)));
}

}  // namespace sgm
