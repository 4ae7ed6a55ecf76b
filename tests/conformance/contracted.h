#pragma once
// Evaluators with fused multiply-add. The conformance suite must detect that their results differ.

#include "field/evaluate.h"

namespace sgm {

/// Returns kernels that are compiled with -ffp-contract=fast for processors with FMA: call them only on such a
/// processor.
const FieldKernels& contractedKernels();

}  // namespace sgm
