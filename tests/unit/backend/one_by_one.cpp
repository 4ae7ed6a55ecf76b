// The scalar evaluator once more, with one instruction after the other: what lists of primitives are held against.

#include <cstdint>
#include <cstring>

#include "base/kernel.h"
#include "one_by_one.h"

namespace sgm::one_by_one {

using std::memcpy;

#include "common/common.h"

inline constexpr size_t kLanes = 1;
FN Real loadReal(const uint32_t* p) { return uniformFloat(*p); }
FN Int loadInt(const uint32_t* p) { return static_cast<Int>(*p); }
FN void storeReal(Real r, uint32_t* p) { *p = realToBits(r); }
FN void storeInt(Int i, uint32_t* p) { *p = static_cast<uint32_t>(i); }
FN uint64_t signMask(const uint32_t* p, size_t count) {
  uint64_t mask = 0;
  for (size_t i = 0; i < count; ++i) mask |= uint64_t{p[i] >> 31} << i;
  return mask;
}

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
