// The grid's passes for every vector instruction set that this compiler can make, from one source (Highway includes
// this file once for each).

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "backend/cpu/grid/grid_kernels.h"
#include "base/kernel.h"
#include "mesh/chunk.h"
#include "mesh/tables.h"
#include "mesh/triangulate.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backend/cpu/grid/grid_wide.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace sgm {
namespace HWY_NAMESPACE {
namespace grid {

using std::memcpy;

#define SGM_WIDE
#include "backend/cpu/wide.h"
#include "common/portable.h"
#include "common/real.h"

FN Real loadValues(const float* p) { return hn::LoadU(RealTag(), p); }
FN Int loadLanes(const uint32_t* p) { return hn::BitCast(IntTag(), hn::LoadU(UintTag(), p)); }
FN Real loadAt(const float* p, Int i) { return hn::GatherIndex(RealTag(), p, i.v); }
FN void storeLanes(Int i, int32_t* p) { hn::StoreU(i.v, IntTag(), p); }
FN void storeLanes(Real r, float* p) { hn::StoreU(r.v, RealTag(), p); }
FN Real squareRoot(Real r) { return hn::Sqrt(r.v); }
FN Real quotient(Real a, Real b) { return hn::Div(a.v, b.v); }
FN uint64_t maskOf(Bool b) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(RealTag(), b.m, bytes);
  uint64_t bits;
  memcpy(&bits, bytes, 8);
  return bits;
}
FN bool all(Bool b) { return hn::AllTrue(RealTag(), b.m); }

#include "backend/cpu/grid/grid_kernels.inl"

#include "backend/cpu/wide_end.h"

}  // namespace grid
}  // namespace HWY_NAMESPACE
}  // namespace sgm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sgm {

const GridKernels* findWideGridKernels(const char* name) {
  const int64_t here = hwy::SupportedTargets();
  const auto is = [&](const GridKernels& kernels, int64_t target) {
    return std::strcmp(kernels.name, name) == 0 && (here & target) != 0;
  };
#if HWY_TARGETS & HWY_SSE4
  static constexpr GridKernels kSse4{"sse4.2", N_SSE4::grid::signsOfRow, N_SSE4::grid::countPlane,
                                     N_SSE4::grid::meshSlab};
  if (is(kSse4, HWY_SSE4)) return &kSse4;
#endif
#if HWY_TARGETS & HWY_AVX2
  static constexpr GridKernels kAvx2{"avx2", N_AVX2::grid::signsOfRow, N_AVX2::grid::countPlane,
                                     N_AVX2::grid::meshSlab};
  if (is(kAvx2, HWY_AVX2)) return &kAvx2;
#endif
#if HWY_TARGETS & HWY_AVX3
  static constexpr GridKernels kAvx512{"avx512", N_AVX3::grid::signsOfRow, N_AVX3::grid::countPlane,
                                       N_AVX3::grid::meshSlab};
  if (is(kAvx512, HWY_AVX3)) return &kAvx512;
#endif
  return nullptr;
}

}  // namespace sgm
#endif
