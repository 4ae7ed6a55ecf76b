#pragma once
// Evaluators with fused multiply-add, which the conformance suite must detect as different.

#include "field/evaluate.h"

namespace sgm {

/// These kernels are compiled with -ffp-contract=fast for processors with FMA: call them only on such a processor.
const FieldKernels& contractedKernels();

}  // namespace sgm
