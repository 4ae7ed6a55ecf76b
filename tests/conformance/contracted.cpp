// The scalar evaluator, compiled in a way that the arithmetic contract forbids: with contraction into fused
// multiply-add.

#include <cstdint>
#include <cstring>

#include "base/kernel.h"
#include "contracted.h"

namespace sgm::contracted {

using std::memcpy;

#include "common/common.h"

#include "field/one_lane.inl"

#include "field/evaluate_blocks.inl"

}  // namespace sgm::contracted

namespace sgm {

const FieldKernels& contractedKernels() {
  static constexpr FieldKernels kernels{"contracted", contracted::evaluateSamples, contracted::evaluateAttributes,
                                        contracted::evaluateBox};
  return kernels;
}

}  // namespace sgm
