#include "backend/cpu/extract/list_vbmi2.h"

#include <hwy/base.h>

#if HWY_ARCH_X86_64

#if !HWY_COMPILER_CLANG
// GCC takes what its own header leaves undefined on purpose for a mistake.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>

#include "mesh/tables.h"

namespace sgm {

bool vbmi2RunsHere() {
  static const bool can = __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vbmi") &&
                          __builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("bmi2") &&
                          __builtin_cpu_supports("popcnt");
  return can;
}

}  // namespace sgm

HWY_PUSH_ATTRIBUTES("avx512f,avx512vl,avx512bw,avx512dq,avx512vbmi,avx512vbmi2,avx2,bmi,bmi2,popcnt,lzcnt")
namespace sgm {
namespace {

#define FN HWY_INLINE

template <size_t kCount>
FN __m512i spreadBits(const uint64_t* words) {
  __m512i sum = _mm512_setzero_si512();
  for (size_t k = 0; k < kCount; ++k)
    sum = _mm512_or_si512(sum, _mm512_maskz_set1_epi8(words[k], static_cast<char>(1u << k)));
  return sum;
}
template <size_t kCount>
FN void spreadBits(const uint64_t* words, uint8_t* out) {
  _mm512_storeu_si512(out, spreadBits<kCount>(words));
}

#include "backend/cpu/extract/signs.inl"

/// Of the edges of 64 samples, x, y and z of each in turn, those of one vector of bytes: which samples they begin at,
/// as bits of an axis' word from `shift` on, and which bytes are theirs.
struct TurnOfAxis {
  int shift;
  uint64_t bytes;
};
struct Turns {
  TurnOfAxis axis[3][3];           ///< by vector and axis
  alignas(64) uint8_t number[64];  ///< of a byte in its vector
};
constexpr Turns makeTurns() {
  Turns turns{};
  for (int vector = 0; vector < 3; ++vector) {
    for (int axis = 0; axis < 3; ++axis) {
      TurnOfAxis& turn = turns.axis[vector][axis];
      turn.shift = (64 * vector - axis + 2) / 3;
      for (int i = 0; i < 64; ++i) turn.bytes |= static_cast<uint64_t>((64 * vector + i) % 3 == axis) << i;
    }
  }
  for (size_t i = 0; i < 64; ++i) turns.number[i] = static_cast<uint8_t>(i);
  return turns;
}
constexpr Turns kTurns = makeTurns();

/// As OneByOne of signs.inl, all of a word at once: which bytes are wanted is a mask, and no branch depends on how
/// many.
struct Compressed {
  FN static size_t edges(uint64_t x, uint64_t y, uint64_t z, uint32_t first, uint32_t* out) {
    const uint64_t words[3] = {x, y, z};
    const __m512i numbers = _mm512_load_si512(kTurns.number);
    uint32_t* next = out;
    for (int vector = 0; vector < 3; ++vector) {
      uint64_t wanted = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const TurnOfAxis& turn = kTurns.axis[vector][axis];
        wanted |= _pdep_u64(words[axis] >> turn.shift, turn.bytes);
      }
      if (wanted == 0) continue;
      alignas(64) uint8_t bytes[64];
      _mm512_store_si512(bytes, _mm512_maskz_compress_epi8(wanted, numbers));
      const auto count = static_cast<size_t>(std::popcount(wanted));
      for (size_t i = 0; i < count; i += 16) {
        const __m512i turn =
            _mm512_add_epi32(_mm512_cvtepu8_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(bytes + i))),
                             _mm512_set1_epi32(64 * vector));
        // A third, exact below 256.
        const __m512i sample = _mm512_srli_epi32(_mm512_mullo_epi32(turn, _mm512_set1_epi32(171)), 9);
        const __m512i axis = _mm512_sub_epi32(turn, _mm512_mullo_epi32(sample, _mm512_set1_epi32(3)));
        _mm512_storeu_si512(next + i,
                            _mm512_or_si512(_mm512_add_epi32(sample, _mm512_set1_epi32(static_cast<int>(first))),
                                            _mm512_slli_epi32(axis, 2 * kPlaceBits)));
      }
      next += count;
    }
    return static_cast<size_t>(next - out);
  }

  FN static uint64_t cells(const WordCells& word, uint64_t* out) {
    const auto alongX = [&](size_t corner) { return (word.corner[corner] ^ word.corner[corner + 1]) >> 1; };
    const uint64_t beyond[5] = {alongX(0) | uint64_t{kCaseEdges.along_x[word.next_case] & 1u} << 63,
                                alongX(2) | uint64_t{kCaseEdges.along_x[word.next_case] >> 1 & 1u} << 63,
                                alongX(4) | uint64_t{kCaseEdges.along_x[word.next_case] >> 2 & 1u} << 63,
                                word.along_y[0], word.along_y[1]};
    const __m512i cases = spreadBits<8>(word.corner);
    alignas(64) uint8_t of_case[64], of_beyond[64], bits[64];
    _mm512_store_si512(of_case, _mm512_maskz_compress_epi8(word.active, cases));
    _mm512_store_si512(of_beyond, _mm512_maskz_compress_epi8(word.active, spreadBits<5>(beyond)));
    _mm512_store_si512(bits, _mm512_maskz_compress_epi8(word.active, _mm512_load_si512(kTurns.number)));
    const auto count = static_cast<size_t>(std::popcount(word.active));
    for (size_t i = 0; i < count; i += 8) {
      const __m512i place = _mm512_add_epi64(widened(bits + i), _mm512_set1_epi64(static_cast<int64_t>(word.place)));
      _mm512_storeu_si512(out + i, _mm512_or_si512(_mm512_slli_epi64(place, 16),
                                                   _mm512_or_si512(_mm512_slli_epi64(widened(of_beyond + i), 8),
                                                                   widened(of_case + i))));
    }
    return trianglesOf(cases, word.active);
  }

 private:
  /// Eight bytes as words.
  FN static __m512i widened(const uint8_t* bytes) {
    return _mm512_cvtepu8_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes)));
  }
  FN static __m512i trianglesFrom(size_t first_case) { return _mm512_loadu_si512(kCubeTriangles + first_case); }
  FN static uint64_t trianglesOf(__m512i cases, uint64_t active) {
    const __m512i low = _mm512_permutex2var_epi8(trianglesFrom(0), cases, trianglesFrom(64)),
                  high = _mm512_permutex2var_epi8(trianglesFrom(128), cases, trianglesFrom(192));
    const __m512i triangles = _mm512_mask_mov_epi8(low, _mm512_movepi8_mask(cases), high);
    const __m512i sums = _mm512_sad_epu8(_mm512_maskz_mov_epi8(active, triangles), _mm512_setzero_si512());
    return static_cast<uint64_t>(_mm512_reduce_add_epi64(sums));
  }
};

#undef FN

}  // namespace

ListCounts listRowsVbmi2(const SignLattice& lattice, size_t z, size_t first, size_t last, uint32_t* edges,
                         uint64_t* cells) {
  return listRows<Compressed>(lattice, z, first, last, edges, cells);
}

}  // namespace sgm
HWY_POP_ATTRIBUTES

#endif
