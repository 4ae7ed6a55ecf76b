#include "measure/column.h"

#include <utility>

#include "measure/exact_sign.h"

namespace sgm::measure {

int turnOver(const std::array<Point, 3>& t, double x, double y) {
  const int round = orientationAlong(2, t[0], t[1], t[2]);
  for (size_t k = 0; round != 0 && k < 3; ++k) {
    Point a = t[k], b = t[(k + 1) % 3];
    if (round < 0) std::swap(a, b);
    const int side = orientationAlong(2, a, b, {x, y, 0});
    // A place on the edge belongs to the triangle on its one side.
    const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
    if (side < 0 || (side == 0 && !owns)) return 0;
  }
  return round;
}

}  // namespace sgm::measure
