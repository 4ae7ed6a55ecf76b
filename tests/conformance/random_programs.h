#pragma once
// Random field programs over every op, and points to ask them at: what all backends are compared on.

#include <random>
#include <vector>

#include "field/evaluate.h"
#include "field/program.h"

namespace sgm {

/// What well-behaved grammars do not contain, and hostile ones do.
struct Oddities {
  bool far_anchors = false;    ///< some shapes and coordinates at the opposite end of the world
  bool huge_and_tiny = false;  ///< some expressions beyond 1e18, some under 1e-30
};

struct RandomProgramOptions {
  Int3 centre;                 ///< where the shapes lie, units
  int32_t extent = 16 * 1024;  ///< and how far around, units
  int groups = 6;
  int depth = 4;  ///< of combiners
  int32_t finest_cell = 512;
  bool whole_influence = false;  ///< influence boxes that hold everything, instead of random ones
  int smooth_groups = 0;         ///< above the others, each a layer of its own
  Oddities odd;
};

/// Unions inside morphs, displacements, round groups and warps; operands far outside; adds and cuts in layers.
FieldProgram randomProgram(std::mt19937& random, const RandomProgramOptions& options);

/// A program that is one op (with what operands it needs) in an empty domain, read at points around `centre`.
FieldProgram programOf(Op op, std::mt19937& random, Int3 centre, Oddities odd = {});

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

/// The places around which programs are compared: the world's middle, and near its ends.
inline constexpr Int3 kTestCentres[] = {
    {0, 0, 0}, {2'000'000'000, -2'000'000'000, 1'999'000'000}, {-2'047'000'000, 5, 2'000'000'000}};

/// The number of words that differ.
size_t differentBits(const Evaluated& a, const Evaluated& b);

}  // namespace sgm
