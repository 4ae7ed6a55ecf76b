#include "mesh/triangulate.h"

namespace sgm {

uint32_t* triangulateLoop(const LoopPoint* loop, int n, uint32_t* out) {
  return triangulateLoop(n, out, [loop](size_t i) -> const LoopPoint& { return loop[i]; });
}

}  // namespace sgm
