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
  uint32_t plane = 0;   ///< into BspCells::planes
  bool before = false;  ///< the side to which the normal points

  friend bool operator==(const Side&, const Side&) = default;
};

struct BspCell {
  ConvexCell body;
  std::vector<Side> sides;  ///< the cell is their intersection within the outer box
  Point middle;
  int winding = 0;  ///< winding number of the polyhedron around the middle
  bool solid = false;
};

struct BspCells {
  std::vector<Plane> planes;       ///< each once, regardless of its direction
  std::vector<uint32_t> plane_of;  ///< for each face
  std::vector<bool> turned;        ///< for each face: it faces against its plane
  std::vector<BspCell> cells;      ///< of all the space around the polyhedron
  double tolerance = 0;

  Plane sidePlane(Side side) const { return side.before ? planes[side.plane].turned() : planes[side.plane]; }
};

inline constexpr size_t kMostCells = 8192;

/// Errors: limit (more than `most` cells).
Result<BspCells> cutIntoCells(const Polyhedron& solid, size_t most = kMostCells);

}  // namespace sgm::asset
