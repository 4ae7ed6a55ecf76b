#include "backend/cpu/extract/list_vbmi2.h"

#include <hwy/base.h>

#if HWY_ARCH_X86_64

#if !HWY_COMPILER_CLANG
// GCC warns about values that GCC's own header of intrinsics leaves uninitialised on purpose.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>

#include "mesh/tables.h"

namespace sgm {

bool vbmi2RunsHere() {
  static const bool can = __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vbmi") &&
                          __builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("gfni") &&
                          __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
  return can;
}

}  // namespace sgm

HWY_PUSH_ATTRIBUTES("avx512f,avx512vl,avx512bw,avx512dq,avx512vbmi,avx512vbmi2,gfni,avx2,bmi,bmi2,popcnt,lzcnt")
namespace sgm {
namespace {

#define FN HWY_INLINE

#include "backend/cpu/extract/lattice.inl"

/// Where a vector of edges holds the edges along one axis. Three vectors list the possible edges of 64 samples, one
/// byte per edge: the x, y and z edge of each sample in turn. shift: index of the first sample whose edge along the
/// axis is in the vector. bytes: mask of the bytes of the vector that hold edges along the axis.
struct TurnOfAxis {
  int shift;
  uint64_t bytes;
};
struct Tables {
  TurnOfAxis turns[3][3];              ///< turns[v][a]: where vector v holds the edges along axis a
  alignas(64) uint8_t edge[3][64];     ///< edge[v][i]: for byte i of vector v, the edge's axis (two bits) and its
                                       ///< sample (six bits)
  alignas(64) uint8_t number[64];      ///< index of a byte in its vector
  alignas(64) uint8_t following[64];   ///< index of the next byte
  alignas(64) uint8_t by_samples[64];  ///< permutation of the bytes of 8 words; brings together the bytes for the same
                                       ///< 8 samples
};
constexpr Tables makeTables() {
  Tables tables{};
  for (int vector = 0; vector < 3; ++vector) {
    for (int axis = 0; axis < 3; ++axis) {
      TurnOfAxis& turn = tables.turns[vector][axis];
      turn.shift = (64 * vector - axis + 2) / 3;
      for (int i = 0; i < 64; ++i) turn.bytes |= static_cast<uint64_t>((64 * vector + i) % 3 == axis) << i;
    }
    for (int i = 0; i < 64; ++i) {
      const int turn = 64 * vector + i;
      tables.edge[vector][i] = static_cast<uint8_t>(turn % 3 << 6 | turn / 3);
    }
  }
  for (int i = 0; i < 64; ++i) {
    tables.number[i] = static_cast<uint8_t>(i);
    tables.following[i] = static_cast<uint8_t>(i < 63 ? i + 1 : i);
    tables.by_samples[i] = static_cast<uint8_t>(8 * (7 - i % 8) + i / 8);
  }
  return tables;
}
constexpr Tables kTables = makeTables();

FN __m512i bytesOf(const uint8_t* bytes) { return _mm512_load_si512(bytes); }

/// Transposes bits: bit i of word k becomes bit k of byte i. Groups the bytes by samples, then transposes each group of
/// eight bytes as a bit matrix.
FN __m512i spreadBits(__m512i words) {
  return _mm512_gf2p8affine_epi64_epi8(_mm512_set1_epi64(static_cast<int64_t>(0x8040201008040201u)),
                                       _mm512_permutexvar_epi8(bytesOf(kTables.by_samples), words), 0);
}

/// The lists that are being written. Up to two vectors may be written past the end of each.
struct Listing {
  uint32_t* edges;
  uint64_t* cells;
  __m512i triangles;  ///< number of triangles of the listed cells, in eight partial sums that must be added
};

/// Appends the packed crossed edges along x, y and z that start at 64 samples from `first` on. A branch on the number
/// of edges would often be mispredicted. So vectors are always written, even if they are empty.
FN void listEdges(const uint64_t (&crossed)[3], uint32_t first, Listing& out) {
  constexpr uint32_t kSample = 63, kAxis = 3u << 2 * kPlaceBits;
  const auto packed = [&](__m128i edges) {
    const __m512i edge = _mm512_cvtepu8_epi32(edges);
    const __m512i both = _mm512_or_si512(edge, _mm512_slli_epi32(edge, 2 * kPlaceBits - 6));
    return _mm512_add_epi32(_mm512_and_si512(both, _mm512_set1_epi32(static_cast<int32_t>(kSample | kAxis))),
                            _mm512_set1_epi32(static_cast<int32_t>(first)));
  };
  for (int vector = 0; vector < 3; ++vector) {
    uint64_t wanted = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const TurnOfAxis& turn = kTables.turns[vector][axis];
      wanted |= _pdep_u64(crossed[axis] >> turn.shift, turn.bytes);
    }
    const __m512i edges = _mm512_maskz_compress_epi8(wanted, bytesOf(kTables.edge[vector]));
    const auto count = static_cast<size_t>(std::popcount(wanted));
    _mm512_storeu_si512(out.edges, packed(_mm512_castsi512_si128(edges)));
    if (count > 16) {
      alignas(64) uint8_t bytes[64];
      _mm512_store_si512(bytes, edges);
      for (size_t i = 16; i < count; i += 16)
        _mm512_storeu_si512(out.edges + i, packed(_mm_load_si128(reinterpret_cast<const __m128i*>(bytes + i))));
    }
    out.edges += count;
  }
}

FN __m512i trianglesOf(__m512i cases) {
  const uint8_t* const of = kCubeTriangles;
  const __m512i low = _mm512_permutex2var_epi8(_mm512_loadu_si512(of), cases, _mm512_loadu_si512(of + 64)),
                high = _mm512_permutex2var_epi8(_mm512_loadu_si512(of + 128), cases, _mm512_loadu_si512(of + 192));
  return _mm512_mask_mov_epi8(low, _mm512_movepi8_mask(cases), high);
}

/// Appends the packed active cells of a word of samples. `place`: index of the word's first cell; `beyond`: for each
/// cell, the number that packedCell() takes as `beyond`.
FN void listCells(uint64_t active, __m512i cases, __m512i beyond, size_t place, Listing& out) {
  const __m512i base = _mm512_set1_epi64(static_cast<int64_t>(place << 16));
  const auto packed = [&](__m128i case_and_beyond, __m128i number) {
    return _mm512_add_epi64(_mm512_add_epi64(_mm512_cvtepu16_epi64(case_and_beyond), base),
                            _mm512_slli_epi64(_mm512_cvtepu8_epi64(number), 16));
  };
  const __m512i of_case = _mm512_maskz_compress_epi8(active, cases),
                of_beyond = _mm512_maskz_compress_epi8(active, beyond),
                numbers = _mm512_maskz_compress_epi8(active, bytesOf(kTables.number));
  const auto count = static_cast<size_t>(std::popcount(active));
  const auto write = [&](__m128i a, __m128i b, __m128i number, uint64_t* to) {
    _mm512_storeu_si512(to, packed(_mm_unpacklo_epi8(a, b), number));
    _mm512_storeu_si512(to + 8, packed(_mm_unpackhi_epi8(a, b), _mm_srli_si128(number, 8)));
  };
  write(_mm512_castsi512_si128(of_case), _mm512_castsi512_si128(of_beyond), _mm512_castsi512_si128(numbers), out.cells);
  if (count > 16) {
    alignas(64) uint8_t bytes[3][64];
    _mm512_store_si512(bytes[0], of_case);
    _mm512_store_si512(bytes[1], of_beyond);
    _mm512_store_si512(bytes[2], numbers);
    const auto part = [&](size_t k, size_t i) {
      return _mm_load_si128(reinterpret_cast<const __m128i*>(bytes[k] + i));
    };
    for (size_t i = 16; i < count; i += 16) write(part(0, i), part(1, i), part(2, i), out.cells + i);
  }
  out.cells += count;
  out.triangles = _mm512_add_epi64(
      out.triangles, _mm512_sad_epu8(_mm512_maskz_mov_epi8(active, trianglesOf(cases)), _mm512_setzero_si512()));
}

/// The four rows of samples around a row of cells, in the order of the bits of a marching cubes case; and the row of
/// samples that follows them along y.
struct RowsOfCells {
  const uint64_t *rows[4], *following;
};

/// Appends the edges and cells of a word of samples.
FN void listWord(const SignLattice& lattice, const RowsOfCells& around, bool has_cells, size_t y, size_t word,
                 Listing& out) {
  const bool goes_on = word + 1 < lattice.words;
  const uint64_t last = goes_on ? 0 : uint64_t{1} << (lattice.size[0] - 1) % 64, going = goes_on ? ~uint64_t{0} : 0;
  uint64_t next[4], low[4], high[4];
  // The successor of the row's last sample is the sample itself: equal signs mean that no edge begins there.
  const auto highOf = [&](uint64_t signs, uint64_t following) { return signs >> 1 | following << 63 | (signs & last); };
  uint64_t some = 0, every = ~uint64_t{0};
  for (size_t i = 0; i < 4; ++i) {
    low[i] = around.rows[i][word];
    next[i] = around.rows[i][word + goes_on] & going;
    high[i] = highOf(low[i], next[i]);
    some |= low[i] | high[i];
    every &= low[i] & high[i];
  }
  listEdges({low[0] ^ high[0], low[0] ^ low[1], low[0] ^ low[2]}, static_cast<uint32_t>(y << kPlaceBits | word * 64),
            out);
  if (!has_cells) return;

  const uint64_t active = some & ~every & wordMask(word, lattice.size[0] - 1);
  const __m512i cases = spreadBits(_mm512_set_epi64(static_cast<int64_t>(high[3]), static_cast<int64_t>(low[3]),
                                                    static_cast<int64_t>(high[2]), static_cast<int64_t>(low[2]),
                                                    static_cast<int64_t>(high[1]), static_cast<int64_t>(low[1]),
                                                    static_cast<int64_t>(high[0]), static_cast<int64_t>(low[0])));
  // `behind` is the byte that follows the byte of the last cell: for rows 0 to 2, the signs of the first two samples of
  // the next word. If these two signs differ, the edge along x between the samples is crossed. If the rows have no two
  // further samples, the byte is 0, so no edge is crossed.
  const bool has_two = (word + 1) * 64 + 1 < lattice.size[0];
  const uint64_t behind = (next[0] & 3) | (next[1] & 3) << 2 | (next[2] & 3) << 4;
  const __m512i following = _mm512_mask_set1_epi8(_mm512_permutexvar_epi8(bytesOf(kTables.following), cases),
                                                  uint64_t{1} << 63, static_cast<char>(has_two ? behind : 0));
  // Bits 0 to 2 of along_x belong to rows 0 to 2. A bit is set if the row's edge along x that starts at the cell's high
  // x is crossed. The signs at the ends of these three edges are in the case of the following cell: bits 0 and 1, bits
  // 2 and 3, bits 4 and 5.
  const __m512i along_x =
      _mm512_gf2p8affine_epi64_epi8(following, _mm512_set1_epi64(static_cast<int64_t>(0x030C300000000000u)), 0);
  const uint64_t far = around.following[word], far_next = around.following[word + goes_on] & going;
  const __m512i along_y = _mm512_or_si512(_mm512_maskz_set1_epi8(low[1] ^ far, 8),
                                          _mm512_maskz_set1_epi8(high[1] ^ highOf(far, far_next), 16));
  listCells(active, cases, _mm512_or_si512(along_x, along_y), y * lattice.size[0] + word * 64, out);
}

/// For each word of signs, returns the signs of the samples that follow along x: the signs shifted by one sample.
/// `behind`: for each word, the word that follows it.
FN __m512i highOf(__m512i low, __m512i behind) {
  return _mm512_or_si512(_mm512_srli_epi64(low, 1), _mm512_slli_epi64(behind, 63));
}

/// Appends the words of a row that have crossed edges or active cells, each as row * 256 + word. Returns their number.
FN size_t wordsOf(const SignLattice& lattice, const RowsOfCells& around, size_t y, uint32_t* out) {
  static_assert((size_t{1} << kPlaceBits) / 64 <= 256);
  uint32_t* next = out;
  const __m256i numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  for (size_t first = 0; first < lattice.words; first += 8) {
    const size_t left = lattice.words - first;
    const auto here = static_cast<__mmask8>(left >= 8 ? 0xFF : (1u << left) - 1),
               further = static_cast<__mmask8>(left > 8 ? 0xFF : (1u << (left - 1)) - 1);
    __m512i some = _mm512_setzero_si512(), some_next = some, every = _mm512_set1_epi64(-1), every_next = every;
    for (const uint64_t* row : around.rows) {
      const __m512i signs = _mm512_maskz_loadu_epi64(here, row + first),
                    next_signs = _mm512_maskz_loadu_epi64(further, row + first + 1);
      some = _mm512_or_si512(some, signs);
      every = _mm512_and_si512(every, signs);
      some_next = _mm512_or_si512(some_next, next_signs);
      every_next = _mm512_and_si512(every_next, next_signs);
    }
    // No cell begins at the last sample of a row, but edges along y and z may begin there.
    const __m512i cells =
        left > 8 ? _mm512_set1_epi64(-1)
                 : _mm512_mask_set1_epi64(_mm512_set1_epi64(-1), static_cast<__mmask8>(1u << (left - 1)),
                                          static_cast<int64_t>(wordMask(lattice.words - 1, lattice.size[0] - 1)));
    const __m512i across = _mm512_andnot_si512(every, some);
    const __m512i around_cells = _mm512_andnot_si512(_mm512_and_si512(every, highOf(every, every_next)),
                                                     _mm512_or_si512(some, highOf(some, some_next)));
    const __m512i mixed = _mm512_or_si512(across, _mm512_and_si512(around_cells, cells));
    const __mmask8 wanted = _mm512_test_epi64_mask(mixed, mixed);
    _mm256_storeu_si256(
        reinterpret_cast<__m256i*>(next),
        _mm256_maskz_compress_epi32(
            wanted, _mm256_add_epi32(numbers, _mm256_set1_epi32(static_cast<int32_t>(y << 8 | first)))));
    next += std::popcount(wanted);
  }
  return static_cast<size_t>(next - out);
}

#undef FN

}  // namespace

