#pragma once
// What the conformance suite must be able to catch.

#include "field/evaluate.h"

namespace sgm {

/// Compiled with -ffp-contract=fast for a processor with fma: run it only on one.
const FieldKernels& contractedKernels();

}  // namespace sgm
