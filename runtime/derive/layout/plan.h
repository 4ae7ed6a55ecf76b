#pragma once
// Plans: the ground plans of buildings. After Greuter, Parker, Stewart, Leach, Real-time procedural generation of
// `pseudo infinite' cities, GRAPHITE 2003, section 5: randomly combined regular polygons and rectangles. The pieces
// stay separate: the field unites their extrusions, exactly and without polygon clipping.

#include <span>
#include <vector>

#include "base/hash.h"
#include "derive/frame.h"

namespace sgm {

/// A point of the x-z plane, metres.
struct PlanCorner {
  double x = 0, z = 0;
};

/// A simple polygon of 3 to 64 corners, counter-clockwise as seen from below (from x towards z), relative to its own
/// middle.
struct PlanPiece {
  PlanCorner middle;    ///< centre of the bounding box in the plan's scope, metres; for a regular polygon: its centre
  double x = 0, z = 0;  ///< edges of a box that is centred on the middle and contains the polygon, metres
  bool rect = false;    ///< true: the piece is a rectangle whose first corner has the lowest x and z
  std::vector<PlanCorner> corners;  ///< corners relative to the middle, metres
};

PlanPiece rectPiece(double x, double z);
/// Returns a regular polygon; the middle of its first edge lies in direction +z. corners: 3 to 64.
PlanPiece regularPiece(int corners, double radius);
PlanPiece polygonPiece(std::span<const PlanCorner> corners);

/// Moves a piece so that its middle lies on the outline of the other piece, at a position drawn from `key`. If the
/// moved piece contains its own middle, the two pieces overlap.
void putOnOutline(PlanPiece& piece, const PlanPiece& other, PathKey key);

bool isConvex(const PlanPiece& piece);

/// Whether the polygon has an area, and no two of its edges cross.
bool isSimple(const PlanPiece& piece);
/// Whether an outline that was grown from the piece is still valid: no edge is reversed, and no edges cross. If not,
/// the growth has closed a notch.
bool isSimple(const PlanPiece& piece, const std::vector<PlanCorner>& grown);

/// Returns the corners after all edges are moved outwards by `margin`, at least 0. A corner moves by at most kMaxMiter
/// * margin.
std::vector<PlanCorner> grownOutline(const PlanPiece& piece, double margin);

}  // namespace sgm
