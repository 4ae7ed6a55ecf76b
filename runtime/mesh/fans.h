#pragma once
// Finds the lateral edge of a seam that a vertex belongs to at corners where octree levels meet.
//
// Around a corner of the fine grid that is also one of the coarse grid lie 8 octants: bits 0, 1, 2 of an octant are set
// if it is on the high side in x, y, z. Between octants that share a face lie 12 quarter planes, the quads: quad 4 *
// axis + b0 + 2 * b1 has its normal along axis and lies on the low (0) or high (1) side of the corner on the two other
// axes, the lower axis first. If one of its octants is coarser and the other is not, a seam cell covers the quad, with
// one lateral edge at the corner. Seam cells that meet along an axis from the corner share a lateral pentagon; so the
// lateral edges at a corner form cycles, each of which is a vertex. The fan of a cycle is its lowest quad.

#include <array>
#include <cstdint>

#include "mesh/chunk.h"

namespace sgm {

/// The fan of the lateral edge of the seam cell over `quad`. Bit o of coarser: octant o belongs to a chunk coarser than
/// the seam's fine level. Precondition: exactly one octant of the quad is coarser. In a checkerboard around an axis,
/// which the octree's rules exclude, all four seam cells there share a fan.
int lateralFan(uint8_t coarser, int quad);

/// The 26 blocks of a chunk's own size around it, and the chunk in the middle: bit (dx + 1) + 3 (dy + 1) + 9 (dz + 1)
/// for the block at offset (dx, dy, dz) in chunk sizes. As a mask, it marks the blocks that belong to a chunk of a
/// coarser level.
using Neighbourhood = uint32_t;
inline constexpr Neighbourhood neighbourBit(int dx, int dy, int dz) {
  return 1u << ((dx + 1) + 3 * (dy + 1) + 9 * (dz + 1));
}
inline constexpr Neighbourhood neighbourBit(Face face) {
  const int side = faceIsHigh(face) ? 1 : -1, axis = faceAxis(face);
  return neighbourBit(axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0);
}

/// The blocks across the faces of a mask with bit (1 << Face).
inline constexpr Neighbourhood neighboursAcross(uint8_t faces) {
  Neighbourhood blocks = 0;
  for (int f = 0; f < 6; ++f) blocks |= faces >> f & 1 ? neighbourBit(static_cast<Face>(f)) : 0;
  return blocks;
}

/// The fans of all lateral edges of one seam, [b][a]: 0 at the low border, 1 inside, 2 at the high border of the face;
/// a counts along axis u = (axis + 1) % 3, b along v = (axis + 2) % 3.
using SeamFans = std::array<std::array<uint8_t, 3>, 3>;
SeamFans seamFans(Face face, Neighbourhood coarser);

}  // namespace sgm
