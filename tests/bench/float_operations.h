#pragma once
// Counts the operations of sampling a field. It runs the interpreter with numbers that record how they were computed.
// Operations on which no used result depends are not counted, for example those of a gradient if only the value is
// used, because compilers remove them too.

#include <cstdint>

#include "field/evaluate.h"

namespace bench {

struct OperationCount {
  uint64_t arithmetic = 0;  ///< additions, subtractions and products of floats
  /// Comparisons, selections, conversions, integer operations; memory accesses whose address differs between samples.
  uint64_t others = 0;
};

/// The operations of this thread's calls of the counting evaluator, since the last call of this function.
OperationCount takeOperationCount();

/// An evaluator with the same results as sgm::scalarKernels(), bit by bit, that counts operations; slow.
const sgm::FieldKernels& floatCountingKernels();

}  // namespace bench
