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

inline constexpr size_t kLanes = 1;
FN Real loadReal(const uint32_t* p) { return uniformFloat(*p); }
FN Int loadInt(const uint32_t* p) { return static_cast<Int>(*p); }
FN void storeReal(Real r, uint32_t* p) { *p = realToBits(r); }
FN void storeInt(Int i, uint32_t* p) { *p = static_cast<uint32_t>(i); }

#include "field/evaluate_blocks.inl"

}  // namespace scalar

const FieldKernels& scalarKernels() {
  static constexpr FieldKernels kernels{"scalar", scalar::evaluateSamples, scalar::evaluateAttributes};
  return kernels;
}

}  // namespace sgm
