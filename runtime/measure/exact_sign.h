#pragma once
// The exact predicates under the names that measures use.

#include "asset/exact_sign.h"

namespace sgm::measure {

using asset::orientation;
using asset::orientationAlong;

}  // namespace sgm::measure
