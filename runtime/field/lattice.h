#pragma once
// Samples on a lattice of whole positions: what a field from outside of the grammar comes to
// (shaders/common/lattice.h).

#include <array>
#include <cstddef>

#include "base/result.h"
#include "field/interval.h"

namespace sgm {

/// Positions origin + spacing (i, j, k), in units; sampled with x fastest. All of them lie in the world, none farther
/// than 2^30 units from the origin along an axis.
struct SampleLattice {
  Int3 origin;
  int32_t spacing = 1;                     ///< 1 to 2^22
  std::array<uint32_t, 3> count{2, 2, 2};  ///< along x, y, z; an op reads at least two along each

  size_t points() const { return size_t{count[0]} * count[1] * count[2]; }
};

inline constexpr int64_t kMostLatticePoints = int64_t{1} << 22;

/// The points of the cells that hold the box: a world's lattice of that spacing goes through the origin, so that boxes
/// which share a cell share its samples. limit: more than kMostLatticePoints.
Result<SampleLattice> latticeAround(const IntBox& box, int32_t spacing);

/// What the op comes to over a box of positions, and, in double precision, at one of them. p: its parameters.
Interval boundLattice(const uint32_t* p, const PlaceBox& box);
double referenceLattice(const uint32_t* p, double x, double y, double z);

}  // namespace sgm
