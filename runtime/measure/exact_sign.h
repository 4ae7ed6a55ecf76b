#pragma once
// Makes the exact predicates available in the namespace of measures.

#include "asset/exact_sign.h"

namespace sgm::measure {

using asset::orientation;
using asset::orientationAlong;

}  // namespace sgm::measure
