#include "measure/column.h"

#include "measure/exact_signs.h"
#include "mesh/column.h"

namespace sgm::measure {

int turnOver(const std::array<Point, 3>& t, double x, double y) { return sgm::turnOver<ExactSigns>(t, {x, y, 0}); }

}  // namespace sgm::measure
