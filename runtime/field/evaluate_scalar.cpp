#include <cstring>

#include "base/kernel.h"
#include "field/evaluate.h"

namespace sgm {

const char* opName(Op op) {
  switch (op) {
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return #name;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return "?";
}

namespace scalar {

using std::memcpy;

#include "common/common.h"

#include "field/one_lane.inl"

#include "field/evaluate_blocks.inl"

}  // namespace scalar

const FieldKernels& scalarKernels() {
  static constexpr FieldKernels kernels{"scalar", scalar::evaluateSamples, scalar::evaluateAttributes,
                                        scalar::evaluateBox};
  return kernels;
}

}  // namespace sgm
