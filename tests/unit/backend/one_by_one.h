#pragma once

#include "field/evaluate.h"

namespace sgm {

/// Evaluators like scalarKernels(), but without the special paths for lists of primitives.
const FieldKernels& oneByOneKernels();

}  // namespace sgm