/// Same as listRows of list.inl, but processes whole words of samples. It first finds the words with edges; the work on
/// a word then has no unpredictable branch on the number of the word's edges and cells.
ListCounts listRowsVbmi2(const SignLattice& lattice, size_t z, size_t first, size_t last, uint32_t* edges,
                         uint64_t* cells) {
  const bool above = z + 1 < lattice.size[2];
  const auto rowsAt = [&](size_t y) {
    const size_t next = y + 1 < lattice.size[1] ? y + 1 : y, high = above ? z + 1 : z;
    return RowsOfCells{{lattice.row(y, z), lattice.row(next, z), lattice.row(y, high), lattice.row(next, high)},
                       lattice.row(y + 2 < lattice.size[1] ? y + 2 : next, z)};
  };
  Listing out{edges, cells, _mm512_setzero_si512()};
  constexpr size_t kWords = 256;
  uint32_t words[2 * kWords + 8];
  for (size_t y = first; y < last;) {
    size_t count = 0;
    if (lattice.words == 1) {
      uint64_t mixed = mixedRows(lattice, z, above ? z + 1 : z, y, std::min(y + 64, last));
      for (; mixed != 0; mixed &= mixed - 1)
        words[count++] = static_cast<uint32_t>(y + static_cast<size_t>(std::countr_zero(mixed))) << 8;
      y = std::min(y + 64, last);
    } else {
      for (; y < last && count <= kWords; ++y) {
        const size_t ys[2] = {y, y + 1 < lattice.size[1] ? y + 1 : y}, zs[2] = {z, above ? z + 1 : z};
        if (mixedGroups(lattice, ys, zs) != 0) count += wordsOf(lattice, rowsAt(y), y, words + count);
      }
    }
    for (size_t i = 0; i < count; ++i) {
      const size_t row = words[i] >> 8;
      listWord(lattice, rowsAt(row), above && row + 1 < lattice.size[1], row, words[i] & 255, out);
    }
  }
  return {static_cast<uint64_t>(out.edges - edges), static_cast<uint64_t>(out.cells - cells),
          static_cast<uint64_t>(_mm512_reduce_add_epi64(out.triangles))};
}

}  // namespace sgm
HWY_POP_ATTRIBUTES

#endif
