#include "mesh/triangulate.h"

#include <limits>

namespace sgm {

uint32_t* triangulateAnyLoop(const LoopPoint* loop, int n, uint32_t* out) {
  constexpr int kSide = kLongestLoop;
  int32_t best[kSide * kSide];
  uint8_t apex[kSide * kSide];
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
  uint8_t stack[2 * kSide];
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

uint32_t* triangulateLoop(const LoopPoint* loop, int n, uint32_t* out) {
  return triangulateLoop(n, out, [loop](size_t i) -> const LoopPoint& { return loop[i]; });
}

}  // namespace sgm
