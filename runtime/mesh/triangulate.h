#pragma once
// One loop of cut edges becomes triangles: shared by cube cells and seam cells, in 32-bit integers alone, so that every
// backend chooses the same diagonals.
//
// Among all triangulations whose diagonals lie in no face, the one whose smallest triangle is largest, by dynamic
// programming over chords: best(i, j) is the largest possible smallest triangle of the loop's piece i..j, and for each
// chord the first apex k in ascending order that reaches it is taken. The measure of a triangle is the L1 norm of the
// cross product of two of its sides. Triangles come out in pre-order: (i, k, j), then those of (i, k), then those of
// (k, j). A measure of 0 (a flat triangle) is allowed; a repeated vertex cannot happen.

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "mesh/tables.h"

namespace sgm {

/// A vertex of a loop. Positions may be relative to anything; two points of a loop are at most 512 apart on each axis.
struct LoopPoint {
  int32_t x, y, z;
  uint32_t faces;   ///< the faces of the cell that the vertex's edge lies in
  uint32_t vertex;  ///< what is written into the index list
};

inline int32_t triangleMeasure(const LoopPoint& a, const LoopPoint& b, const LoopPoint& c) {
  const int32_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int32_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return std::abs(uy * vz - uz * vy) + std::abs(uz * vx - ux * vz) + std::abs(ux * vy - uy * vx);
}

/// Any length from 3 to kLongestLoop. Writes 3 * (n - 2) indices and returns the end of them.
uint32_t* triangulateAnyLoop(const LoopPoint* loop, int n, uint32_t* out);

/// As triangulateAnyLoop, with short ways through the commonest lengths.
inline uint32_t* triangulateLoop(const LoopPoint* p, int n, uint32_t* out) {
  const auto write = [&](int a, int b, int c) {
    out[0] = p[a].vertex;
    out[1] = p[b].vertex;
    out[2] = p[c].vertex;
    out += 3;
  };
  if (n == 3) {
    write(0, 1, 2);
    return out;
  }
  if (n > 4) return triangulateAnyLoop(p, n, out);
  const bool odd_allowed = (p[1].faces & p[3].faces) == 0, even_allowed = (p[0].faces & p[2].faces) == 0;
  const int32_t odd = std::min(triangleMeasure(p[0], p[1], p[3]), triangleMeasure(p[1], p[2], p[3]));
  const int32_t even = std::min(triangleMeasure(p[0], p[2], p[3]), triangleMeasure(p[0], p[1], p[2]));
  if (odd_allowed && (!even_allowed || odd >= even)) {
    write(0, 1, 3);
    write(1, 2, 3);
  } else {
    write(0, 2, 3);
    write(0, 1, 2);
  }
  return out;
}

}  // namespace sgm
