#include "derive/lower_layers.h"

#include <algorithm>

#include "base/math.h"

namespace sgm {

Int3 probePoint(Int3 from, std::array<double, 3> direction, int32_t t) {
  const auto along = [&](int32_t start, double d) {
    return saturate(start + static_cast<int64_t>(detFloor(d * t + 0.5)));
  };
  return {along(from.x, direction[0]), along(from.y, direction[1]), along(from.z, direction[2])};
}

std::optional<int32_t> LowerLayers::probe(uint32_t layer, Int3 from, std::array<double, 3> direction,
                                          int32_t length) const {
  if (length < 0 || solid(layer, from)) return std::nullopt;
  int32_t open = 0;
  while (open < length) {
    int32_t closed = open + std::min(kProbeStep, length - open);
    if (!solid(layer, probePoint(from, direction, closed))) {
      open = closed;
      continue;
    }
    while (closed - open > 1) {
      const int32_t middle = open + (closed - open) / 2;
      (solid(layer, probePoint(from, direction, middle)) ? closed : open) = middle;
    }
    return closed;
  }
  return std::nullopt;
}

}  // namespace sgm
