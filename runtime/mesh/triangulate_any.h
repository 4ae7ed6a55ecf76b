#pragma once
// Triangulates a loop of crossed edges (triangulate.h) of any length, on the CPU and on a GPU.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/kernel.h"
#include "mesh/tables.h"

namespace sgm {

/// A vertex of a loop. Positions may have any origin; two points of a loop are at most 512 apart on each axis.
struct LoopPoint {
  int32_t x, y, z;
  /// face mask: a diagonal must not join points that share a bit (chordMask, kSeamEdgeFaces in tables.h)
  uint32_t faces;
  uint32_t vertex;  ///< the value written into the index list
};

/// Returns the measure of a triangle's size: the L1 norm of twice its area vector.
SGM_KERNEL int32_t triangleMeasure(const LoopPoint& a, const LoopPoint& b, const LoopPoint& c) {
  const int32_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int32_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return std::abs(uy * vz - uz * vy) + std::abs(uz * vx - ux * vz) + std::abs(ux * vy - uy * vx);
}

/// Writes the 3 * (n - 2) indices of a loop's triangles in pre-order; returns their end. apex[i * kSide + j] is the
/// apex of the triangle over the chord from i to j.
template <int kSide>
SGM_KERNEL uint32_t* writeTriangles(const LoopPoint* loop, int n, const uint8_t* apex, uint32_t* out) {
  uint8_t stack[static_cast<size_t>(2 * kSide)];
  int depth = 0;
  stack[depth++] = 0;
  stack[depth++] = static_cast<uint8_t>(n - 1);
  while (depth > 0) {
    const int j = stack[--depth], i = stack[--depth];
    if (j - i < 2) continue;
    const uint8_t k = apex[i * kSide + j];
    out[0] = loop[i].vertex;
    out[1] = loop[k].vertex;
    out[2] = loop[j].vertex;
    out += 3;
    stack[depth++] = k;
    stack[depth++] = static_cast<uint8_t>(j);
    stack[depth++] = static_cast<uint8_t>(i);
    stack[depth++] = k;
  }
  return out;
}

/// Triangulates a loop of a grid cell, of any length n from 3 to kLongest: writes 3 * (n - 2) indices and returns their
/// end.
template <int kLongest = kLongestLoop>
SGM_KERNEL uint32_t* triangulateAnyLoop(const LoopPoint* loop, int n, uint32_t* out) {
  constexpr int kSide = kLongest;
  int32_t best[static_cast<size_t>(kSide * kSide)];
  uint8_t apex[static_cast<size_t>(kSide * kSide)];
  for (int i = 0; i + 1 < n; ++i) best[i * kSide + i + 1] = std::numeric_limits<int32_t>::max();
  for (int span = 2; span < n; ++span) {
    for (int i = 0; i + span < n; ++i) {
      const int j = i + span;
      int32_t largest = -1;
      if (span == n - 1 || (loop[i].faces & loop[j].faces) == 0) {
        for (int k = i + 1; k < j; ++k) {
          const int32_t sides = std::min(best[i * kSide + k], best[k * kSide + j]);
          if (sides <= largest) continue;
          const int32_t smallest = std::min(sides, triangleMeasure(loop[i], loop[k], loop[j]));
          if (smallest > largest) {
            largest = smallest;
            apex[i * kSide + j] = static_cast<uint8_t>(k);
          }
        }
      }
      best[i * kSide + j] = largest;
    }
  }
  return writeTriangles<kSide>(loop, n, apex, out);
}

/// Triangulates a seam's loop, whose points lie in one plane. Among the triangulations with the least total area,
/// chooses the one whose smallest triangle is largest. The total area is least if no two triangles overlap. If the
/// contours of the two levels cross, the loop crosses itself, and gets the triangles that overlap least. In all other
/// respects the same as triangulateAnyLoop.
SGM_KERNEL uint32_t* triangulateFlatLoop(const LoopPoint* loop, int n, uint32_t* out) {
  constexpr int kSide = kLongestLoop;
  constexpr int32_t kForbidden = 1 << 24;  // stands for "no triangulation": more than the area of any loop
  int32_t total[size_t{kSide} * kSide], best[size_t{kSide} * kSide];
  uint8_t apex[size_t{kSide} * kSide];
  for (int i = 0; i + 1 < n; ++i) {
    total[i * kSide + i + 1] = 0;
    best[i * kSide + i + 1] = std::numeric_limits<int32_t>::max();
  }
  for (int span = 2; span < n; ++span) {
    for (int i = 0; i + span < n; ++i) {
      const int j = i + span;
      int32_t least = kForbidden, largest = -1;
      if (span == n - 1 || (loop[i].faces & loop[j].faces) == 0) {
        for (int k = i + 1; k < j; ++k) {
          const int left = i * kSide + k, right = k * kSide + j;
          const int32_t measure = triangleMeasure(loop[i], loop[k], loop[j]);
          const int32_t area = total[left] + total[right] + measure;
          const int32_t smallest = std::min(std::min(best[left], best[right]), measure);
          if (area > least || (area == least && smallest <= largest)) continue;
          least = area;
          largest = smallest;
          apex[i * kSide + j] = static_cast<uint8_t>(k);
        }
      }
      total[i * kSide + j] = least;
      best[i * kSide + j] = largest;
    }
  }
  return writeTriangles<kSide>(loop, n, apex, out);
}

}  // namespace sgm
