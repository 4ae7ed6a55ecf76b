#pragma once
// Points at which programs are evaluated, and the results of evaluators there.

#include <random>
#include <vector>

#include "field/evaluate.h"

namespace sgm {

struct PointSet {
  std::vector<int32_t> x, y, z;
  Points points() const { return {x.data(), y.data(), z.data(), x.size()}; }
};

PointSet randomPoints(std::mt19937& random, Int3 centre, int32_t extent, size_t count);
/// Returns every point of the box on a grid with `step` units between points.
PointSet gridPoints(const IntBox& box, int32_t step);

/// All results of an evaluator, as words that are compared bit by bit.
struct Evaluated {
  std::vector<int32_t> q;
  std::vector<float> value, gx, gy, gz;
  std::vector<int16_t> nx, ny;
  std::vector<uint32_t> label;
};
Evaluated evaluate(const FieldKernels& kernels, const ProgramView& program, const Points& points);

/// True if any value differs from the value of an empty or solid domain. If none differs, comparing the results of
/// evaluators would prove nothing.
bool shows(const Evaluated& e);

/// Returns the number of words that differ.
size_t differentBits(const Evaluated& a, const Evaluated& b);

}  // namespace sgm
