#pragma once
// Random field programs that use every op, on which all backends are compared.

#include <random>

#include "evaluated_points.h"
#include "field/program.h"

namespace sgm {

/// Kinds of extreme values that ordinary grammars do not contain, but malicious ones may.
struct Oddities {
  bool far_anchors = false;    ///< some shapes and coordinates lie at the opposite end of the world
  bool huge_and_tiny = false;  ///< some expressions have values beyond 1e18, some below 1e-30
};

struct RandomProgramOptions {
  Int3 centre;                 ///< centre around which shapes are placed, in units
  int32_t extent = 16 * 1024;  ///< maximum distance of shapes from the centre along each axis, in units
  int groups = 6;
  int depth = 4;  ///< maximum depth of nested combining operations
  int32_t finest_cell = 512;
  bool whole_influence = false;  ///< true: influence boxes are unbounded; false: random
  int smooth_groups = 0;         ///< number of smooth groups after the others, each in a layer of its own
  Oddities odd;
};

/// Makes a program with unions inside morphs, displacements, rounded groups and warps, with operands far outside the
/// sampled points, and with additions and cuts in layers.
FieldProgram randomProgram(std::mt19937& random, const RandomProgramOptions& options);

/// Makes a program with a single operation and the operands that it needs, in an empty domain, to be sampled around
/// `centre`.
FieldProgram programOf(Op op, std::mt19937& random, Int3 centre, Oddities odd = {});

/// The centres around which programs are compared: the middle of the world, and positions near its ends.
inline constexpr Int3 kTestCentres[] = {
    {0, 0, 0}, {2'000'000'000, -2'000'000'000, 1'999'000'000}, {-2'047'000'000, 5, 2'000'000'000}};

}  // namespace sgm
