#pragma once
// Finds the lateral edge of a seam that a vertex belongs to at corners where octree levels meet.
//
// 8 octants lie around a corner of the fine grid that is also a corner of the coarse grid. Bits 0, 1, 2 of an octant's
// number are set if the octant is on the high side in x, y, z. Between the octants that share a face lie 12 quarter
// planes, the quads. Quad 4 * axis + b0 + 2 * b1 has its normal along `axis`; b0 and b1 say whether it is on the low
// (0) or high (1) side of the corner on the other two axes, the lower axis first. If exactly one of the quad's two
// octants is coarser, a seam cell covers the quad, with one lateral edge at the corner. Seam cells that meet along an
// axis from the corner share a lateral pentagon. So the lateral edges at a corner form cycles, and all edges of one
// cycle carry the same vertex. The number of the lowest quad in a cycle is its FAN, which keeps the vertices of
// different cycles apart.

#include <array>
#include <cstdint>

#include "mesh/chunk.h"

namespace sgm {

/// The seam cell over `quad` has one lateral edge at the corner: returns the fan of this edge (defined at the top of
/// this file). Bit o of `coarser` is set if octant o belongs to a chunk coarser than the seam's fine level.
/// Precondition: exactly one of the quad's two octants is coarser. If coarser and finer octants alternated around an
/// axis like a checkerboard, all four seam cells around that axis would share a fan; the octree's balance excludes this
/// case.
int lateralFan(uint8_t coarser, int quad);

/// A set of the 26 blocks of a chunk's own size around it, and of the chunk itself. The block at offset (dx, dy, dz),
/// in chunk sizes, has bit (dx + 1) + 3 (dy + 1) + 9 (dz + 1). The set usually marks the blocks that belong to chunks
/// of a coarser level.
using Neighbourhood = uint32_t;
inline constexpr Neighbourhood neighbourBit(int dx, int dy, int dz) {
  return 1u << ((dx + 1) + 3 * (dy + 1) + 9 * (dz + 1));
}
inline constexpr Neighbourhood neighbourBit(Face face) {
  const int side = faceIsHigh(face) ? 1 : -1, axis = faceAxis(face);
  return neighbourBit(axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0);
}

/// Returns the blocks that adjoin the chunk across the given faces. faces: a mask with bit (1 << Face) for each face.
inline constexpr Neighbourhood neighboursAcross(uint8_t faces) {
  Neighbourhood blocks = 0;
  for (int f = 0; f < 6; ++f) blocks |= faces >> f & 1 ? neighbourBit(static_cast<Face>(f)) : 0;
  return blocks;
}

/// The fans of all lateral edges of one seam, by [b][a]. Along each of the two axes, index 0 means the low border of
/// the face, 1 all edges inside, 2 the high border; a counts along u = (axis + 1) % 3, b along v = (axis + 2) % 3.
using SeamFans = std::array<std::array<uint8_t, 3>, 3>;
SeamFans seamFans(Face face, Neighbourhood coarser);

}  // namespace sgm
