#pragma once
// A lattice of samples at integer positions: the form in which a program stores host fields and voxels
// (shaders/common/lattice.h).

#include <array>
#include <cstddef>
#include <optional>

#include "field/interval.h"

namespace sgm {

/// The positions origin + spacing (i, j, k), in units, with i fastest. All of them lie in the world.
struct SampleLattice {
  Int3 origin;
  int32_t spacing = 1;  ///< 1 to 2^22
  /// number of points along x, y, z; an op reads at least four along each axis
  std::array<uint32_t, 3> count{4, 4, 4};
};

/// kFarSample: the magnitude of the lattice op's value where the interpolated value reaches the op's limit. Samples
/// have a magnitude of at most kLargestSample.
inline constexpr float kFarSample = 1e18f, kLargestSample = 1e12f;

/// Returns the points of the lattice cells that contain the box, and of one more cell on every side. Lattices of equal
/// spacing all pass through the world's origin, so that all boxes that contain a cell use the same samples for this
/// cell. At the world's border the lattice ends with the last cell that lies completely in the world.
SampleLattice latticeAround(const IntBox& box, int32_t spacing);

/// Returns the number of points; nullopt if it exceeds the limits of an op (2^25 points; an extent of 2^30 units along
/// an axis).
std::optional<size_t> latticePoints(const SampleLattice& lattice);

/// boundLattice() returns bounds of the lattice op over a box of positions; referenceLattice() returns its value at a
/// position in double precision. p: the op's parameter words.
FloatInterval boundLattice(const uint32_t* p, const PositionBox& box);
double referenceLattice(const uint32_t* p, double x, double y, double z);

}  // namespace sgm
