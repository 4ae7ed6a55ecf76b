// Compiles the scalar evaluator without its special code for lists of primitives: a reference that evaluates one
// instruction after another.

#include <cstdint>
#include <cstring>

#include "base/kernel.h"
#include "one_by_one.h"

namespace sgm::one_by_one {

using std::memcpy;

#include "common/common.h"

#include "field/one_lane.inl"

#define SGM_ONE_BY_ONE
#include "field/evaluate_blocks.inl"

}  // namespace sgm::one_by_one

namespace sgm {

const FieldKernels& oneByOneKernels() {
  static constexpr FieldKernels kernels{"one by one", one_by_one::evaluateSamples, one_by_one::evaluateAttributes,
                                        one_by_one::evaluateBox};
  return kernels;
}

}  // namespace sgm
