#pragma once
// Cuts space into convex cells by the planes of a polyhedron's faces; each cell is entirely solid or entirely void.

#include <cstdint>
#include <vector>

#include "asset/convex_cell.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// One side of a plane.
struct Side {
  uint32_t plane = 0;   ///< index into BspCells::planes
  bool before = false;  ///< true: the side to which the normal points

  friend bool operator==(const Side&, const Side&) = default;
};

struct BspCell {
  ConvexCell body;
  std::vector<Side> sides;  ///< the cell is the intersection of these sides within the outer box
  Point middle;
  int winding = 0;  ///< winding number of the polyhedron around the cell's middle point
  bool solid = false;
};

struct BspCells {
  std::vector<Plane> planes;       ///< the different planes of all faces, regardless of direction
  std::vector<uint32_t> plane_of;  ///< index of each face's plane
  std::vector<bool> turned;        ///< for each face: true if its normal is opposite to that of its plane
  std::vector<BspCell> cells;      ///< cells that together fill the polyhedron's outer box
  double tolerance = 0;

  Plane sidePlane(Side side) const { return side.before ? planes[side.plane].turned() : planes[side.plane]; }
};

inline constexpr size_t kMaxCells = 8192;

/// Cuts the space around and inside a polyhedron. Errors: limit if there would be more than `most` cells.
Result<BspCells> cutIntoCells(const Polyhedron& solid, size_t most = kMaxCells);

}  // namespace sgm::asset
