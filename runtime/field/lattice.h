#pragma once
// Samples on a lattice of whole positions: what a field from outside of the grammar comes to
// (shaders/common/lattice.h).

#include <array>
#include <cstddef>
#include <optional>

#include "field/interval.h"

namespace sgm {

/// Positions origin + spacing (i, j, k), in units; sampled with x fastest. All of them lie in the world.
struct SampleLattice {
  Int3 origin;
  int32_t spacing = 1;                     ///< 1 to 2^22
  std::array<uint32_t, 3> count{4, 4, 4};  ///< along x, y, z; an op reads at least four along each
};

/// A value that counts as far. Samples are no larger than kLargestSample.
inline constexpr float kFarSample = 1e18f, kLargestSample = 1e12f;

/// The points of the cells that hold the box, and of one more on every side: a world's lattice of that spacing goes
/// through the origin, so that boxes which share a cell share its samples. Where the world ends the last whole cell
/// stands for what is left of it.
SampleLattice latticeAround(const IntBox& box, int32_t spacing);

/// Nothing: more than an op can have (2^25, none farther than 2^30 units from the origin along an axis).
std::optional<size_t> latticePoints(const SampleLattice& lattice);

/// What the op comes to over a box of positions, and, in double precision, at one of them. p: its parameters.
Interval boundLattice(const uint32_t* p, const PlaceBox& box);
double referenceLattice(const uint32_t* p, double x, double y, double z);

}  // namespace sgm
