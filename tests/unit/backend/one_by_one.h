#pragma once

#include "field/evaluate.h"

namespace sgm {

/// As scalarKernels(), without the paths of their own that lists of primitives have.
const FieldKernels& oneByOneKernels();

}  // namespace sgm
