#pragma once
// How many operations it takes to sample a field: the interpreter once more, with numbers that remember where they come
// from. What nothing depends on that is kept, a gradient where only the value is wanted, is not counted: compilers drop
// it, too.

#include <cstdint>

#include "field/evaluate.h"

namespace bench {

struct OperationCount {
  uint64_t arithmetic = 0;  ///< additions, subtractions and products of floats
  uint64_t others = 0;      ///< comparisons, selections, conversions, integers; reads that differ by sample
};

/// Of this thread's calls of the evaluator below, since the last time that this was asked.
OperationCount takeOperationCount();

/// As sgm::scalarKernels(), in the same bits; slow.
const sgm::FieldKernels& floatCountingKernels();

}  // namespace bench
