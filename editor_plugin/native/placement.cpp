#include "placement.h"

#include <algorithm>
#include <cmath>

namespace sgm_godot {

void Placement::box(const Aabb& global, int32_t minimum[3], int32_t maximum[3]) const {
  Units low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 at{global.position.x + (corner & 1 ? global.size.x : 0),
                     global.position.y + (corner & 2 ? global.size.y : 0),
                     global.position.z + (corner & 4 ? global.size.z : 0)};
    const Units units = toUnits(at);
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], units[axis]);
      high[axis] = std::max(high[axis], units[axis]);
    }
  }
  const auto inWorld = [](double units) {
    return static_cast<int32_t>(std::clamp(units, double{INT32_MIN}, double{INT32_MAX}));
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    minimum[axis] = inWorld(std::floor(low[axis]));
    maximum[axis] = inWorld(std::ceil(high[axis]));
  }
}

}  // namespace sgm_godot
