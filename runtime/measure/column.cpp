#include "measure/column.h"

#include "measure/exact_sign.h"
#include "mesh/column.h"

namespace sgm::measure {
namespace {

struct ExactSigns {
  using Place = Point;

  static int orientationAlong(int drop, Point a, Point b, Point c) { return measure::orientationAlong(drop, a, b, c); }
};

}  // namespace

int turnOver(const std::array<Point, 3>& t, double x, double y) { return sgm::turnOver<ExactSigns>(t, {x, y, 0}); }

}  // namespace sgm::measure
