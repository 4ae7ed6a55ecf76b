#include "mesh/fans.h"

#include <bit>

namespace sgm {
namespace {

/// Returns a mask of the half axes that bound a quad (a quarter plane, mesh/fans.h): bit 2 * axis + side, for the six
/// half axes that start at the corner.
constexpr uint32_t halfAxes(int quad) {
  const int axis = quad / 4, first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  return 1u << (2 * first + (quad & 1)) | 1u << (2 * second + (quad >> 1 & 1));
}

/// For each quad, returns the mask of all quads that share a half axis with it. The mask includes the quad itself.
constexpr std::array<uint16_t, 12> makeNeighbours() {
  std::array<uint16_t, 12> neighbours{};
  for (int q = 0; q < 12; ++q)
    for (int other = 0; other < 12; ++other)
      if ((halfAxes(q) & halfAxes(other)) != 0)
        neighbours[static_cast<size_t>(q)] = static_cast<uint16_t>(neighbours[static_cast<size_t>(q)] | 1u << other);
  return neighbours;
}
constexpr std::array<uint16_t, 12> kNeighbours = makeNeighbours();

/// Returns the number of the octant that a quad touches on the low side of its plane.
constexpr int octantBelow(int quad) {
  const int axis = quad / 4, first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  return (quad & 1) << first | (quad >> 1 & 1) << second;
}

}  // namespace

int lateralFan(uint8_t coarser, int quad) {
  uint32_t interface = 0;
  for (int q = 0; q < 12; ++q) {
    const int below = octantBelow(q), above = below | 1 << (q / 4);
    interface |= static_cast<uint32_t>((coarser >> below ^ coarser >> above) & 1) << q;
  }
  uint32_t cycle = 1u << quad, reached = 0;
  while (cycle != reached) {
    reached = cycle;
    for (uint32_t rest = reached; rest != 0; rest &= rest - 1)
      cycle |= kNeighbours[static_cast<size_t>(std::countr_zero(rest))] & interface;
  }
  return std::countr_zero(cycle);
}

SeamFans seamFans(Face face, Neighbourhood coarser) {
  coarser = (coarser | neighbourBit(face)) & ~neighbourBit(0, 0, 0);
  const int axis = faceAxis(face), u = (axis + 1) % 3, v = (axis + 2) % 3;
  // Returns the position, along one axis, of the block that lies on one side of a corner: its offset from the own
  // block, in chunks. place: the corner is at the low border (0), inside (1) or at the high border (2) of the chunk.
  // side: the low (0) or the high (1) side.
  const auto offset = [](int place, int side) { return place == 1 ? 0 : place == 0 ? side - 1 : side; };
  SeamFans fans{};
  for (int b = 0; b < 3; ++b) {
    for (int a = 0; a < 3; ++a) {
      Int3 place;
      place[axis] = faceIsHigh(face) ? 2 : 0;
      place[u] = a;
      place[v] = b;
      uint32_t octants = 0;
      for (int o = 0; o < 8; ++o) {
        const Neighbourhood block =
            neighbourBit(offset(place.x, o & 1), offset(place.y, o >> 1 & 1), offset(place.z, o >> 2));
        octants |= static_cast<uint32_t>((coarser & block) != 0) << o;
      }
      // All quads at this corner that lie in the seam's face and beside the chunk give the same fan, so any of them
      // will do. Its side along u: if the corner is at the chunk's low border, the chunk lies on the corner's high
      // side, and vice versa. The same holds along v.
      const int side_u = a == 0 ? 1 : 0, side_v = b == 0 ? 1 : 0;
      const int quad = 4 * axis + (u < v ? side_u + 2 * side_v : side_v + 2 * side_u);
      fans[static_cast<size_t>(b)][static_cast<size_t>(a)] =
          static_cast<uint8_t>(lateralFan(static_cast<uint8_t>(octants), quad));
    }
  }
  return fans;
}

}  // namespace sgm
