// The evaluators for every vector instruction set that this compiler supports, from one source (Highway includes this
// file once for each).

#include <cstring>
#include <vector>

#include "base/kernel.h"
#include "backend/cpu/extract/list_vbmi2.h"
#include "backend/cpu/instruction_sets.h"

// Leaves out instruction sets between the supported ones. A processor that has such a set uses the next lower supported
// set.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backend/cpu/evaluate_wide.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace sgm {
namespace HWY_NAMESPACE {

using std::memcpy;

#define SGM_WIDE
#include "backend/cpu/wide.h"
#include "common/common.h"
#include "field/evaluate_blocks.inl"
#include "backend/cpu/wide_end.h"

}  // namespace HWY_NAMESPACE
}  // namespace sgm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sgm {

namespace {

#if HWY_TARGETS & HWY_SSE4
constexpr FieldKernels kSse4{"sse4.2", N_SSE4::evaluateSamples, N_SSE4::evaluateAttributes, N_SSE4::evaluateBox};
#endif
#if HWY_TARGETS & HWY_AVX2
constexpr FieldKernels kAvx2{"avx2", N_AVX2::evaluateSamples, N_AVX2::evaluateAttributes, N_AVX2::evaluateBox};
#endif
#if HWY_TARGETS & HWY_AVX3
constexpr FieldKernels kAvx512{"avx512", N_AVX3::evaluateSamples, N_AVX3::evaluateAttributes, N_AVX3::evaluateBox};
// Evaluates the field with the same AVX-512 instructions as kAvx512. Only the lists of edges and cells for meshing are
// made with more instructions (extract/list_vbmi2.h).
constexpr FieldKernels kVbmi2{"avx512-vbmi2", N_AVX3::evaluateSamples, N_AVX3::evaluateAttributes, N_AVX3::evaluateBox};
#endif

}  // namespace

std::vector<InstructionSet> wideInstructionSets() {
  const int64_t here = hwy::SupportedTargets();
  std::vector<InstructionSet> sets;
#if HWY_TARGETS & HWY_SSE4
  sets.push_back({&kSse4, (here & HWY_SSE4) != 0});
#endif
#if HWY_TARGETS & HWY_AVX2
  sets.push_back({&kAvx2, (here & HWY_AVX2) != 0});
#endif
#if HWY_TARGETS & HWY_AVX3
  sets.push_back({&kAvx512, (here & HWY_AVX3) != 0});
  sets.push_back({&kVbmi2, (here & HWY_AVX3) != 0 && vbmi2RunsHere()});
#endif
  return sets;
}

}  // namespace sgm
#endif
