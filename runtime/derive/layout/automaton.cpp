#include "derive/layout/automaton.h"

#include <algorithm>

#include "base/hash.h"

namespace sgm {
namespace {

using Counts = std::vector<uint16_t>;  // for each voxel: the number of solid voxels in its neighbourhood, at most 31^3

size_t countAlong(const VoxelBox& box, int axis) { return static_cast<size_t>(box.count[axis]); }

/// Returns the random initial state of a box. Each voxel uses 16 random bits that depend only on its indices; one hash
/// gives the bits of four voxels of a row.
Counts filled(const Automaton& automaton, const VoxelBox& box) {
  const auto under = [](uint64_t above, int32_t index) { return hashCombine(above, static_cast<uint32_t>(index)); };
  const auto indexAt = [&](int axis, int32_t i) {
    return automaton.axes[static_cast<size_t>(axis)] ? box.first[axis] + i : 0;
  };
  const auto first_void = static_cast<uint64_t>(std::clamp(automaton.fill, 0.0, 1.0) * 65536 + 0.5);
  Counts out;
  out.reserve(countAlong(box, 0) * countAlong(box, 1) * countAlong(box, 2));
  for (int32_t z = 0; z < box.count.z; ++z) {
    const uint64_t plane = under(automaton.seed, indexAt(2, z));
    for (int32_t y = 0; y < box.count.y; ++y) {
      const uint64_t row = under(plane, indexAt(1, y));
      uint64_t draws = 0;
      for (int32_t x = 0; x < box.count.x; ++x) {
        const int32_t index = indexAt(0, x), among = index & 3;
        if (x == 0 || among == 0) draws = under(row, index >> 2);
        out.push_back((draws >> (16 * among) & 0xFFFF) < first_void ? 1 : 0);
      }
    }
  }
  return out;
}

/// Returns for each voxel the sum over 2 * radius + 1 voxels along an axis: the voxel itself and its neighbours on both
/// sides. The box loses `radius` voxels at both ends, where not all neighbours are known.
Counts summed(const Counts& in, VoxelBox& box, int axis, int32_t radius) {
  size_t inner = 1, outer = 1;
  for (int a = 0; a < axis; ++a) inner *= countAlong(box, a);
  for (int a = axis + 1; a < 3; ++a) outer *= countAlong(box, a);
  const size_t before = countAlong(box, axis) * inner;
  box.first[axis] += radius;
  box.count[axis] -= 2 * radius;
  const size_t after = countAlong(box, axis) * inner;
  Counts out(after * outer);
  for (size_t o = 0; o < outer; ++o) {
    const uint16_t* from = in.data() + o * before;
    uint16_t* to = out.data() + o * after;
    for (int32_t k = 0; k <= 2 * radius; ++k, from += inner) {
      for (size_t i = 0; i < after; ++i) to[i] = static_cast<uint16_t>(to[i] + from[i]);
    }
  }
  return out;
}

}  // namespace

std::vector<uint8_t> runAutomaton(const Automaton& automaton, const VoxelBox& box) {
  VoxelBox known = box;
  for (int axis = 0; axis < 3; ++axis) {
    if (!automaton.axes[static_cast<size_t>(axis)]) continue;
    known.first[axis] -= automaton.halo();
    known.count[axis] += 2 * automaton.halo();
  }
  Counts state = filled(automaton, known);
  for (int32_t round = 0; round < automaton.rounds; ++round) {
    for (int axis = 0; axis < 3; ++axis) {
      if (automaton.axes[static_cast<size_t>(axis)]) state = summed(state, known, axis, automaton.radius);
    }
    for (uint16_t& count : state) count = count >= automaton.least ? 1 : 0;
  }
  return {state.begin(), state.end()};
}

}  // namespace sgm
