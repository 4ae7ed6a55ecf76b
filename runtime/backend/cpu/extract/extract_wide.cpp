// The passes for every vector instruction set that this compiler supports, from one source (Highway includes this file
// once for each).

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "backend/cpu/extract/list_vbmi2.h"
#include "backend/cpu/extract/mesh_kernels.h"
#include "base/kernel.h"
#include "mesh/hash.h"
#include "mesh/tables.h"
#include "mesh/triangulate.h"
#include "mesh/vertex.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backend/cpu/extract/extract_wide.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// If Highway has no vectors for this target, extract_scalar.cpp is used instead.
#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace sgm {
namespace HWY_NAMESPACE {
namespace extract {

using std::memcpy;

#define SGM_WIDE
#include "backend/cpu/wide.h"
#include "common/portable.h"
#include "common/real.h"

FN Real loadValues(const float* p) { return hn::LoadU(RealTag(), p); }
FN Int loadLanes(const uint32_t* p) { return hn::BitCast(IntTag(), hn::LoadU(UintTag(), p)); }
FN Real loadAt(const float* p, Int i) { return hn::GatherIndex(RealTag(), p, i.v); }
FN Int loadIntAt(const int32_t* p, Int i) { return hn::GatherIndex(IntTag(), p, i.v); }
FN void loadFour(const float* p, Real& a, Real& b, Real& c, Real& d) {
  hn::LoadInterleaved4(RealTag(), p, a.v, b.v, c.v, d.v);
}
FN void storeLanes(Int i, uint32_t* p) { hn::StoreU(hn::BitCast(UintTag(), i.v), UintTag(), p); }
FN void storeLanes(Int i, int32_t* p) { hn::StoreU(i.v, IntTag(), p); }
FN void storeThree(Real a, Real b, Real c, float* p) { hn::StoreInterleaved3(a.v, b.v, c.v, RealTag(), p); }
FN void storeFour(Uint a, Uint b, Uint c, Uint e, uint32_t* p) {
  hn::StoreInterleaved4(a.v, b.v, c.v, e.v, UintTag(), p);
}
FN Real squareRoot(Real r) { return hn::Sqrt(r.v); }
FN Real quotient(Real a, Real b) { return hn::Div(a.v, b.v); }
FN Real scaledDouble(Int i, double scale) {
  const hn::RepartitionToWide<RealTag> wide;
  const hn::Half<IntTag> half;
  const hn::Half<RealTag> half_real;
  const auto by = hn::Set(wide, scale);
  const auto low = hn::DemoteTo(half_real, hn::Mul(hn::PromoteTo(wide, hn::LowerHalf(half, i.v)), by));
  const auto high = hn::DemoteTo(half_real, hn::Mul(hn::PromoteTo(wide, hn::UpperHalf(half, i.v)), by));
  return hn::Combine(RealTag(), high, low);
}
FN bool all(Bool b) { return hn::AllTrue(RealTag(), b.m); }
FN bool any(Bool b) { return !hn::AllFalse(RealTag(), b.m); }
FN Int minInt(Int a, Int b) { return hn::Min(a.v, b.v); }
FN Int maxInt(Int a, Int b) { return hn::Max(a.v, b.v); }

template <size_t kCount>
FN void spreadBits(const uint64_t* words, uint8_t* out) {
  const hn::ScalableTag<uint8_t> d;
  constexpr size_t kBytes = hn::MaxLanes(d);
  for (size_t at = 0; at < 64; at += kBytes) {
    auto sum = hn::Zero(d);
    for (size_t k = 0; k < kCount; ++k) {
      const auto mask = hn::LoadMaskBits(d, reinterpret_cast<const uint8_t*>(words + k) + at / 8);
      sum = hn::Or(sum, hn::IfThenElseZero(mask, hn::Set(d, static_cast<uint8_t>(1u << k))));
    }
    hn::StoreU(sum, d, out + at);
  }
}

// For each triangulation of a loop of N points: the corners of its triangles, one per lane; the first 8, then the rest.
template <size_t N>
struct TriangleLanes {
  alignas(64) uint32_t corner[static_cast<size_t>(triangulation::kWays[N])][16];
};
template <size_t N>
constexpr TriangleLanes<N> makeTriangleLanes() {
  TriangleLanes<N> lanes{};
  for (size_t way = 0; way < triangulation::kTriangles<N>.size(); ++way)
    for (size_t i = 0; i < 3 * (N - 2); ++i) lanes.corner[way][i] = triangulation::kTriangles<N>[way][i];
  return lanes;
}
template <size_t N>
inline constexpr TriangleLanes<N> kTriangleLanes = makeTriangleLanes<N>();

// A store must not write behind the loop's last corner, because the memory there may already contain other triangles.
template <size_t N>
FN void writeTriangles(size_t way, const uint32_t* vertex, uint32_t* out) {
  const uint32_t* corners = kTriangleLanes<N>.corner[way];
#if HWY_MAX_BYTES < 32
  for (size_t i = 0; i < 3 * (N - 2); ++i) out[i] = vertex[corners[i]];
#else
  const hn::FixedTag<uint32_t, 8> d;
  const hn::FixedTag<uint32_t, 4> four;
  const hn::FixedTag<uint32_t, 2> two;
  const auto of = hn::LoadU(d, vertex);
  const auto permuted = [&](size_t first) {
    return hn::TableLookupLanes(of, hn::IndicesFromVec(d, hn::LoadU(d, corners + first)));
  };
  const auto begin = permuted(0);
  if constexpr (N == 4) {
    hn::StoreU(hn::LowerHalf(four, begin), four, out);
    hn::StoreU(hn::LowerHalf(two, hn::UpperHalf(four, begin)), two, out + 4);
  } else {
    hn::StoreU(begin, d, out);
    if constexpr (N > 5) hn::StoreU(hn::LowerHalf(four, permuted(8)), four, out + 8);
    for (size_t i = N > 5 ? 12 : 8; i < 3 * (N - 2); ++i) out[i] = vertex[corners[i]];
  }
#endif
}

FN void addSteps(const uint32_t* r0, const uint32_t* r1, const uint32_t* r2, const uint32_t* r3, uint64_t steps,
                 uint32_t* number) {
  const hn::FixedTag<uint32_t, 4> d;
  const hn::FixedTag<uint32_t, 2> half;
  const hn::FixedTag<uint8_t, 4> bytes;
  const hn::FixedTag<uint32_t, 1> one;
  const auto widened = [&](uint64_t s) {
    return hn::PromoteTo(d, hn::BitCast(bytes, hn::Set(one, static_cast<uint32_t>(s))));
  };
  const auto low = hn::Combine(d, hn::LoadU(half, r1), hn::LoadU(half, r0));
  const auto high = hn::Combine(d, hn::LoadU(half, r3), hn::LoadU(half, r2));
  hn::StoreU(hn::ConcatEven(d, high, low), d, number);
  hn::StoreU(hn::Add(hn::ConcatLowerLower(d, high, low), widened(steps)), d, number + 4);
  hn::StoreU(hn::Add(low, widened(steps >> 32)), d, number + 8);
}

#include "backend/cpu/extract/lattice.inl"

#include "backend/cpu/extract/list.inl"

#include "backend/cpu/extract/cells.inl"

#include "backend/cpu/extract/edges.inl"

#include "backend/cpu/extract/grid_passes.inl"

#include "backend/cpu/extract/chunk_body.inl"

#include "backend/cpu/extract/chunk_passes.inl"

#include "backend/cpu/wide_end.h"

}  // namespace extract
}  // namespace HWY_NAMESPACE
}  // namespace sgm
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace sgm {

// The table of functions (MeshKernels) for an instruction set. The functions of each set have the same names, in a
// namespace of their own.
#define SGM_EXTRACT(name, set, list)                                                                      \
  {                                                                                                       \
    name, set::extract::signsOfRow, list, set::extract::meshSlab, set::extract::countSolid,               \
        set::extract::polygonizeChunk<list>, set::extract::sortVertices, set::extract::attributeVertices, \
        set::extract::hashMesh                                                                            \
  }
#define SGM_EXTRACT_ONE_BY_ONE(name, set) SGM_EXTRACT(name, set, set::extract::listRows)

const MeshKernels* findWideMeshKernels(const char* name) {
  const int64_t here = hwy::SupportedTargets();
  const auto is = [&](const MeshKernels& kernels, int64_t target) {
    return std::strcmp(kernels.name, name) == 0 && (here & target) != 0;
  };
#if HWY_TARGETS & HWY_SSE4
  static constexpr MeshKernels kSse4 SGM_EXTRACT_ONE_BY_ONE("sse4.2", N_SSE4);
  if (is(kSse4, HWY_SSE4)) return &kSse4;
#endif
#if HWY_TARGETS & HWY_AVX2
  static constexpr MeshKernels kAvx2 SGM_EXTRACT_ONE_BY_ONE("avx2", N_AVX2);
  if (is(kAvx2, HWY_AVX2)) return &kAvx2;
#endif
#if HWY_TARGETS & HWY_AVX3
  static constexpr MeshKernels kAvx512 SGM_EXTRACT_ONE_BY_ONE("avx512", N_AVX3);
  if (is(kAvx512, HWY_AVX3)) return &kAvx512;
  static constexpr MeshKernels kVbmi2 SGM_EXTRACT("avx512-vbmi2", N_AVX3, listRowsVbmi2);
  if (is(kVbmi2, HWY_AVX3) && vbmi2RunsHere()) return &kVbmi2;
#endif
  return nullptr;
}

}  // namespace sgm
#endif
