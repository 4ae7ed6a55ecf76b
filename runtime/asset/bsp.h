#pragma once
// Divides space into convex cells by the planes of a polyhedron's faces; each cell is entirely solid or entirely void.

#include <cstdint>
#include <vector>

#include "asset/convex_cell.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// One of the two half-spaces of a plane.
struct Side {
  uint32_t plane = 0;   ///< index into BspCells::planes
  bool before = false;  ///< true: the half-space in front of the plane, to which its normal points; false: the
                        ///< half-space behind it

  friend bool operator==(const Side&, const Side&) = default;
};

struct BspCell {
  ConvexCell body;
  std::vector<Side> sides;  ///< half-spaces whose intersection, within the bounding box of all cells, is the cell
  Point middle;
  int winding = 0;  ///< winding number of the polyhedron around the cell's middle point
  bool solid = false;
};

struct BspCells {
  std::vector<Plane> planes;       ///< the distinct planes of all faces; planes with opposite normals count as one
  std::vector<uint32_t> plane_of;  ///< for each face: index of its plane in `planes`
  std::vector<bool> turned;        ///< for each face: true if its normal is opposite to the normal of its plane
  std::vector<BspCell> cells;      ///< cells that together fill a box around the polyhedron
  double tolerance = 0;

  Plane sidePlane(Side side) const { return side.before ? planes[side.plane].turned() : planes[side.plane]; }
};

inline constexpr size_t kMaxCells = 8192;

/// Divides the space inside and around a polyhedron into convex cells. Errors: limit if there would be more than `most`
/// cells.
Result<BspCells> cutIntoCells(const Polyhedron& solid, size_t most = kMaxCells);

}  // namespace sgm::asset
