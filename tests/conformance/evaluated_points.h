#pragma once
// Points to ask programs at, and what evaluators return there.

#include <random>
#include <vector>

#include "field/evaluate.h"

namespace sgm {

struct PointSet {
  std::vector<int32_t> x, y, z;
  Points points() const { return {x.data(), y.data(), z.data(), x.size()}; }
};

PointSet randomPoints(std::mt19937& random, Int3 centre, int32_t extent, size_t count);
/// Every point of a grid of `step` units in the box.
PointSet gridPoints(const IntBox& box, int32_t step);

/// All that an evaluator returns, as words, for comparison bit by bit.
struct Evaluated {
  std::vector<int32_t> q;
  std::vector<float> value, gx, gy, gz;
  std::vector<int16_t> nx, ny;
  std::vector<uint32_t> label;
};
Evaluated evaluate(const FieldKernels& kernels, const ProgramView& program, const Points& points);

/// Whether a value is other than the empty or solid domain's: else a comparison of such programs proves nothing.
bool shows(const Evaluated& e);

/// The number of words that differ.
size_t differentBits(const Evaluated& a, const Evaluated& b);

}  // namespace sgm
