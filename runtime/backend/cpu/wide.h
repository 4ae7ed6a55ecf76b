// Defines the types that shaders/common needs (Real, Int, ...) as Highway vectors. evaluate_wide.cpp includes this file
// once for each instruction set, inside that set's namespace, so the file has no include guard. The code never uses
// MulAdd, Sqrt or the approximate reciprocals (arithmetic contract in runtime/README.md, rule 2).

namespace hn = hwy::HWY_NAMESPACE;

using RealTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<int32_t>;
using UintTag = hn::ScalableTag<uint32_t>;
using uint = uint32_t;
using Params = const uint32_t*;

#define FN HWY_INLINE

FN float uniformFloat(uint u) {
  float f;
  memcpy(&f, &u, 4);
  return f;
}

// A mask whose lanes are as wide as floats, used for comparisons of all types.
struct Bool {
  hn::Mask<RealTag> m;
};
FN Bool operator&&(Bool a, Bool b) { return {hn::And(a.m, b.m)}; }
FN Bool operator||(Bool a, Bool b) { return {hn::Or(a.m, b.m)}; }
FN Bool operator!(Bool a) { return {hn::Not(a.m)}; }

struct Real {
  hn::Vec<RealTag> v;
  Real() = default;
  FN Real(hn::Vec<RealTag> vec) : v(vec) {}
  FN Real(float x) : v(hn::Set(RealTag(), x)) {}
};
FN Real operator+(Real a, Real b) { return hn::Add(a.v, b.v); }
FN Real operator-(Real a, Real b) { return hn::Sub(a.v, b.v); }
FN Real operator*(Real a, Real b) { return hn::Mul(a.v, b.v); }
FN Real operator-(Real a) { return hn::Neg(a.v); }
FN Bool operator<(Real a, Real b) { return {hn::Lt(a.v, b.v)}; }
FN Bool operator>(Real a, Real b) { return {hn::Gt(a.v, b.v)}; }
FN Bool operator<=(Real a, Real b) { return {hn::Le(a.v, b.v)}; }
FN Bool operator>=(Real a, Real b) { return {hn::Ge(a.v, b.v)}; }

struct Int {
  hn::Vec<IntTag> v;
  Int() = default;
  FN Int(hn::Vec<IntTag> vec) : v(vec) {}
  FN Int(int32_t x) : v(hn::Set(IntTag(), x)) {}
};
FN Bool asBool(hn::Mask<IntTag> m) { return {hn::RebindMask(RealTag(), m)}; }
FN Bool operator<(Int a, Int b) { return asBool(hn::Lt(a.v, b.v)); }
FN Bool operator>(Int a, Int b) { return asBool(hn::Gt(a.v, b.v)); }
FN Bool operator>=(Int a, Int b) { return !(a < b); }
FN Bool operator==(Int a, Int b) { return asBool(hn::Eq(a.v, b.v)); }
FN Int operator&(Int a, Int b) { return hn::And(a.v, b.v); }
FN Int operator|(Int a, Int b) { return hn::Or(a.v, b.v); }
FN Int operator^(Int a, Int b) { return hn::Xor(a.v, b.v); }
FN Int wrapAdd(Int a, Int b) { return hn::Add(a.v, b.v); }
FN Int wrapSub(Int a, Int b) { return hn::Sub(a.v, b.v); }
FN Int wrapMul(Int a, Int b) { return hn::Mul(a.v, b.v); }

struct Uint {
  hn::Vec<UintTag> v;
  Uint() = default;
  FN Uint(hn::Vec<UintTag> vec) : v(vec) {}
  FN Uint(uint x) : v(hn::Set(UintTag(), x)) {}
};
FN Uint operator-(Uint a, Uint b) { return hn::Sub(a.v, b.v); }
FN Uint operator*(Uint a, Uint b) { return hn::Mul(a.v, b.v); }
FN Uint operator^(Uint a, Uint b) { return hn::Xor(a.v, b.v); }
FN Uint operator&(Uint a, Uint b) { return hn::And(a.v, b.v); }
FN Uint operator|(Uint a, Uint b) { return hn::Or(a.v, b.v); }
FN Uint operator>>(Uint a, int count) { return hn::ShiftRightSame(a.v, count); }
FN Uint operator<<(Uint a, int count) { return hn::ShiftLeftSame(a.v, count); }

