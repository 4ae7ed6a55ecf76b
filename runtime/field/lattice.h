#pragma once
// Samples on a lattice of integer positions: the form of a field from outside the grammar (shaders/common/lattice.h).

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

/// The value that counts as far. The magnitude of samples is at most kLargestSample.
inline constexpr float kFarSample = 1e18f, kLargestSample = 1e12f;

/// The points of the cells that contain the box, and of one more cell on every side. The lattice of a spacing passes
/// through the world's origin, so that boxes which share a cell share its samples. At the end of the world, the last
/// whole cell replaces the rest.
SampleLattice latticeAround(const IntBox& box, int32_t spacing);

/// The number of points; nullopt if it exceeds the limit of an op (2^25 points, extent 2^30 units along an axis).
std::optional<size_t> latticePoints(const SampleLattice& lattice);

/// The bounds of the op over a box of positions, and its value at one of them in double precision. p: its parameters.
Interval boundLattice(const uint32_t* p, const PlaceBox& box);
double referenceLattice(const uint32_t* p, double x, double y, double z);

}  // namespace sgm
