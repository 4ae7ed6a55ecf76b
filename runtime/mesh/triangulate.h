#pragma once
// Triangulates one loop of crossed edges, in 32-bit integers alone, so that every backend chooses the same diagonals.
//
// Chooses, among all triangulations with allowed diagonals (LoopPoint::faces), the one whose smallest triangle is
// largest, by dynamic programming over chords: best(i, j) is the largest possible smallest triangle of the loop's piece
// i..j, and each chord takes the first apex k in ascending order that reaches it. The measure of a triangle is the L1
// norm of the cross product of two of its sides. Triangles are output in pre-order: (i, k, j), then those of (i, k),
// then those of (k, j). A measure of 0 (a flat triangle) is allowed; a repeated vertex cannot occur. For the flat loops
// of a seam, least overlap takes precedence over this rule (triangulateFlatLoop).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "mesh/tables.h"
#include "mesh/triangulate_any.h"

// Without this attribute, g++ keeps the unrolled pieces below as calls, at half the speed.
#define SGM_ALWAYS_INLINE __attribute__((always_inline))

namespace sgm {

namespace triangulation {

/// The number of triangulations of a polygon of n points: the Catalan numbers.
inline constexpr std::array<int, 8> kWays{0, 0, 1, 1, 2, 5, 14, 42};

/// Triangulations of a piece of n points are numbered by apex, then by the triangulation of the left piece, then by
/// that of the right piece. Returns the number of the first one with its apex at the k-th point.
constexpr int firstWay(size_t n, size_t k) {
  int way = 0;
  for (size_t earlier = 1; earlier < k; ++earlier) way += kWays[earlier + 1] * kWays[n - earlier];
  return way;
}

/// Writes triangulation number `way` of the n points from `from` on, in pre-order.
constexpr uint8_t* writeWay(size_t from, size_t n, int way, uint8_t* out) {
  if (n < 3) return out;
  size_t k = 1;
  while (k + 1 < n - 1 && firstWay(n, k + 1) <= way) ++k;
  const int inner = way - firstWay(n, k);
  *out++ = static_cast<uint8_t>(from);
  *out++ = static_cast<uint8_t>(from + k);
  *out++ = static_cast<uint8_t>(from + n - 1);
  out = writeWay(from, k + 1, inner / kWays[n - k], out);
  return writeWay(from + k, n - k, inner % kWays[n - k], out);
}

template <size_t N>
constexpr auto makeWays() {
  std::array<std::array<uint8_t, 3 * (N - 2)>, static_cast<size_t>(kWays[N])> ways{};
  for (size_t way = 0; way < ways.size(); ++way) writeWay(0, N, static_cast<int>(way), ways[way].data());
  return ways;
}
template <size_t N>
inline constexpr auto kTriangles = makeWays<N>();

/// Calls f(std::integral_constant<size_t, i>) for Begin <= i < End: a loop that is always unrolled.
template <size_t Begin, size_t End, class F>
SGM_ALWAYS_INLINE inline void unrolled(F&& f) {
  if constexpr (Begin < End) {
    f(std::integral_constant<size_t, Begin>{});
    unrolled<Begin + 1, End>(f);
  }
}

}  // namespace triangulation

/// Same as triangulateAnyLoop, but for a length N known at compile time, and faster: it has no branches, and triangles
/// share cross products. point(i) returns the i-th LoopPoint and is called once for each i.
template <size_t N, class Load>
inline uint32_t* triangulateLoopOf(uint32_t* out, Load&& point) {
  using namespace triangulation;
  struct Cross {
    int32_t x, y, z;
    int32_t norm() const { return std::abs(x) + std::abs(y) + std::abs(z); }
  };
  int32_t x[N], y[N], z[N], best[N][N];
  uint32_t faces[N], vertex[N];
  int way[N][N];
  Cross cross[N][N];  // cross products of the points' positions relative to point 0
  unrolled<0, N>([&](auto index) SGM_ALWAYS_INLINE {
    constexpr size_t i = decltype(index)::value;
    const LoopPoint p = point(i);
    x[i] = p.x, y[i] = p.y, z[i] = p.z, faces[i] = p.faces, vertex[i] = p.vertex;
    if constexpr (i > 0) {
      x[i] -= x[0], y[i] -= y[0], z[i] -= z[0];
      unrolled<1, i>([&](auto other) SGM_ALWAYS_INLINE {
        constexpr size_t j = decltype(other)::value;
        cross[j][i] = {y[j] * z[i] - z[j] * y[i], z[j] * x[i] - x[j] * z[i], x[j] * y[i] - y[j] * x[i]};
      });
    }
    if constexpr (i + 1 < N) best[i][i + 1] = std::numeric_limits<int32_t>::max(), way[i][i + 1] = 0;
  });
  unrolled<2, N>([&](auto span_constant) SGM_ALWAYS_INLINE {
    constexpr size_t kSpan = decltype(span_constant)::value;
    unrolled<0, N - kSpan>([&](auto index) SGM_ALWAYS_INLINE {
      constexpr size_t i = decltype(index)::value, j = i + kSpan;
      int32_t largest = -1;
      int chosen = 0;
      unrolled<1, kSpan>([&](auto apex) SGM_ALWAYS_INLINE {
        constexpr size_t k = i + decltype(apex)::value;
        int32_t measure;
        if constexpr (i == 0) {
          measure = cross[k][j].norm();
        } else {
          const Cross &a = cross[i][k], &b = cross[k][j], &c = cross[i][j];
          measure = Cross{a.x + b.x - c.x, a.y + b.y - c.y, a.z + b.z - c.z}.norm();
        }
        const int32_t smallest = std::min(std::min(best[i][k], best[k][j]), measure);
        constexpr int kFirst = firstWay(kSpan + 1, k - i), kRight = kWays[j - k + 1];
        const bool better = smallest > largest;
        largest = better ? smallest : largest;
        chosen = better ? kFirst + way[i][k] * kRight + way[k][j] : chosen;
      });
      best[i][j] = kSpan == N - 1 || (faces[i] & faces[j]) == 0 ? largest : -1;
      way[i][j] = chosen;
    });
  });
  const uint8_t* triangles = kTriangles<N>[static_cast<size_t>(way[0][N - 1])].data();
  unrolled<0, 3 * (N - 2)>([&](auto i) SGM_ALWAYS_INLINE { out[i] = vertex[triangles[i]]; });
  return out + 3 * (N - 2);
}

/// Calls triangulateLoopOf for a loop of n points. Precondition: 3 <= n <= kLongestCubeLoop. point(i, n) returns the
/// i-th LoopPoint; n is passed as a constant.
template <class Load>
inline uint32_t* triangulateLoop(int n, uint32_t* out, Load&& point) {
  switch (n) {
    case 3:
      for (size_t i = 0; i < 3; ++i) out[i] = point(i, 3).vertex;
      return out + 3;
    case 4:
      return triangulateLoopOf<4>(out, [&](size_t i) SGM_ALWAYS_INLINE { return point(i, 4); });
    case 5:
      return triangulateLoopOf<5>(out, [&](size_t i) SGM_ALWAYS_INLINE { return point(i, 5); });
    case 6:
      return triangulateLoopOf<6>(out, [&](size_t i) SGM_ALWAYS_INLINE { return point(i, 6); });
    default:
      return triangulateLoopOf<7>(out, [&](size_t i) SGM_ALWAYS_INLINE { return point(i, 7); });
  }
}

}  // namespace sgm
