#pragma once
// Prints the results of a benchmark program as one line of key=value pairs, the format that speed.mjs parses.

#include <cstdio>

#include "measure.h"

namespace bench {

inline void printTimes(const char* stage, const Times& t) {
  std::printf("stage=%s median=%.6f least=%.6f most=%.6f runs=%d processor=%.3f peak_mb=%.1f", stage, t.median, t.least,
              t.most, t.runs, t.processor, peakMemory());
}

inline void printShape(const Shape& s) {
  std::printf(" vertices=%zu triangles=%zu area=%.6f open=%zu euler=%ld", s.vertices, s.triangles, s.area, s.open_edges,
              s.euler);
}

}  // namespace bench
