#pragma once
// Random field programs with all operations, and points at which all backends are compared.

#include <random>
#include <vector>

#include "field/evaluate.h"
#include "field/program.h"

namespace sgm {

/// Extreme values that ordinary grammars do not contain, but malicious ones may.
struct Oddities {
  bool far_anchors = false;    ///< some shapes and coordinates lie at the opposite end of the world
  bool huge_and_tiny = false;  ///< some expressions have values beyond 1e18, some below 1e-30
};

struct RandomProgramOptions {
  Int3 centre;                 ///< centre of the shapes, units
  int32_t extent = 16 * 1024;  ///< maximum distance of the shapes from the centre on each axis, units
  int groups = 6;
  int depth = 4;  ///< maximum depth of nested combining operations
  int32_t finest_cell = 512;
  bool whole_influence = false;  ///< influence boxes are unbounded instead of random
  int smooth_groups = 0;         ///< number of smooth groups above the others, each in a layer of its own
  Oddities odd;
};

/// A program with unions inside morphs, displacements, rounded groups and warps, operands far outside the sampled
/// points, and additions and cuts in layers.
FieldProgram randomProgram(std::mt19937& random, const RandomProgramOptions& options);

/// A program with a single operation and the operands that it needs, in an empty domain, to be sampled around `centre`.
FieldProgram programOf(Op op, std::mt19937& random, Int3 centre, Oddities odd = {});

struct PointSet {
  std::vector<int32_t> x, y, z;
  Points points() const { return {x.data(), y.data(), z.data(), x.size()}; }
};

PointSet randomPoints(std::mt19937& random, Int3 centre, int32_t extent, size_t count);
/// Every point of a grid with spacing `step` units in the box.
PointSet gridPoints(const IntBox& box, int32_t step);

/// All results of an evaluator as words, for comparison bit by bit.
struct Evaluated {
  std::vector<int32_t> q;
  std::vector<float> value, gx, gy, gz;
  std::vector<int16_t> nx, ny;
  std::vector<uint32_t> label;
};
Evaluated evaluate(const FieldKernels& kernels, const ProgramView& program, const Points& points);

/// Whether any value differs from that of an empty or solid domain; otherwise comparing the results would prove
/// nothing.
bool shows(const Evaluated& e);

/// The places around which programs are compared: the middle of the world, and near its ends.
inline constexpr Int3 kTestCentres[] = {
    {0, 0, 0}, {2'000'000'000, -2'000'000'000, 1'999'000'000}, {-2'047'000'000, 5, 2'000'000'000}};

/// The number of words in which the results differ.
size_t differentBits(const Evaluated& a, const Evaluated& b);

}  // namespace sgm
