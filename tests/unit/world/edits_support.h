#pragma once
// Random brushes, and the expected results of applying them.

#include <random>

#include "world/edits.h"

namespace sgm {

inline int32_t within(std::mt19937& random, int32_t least, int32_t most) {
  return least + static_cast<int32_t>(random() % static_cast<uint32_t>(most - least + 1));
}

inline Int3 randomPlace(std::mt19937& random, const IntBox& box) {
  Int3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = within(random, box.lo[axis], box.hi[axis]);
  return p;
}

/// A random brush at a position in the box; its sizes are up to `size` units.
inline Brush randomBrush(std::mt19937& random, const IntBox& box, int32_t size) {
  Brush b;
  b.shape = static_cast<Brush::Shape>(random() % 3);
  b.cut = random() % 2 == 0;
  b.material = static_cast<uint16_t>(random() % 4);
  b.tag = static_cast<uint16_t>(random() % 3);
  b.from = randomPlace(random, box);
  b.smooth = random() % 2 == 0 ? 0 : within(random, 1, size);
  b.radius = within(random, 1, size);
  b.half = randomPlace(random, {{1, 1, 1}, {size, size, size}});
  b.to = saturatingAdd(b.from, randomPlace(random, {{-size, -size, -size}, {size, size, size}}));
  if (random() % 2 == 0) {
    for (float& q : b.turn) q = static_cast<float>(within(random, -100, 100)) / 64.0f;
    b.turn[3] += 4.0f;
  }
  return b;
}

}  // namespace sgm
