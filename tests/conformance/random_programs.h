#pragma once
// Random field programs over every op: what all backends are compared on.

#include <random>

#include "evaluated_points.h"
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

/// The places around which programs are compared: the world's middle, and near its ends.
inline constexpr Int3 kTestCentres[] = {
    {0, 0, 0}, {2'000'000'000, -2'000'000'000, 1'999'000'000}, {-2'047'000'000, 5, 2'000'000'000}};

}  // namespace sgm
