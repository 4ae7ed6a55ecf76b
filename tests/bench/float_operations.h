#pragma once
// Counts the floating-point operations of sampling a field, by running the interpreter with a number type that records
// how each value was computed. Operations on which no used result depends are not counted, since compilers also remove
// them; an example is the gradient if only the value is used.

#include <cstdint>

#include "field/evaluate.h"

namespace bench {

struct OperationCount {
  uint64_t arithmetic = 0;  ///< number of additions, subtractions and products of floats
  /// Number of comparisons, selections, conversions and integer operations, and of memory accesses whose address
  /// differs between samples.
  uint64_t others = 0;
};

/// Returns the number of operations that floatCountingKernels() has executed on this thread since the last call.
OperationCount takeOperationCount();

/// Returns an evaluator that counts operations. Its results equal those of sgm::scalarKernels() bit for bit; it is
/// slow.
const sgm::FieldKernels& floatCountingKernels();

}  // namespace bench
