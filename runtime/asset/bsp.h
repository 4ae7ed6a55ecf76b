#pragma once
// Space cut into convex cells by the planes of a polyhedron's faces, each all solid or all void.

#include <cstdint>
#include <vector>

#include "asset/convex_cell.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// A side of a plane that a body lies on.
struct Side {
  uint32_t plane = 0;   ///< into BspCells::planes
  bool before = false;  ///< where its normal points

  friend bool operator==(const Side&, const Side&) = default;
};

struct BspCell {
  ConvexCell body;
  std::vector<Side> sides;  ///< that it lies on: between them and within the outer box it is all there is
  Point middle;
  int winding = 0;  ///< how often the polyhedron surrounds the middle
  bool solid = false;
};

struct BspCells {
  std::vector<Plane> planes;       ///< each once, whichever way it looks
  std::vector<uint32_t> plane_of;  ///< of each face
  std::vector<bool> turned;        ///< of each face: it looks the other way than its plane
  std::vector<BspCell> cells;      ///< of all the space about the polyhedron
  double tolerance = 0;

  Plane sidePlane(Side side) const { return side.before ? planes[side.plane].turned() : planes[side.plane]; }
};

inline constexpr size_t kMostCells = 8192;

/// Errors: limit (more than `most` cells).
Result<BspCells> cutIntoCells(const Polyhedron& solid, size_t most = kMostCells);

}  // namespace sgm::asset