FN Real broadcast(float x) { return Real(x); }
FN Int broadcastInt(int32_t x) { return Int(x); }
FN Real bitsToReal(Uint u) { return hn::BitCast(RealTag(), u.v); }
FN Uint realToBits(Real r) { return hn::BitCast(UintTag(), r.v); }
FN Real gatherReal(Params P, Int i) { return hn::BitCast(RealTag(), hn::GatherIndex(UintTag(), P, i.v)); }
FN Real toReal(Int i) { return hn::ConvertTo(RealTag(), i.v); }
// Precondition: |r| < 2^31. Highway's own conversion also defines the results for larger values, and needs four more
// instructions for that.
FN Int toInt(Real r) {
#if HWY_TARGET == HWY_AVX3
  return hn::Vec<IntTag>{_mm512_cvttps_epi32(r.v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return hn::Vec<IntTag>{_mm256_cvttps_epi32(r.v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return hn::Vec<IntTag>{_mm_cvttps_epi32(r.v.raw)};
#else
  return hn::ConvertTo(IntTag(), r.v);
#endif
}
FN Int toIntBits(Uint u) { return hn::BitCast(IntTag(), u.v); }
FN Uint toUintBits(Int i) { return hn::BitCast(UintTag(), i.v); }
// Vector instructions for minimum and maximum. They give the same results as the comparisons in real.h, because on x86
// the minimum of (a, b) is a if a < b, else b.
#define SGM_VECTOR_FORMS
FN Real minReal(Real a, Real b) { return hn::Min(a.v, b.v); }
FN Real maxReal(Real a, Real b) { return hn::Max(a.v, b.v); }
FN Real floorReal(Real x) { return hn::Add(hn::Floor(x.v), hn::Zero(RealTag())); }
FN Real flushReal(Real x) {
  return hn::IfThenElseZero(hn::Gt(hn::Abs(x.v), hn::Set(RealTag(), 1.0e-30f)), x.v);
}
FN Int saturatingSub(Int p, Int c) {
  const auto d = hn::Sub(p.v, c.v), overflow = hn::And(hn::Xor(p.v, c.v), hn::Xor(p.v, d));
  const auto limit = hn::Xor(hn::BroadcastSignBit(p.v), hn::Set(IntTag(), 0x7FFFFFFF));
  return hn::IfThenElse(hn::Lt(overflow, hn::Zero(IntTag())), limit, d);
}
FN Real sel(Bool c, Real a, Real b) { return hn::IfThenElse(c.m, a.v, b.v); }
FN Int sel(Bool c, Int a, Int b) { return hn::IfThenElse(hn::RebindMask(IntTag(), c.m), a.v, b.v); }

constexpr size_t kLanes = hn::MaxLanes(RealTag());
FN Real loadReal(const uint32_t* p) { return hn::BitCast(RealTag(), hn::Load(UintTag(), p)); }
FN Int loadInt(const uint32_t* p) { return hn::BitCast(IntTag(), hn::Load(UintTag(), p)); }
FN void storeReal(Real r, uint32_t* p) { hn::Store(hn::BitCast(UintTag(), r.v), UintTag(), p); }
FN void storeInt(Int i, uint32_t* p) { hn::Store(hn::BitCast(UintTag(), i.v), UintTag(), p); }
// For each lane, returns the entry of `table` that the lane's index (0 to kLanes - 1) selects.
FN Real lookUp(Real table, Int index) { return hn::TableLookupLanes(table.v, hn::IndicesFromVec(RealTag(), index.v)); }
#if HWY_TARGET == HWY_AVX3
#define SGM_LANE_TABLES
// For each lane, returns an entry of a table of 16 floats: the one that the lowest four bits of the lane's index
// select.
FN Real lookUp16(const float* table, Uint index) {
  return hn::Vec<RealTag>{_mm512_permutexvar_ps(index.v.raw, _mm512_loadu_ps(table))};
}
#endif
#define SGM_ROWS
// Loads 8 words from `first` into the first 8 lanes; if vectors have 16 lanes, also loads 8 words from `second` into
// the other lanes.
FN Real loadRows(const uint32_t* first, [[maybe_unused]] const uint32_t* second) {
#if HWY_TARGET == HWY_AVX3
  const hn::Half<UintTag> half;
  return hn::BitCast(RealTag(), hn::Combine(UintTag(), hn::LoadU(half, second), hn::LoadU(half, first)));
#else
  return hn::BitCast(RealTag(), hn::LoadU(UintTag(), first));
#endif
}
FN Int toIntBits(Real r) { return hn::BitCast(IntTag(), r.v); }
FN uint64_t maskOf(Bool b) {
#if HWY_TARGET == HWY_AVX3
  return b.m.raw;
#elif HWY_TARGET == HWY_AVX2
  return static_cast<uint32_t>(_mm256_movemask_ps(hn::VecFromMask(RealTag(), b.m).raw));
#else
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(RealTag(), b.m, bytes);
  uint64_t bits;
  memcpy(&bits, bytes, 8);
  return bits;
#endif
}
// Returns a word in which bit i is set if p[i], read as int32, is negative, for i < count. Reads whole vectors, so it
// may read words after p[count - 1].
FN uint64_t signMask(const uint32_t* p, size_t count) {
  uint64_t mask = 0;
  for (size_t i = 0; i < count; i += kLanes)
    mask |= maskOf(Int(hn::BitCast(IntTag(), hn::LoadU(UintTag(), p + i))) < Int(0)) << i;
  return mask & ((uint64_t{1} << count) - 1);
}
