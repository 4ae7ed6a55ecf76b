#pragma once
// The case tables of cubes and seam cells, and the numbering of corners, edges and faces. The arrays are generated at
// build time by the rule in case_rule.h, which defines the order of loops; GPUs use the same arrays.
//
// Cube. Corner c lies at (c & 1, c >> 1 & 1, c >> 2). Edge 4 * axis + b0 + 2 * b1 runs along axis; b0 and b1 are its
// coordinates on the two other axes, the lower axis first. Faces are numbered as in Face. Bit c of a case: corner c is
// solid.
//
// Seam cell. It stands on the face of a fine chunk, over one square of the coarse grid. u = (axis + 1) % 3 and
// v = (axis + 2) % 3 are the axes in the face whose normal runs along axis; a counts along u, b along v.
//   corners  a + 3b            fine, a and b 0..2           9 + a + 2b   coarse, a and b 0..1
//   edges    a + 2b            fine along u from (a, b)     6 + a + 3b   fine along v from (a, b)
//            12 + b            coarse along u at b          14 + a       coarse along v at a
//            16 + a + 2b       lateral, from the fine to the coarse corner at coarse (a, b)
//   faces    a + 2b            fine square                  4            coarse square
//            5..8              lateral pentagons: low b, high a, high b, low a
// The table is for a high face; over a low face the same loops are traversed backwards, from the same first edge.
//
// Loops are counter-clockwise as seen from the void. The bytes of case c are LoopStart[c] .. LoopStart[c + 1]: for each
// loop its length n, then its n edges. A diagonal may join two vertices of a seam cell's loop if the kSeamEdgeFaces of
// their edges share no bit, and two of a cube's loop if the chordMask of their edges share none.

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/kernel.h"

namespace sgm {

inline constexpr size_t kCubeLoopBytes = 1894;
inline constexpr size_t kSeamLoopBytes = 98332;
inline constexpr int kCubeEdges = 12;
inline constexpr int kSeamEdges = 20;
inline constexpr int kLongestCubeLoop = 7;
inline constexpr int kLongestLoop = 12;

extern const uint16_t kCubeLoopStart[256 + 1];
extern const uint8_t kCubeLoops[kCubeLoopBytes];
extern const uint8_t kCubeTriangles[256];  ///< number of triangles of each case
/// For each case, its first loop in kCubeLoops, packed as a sum: the offset of the loop's edges, plus its length << 16,
/// plus 1 << 24 if the case has more loops.
extern const uint32_t kCubeFirstLoop[256];
extern const uint16_t kCubeEdgeFaces[kCubeEdges];

/// Returns the mask of an edge for diagonals of a cube's loop of n points. A diagonal must not join two edges whose
/// masks share a bit: edges of one face and, in a loop of seven, opposite parallel edges. faces: kCubeEdgeFaces[edge].
///
/// A loop of seven has two pairs of such edges. Of its sixteen triangulations without a diagonal in a face, four can
/// intersect themselves, and each of these joins one of the pairs. No triangulation of a shorter loop can intersect
/// itself or another loop of its cell, wherever the vertices lie on their edges (tests/unit/mesh/self_cut_test.cpp
/// proves both).
SGM_KERNEL uint32_t chordMask(uint32_t faces, uint32_t edge, int n) {
  const uint32_t pair = edge / 4 * 2 + ((edge ^ edge >> 1) & 1);
  return n == kLongestCubeLoop ? faces | 64u << pair : faces;
}

extern const uint32_t kSeamLoopStart[8192 + 1];
extern const uint8_t kSeamLoops[kSeamLoopBytes];
extern const uint8_t kSeamTriangles[8192];
extern const uint16_t kSeamEdgeFaces[kSeamEdges];

}  // namespace sgm
