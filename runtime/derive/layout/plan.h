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

/// A simple polygon of 3 to 64 corners, counter-clockwise as seen from below (x towards z), about its own middle.
struct PlanPiece {
  PlanCorner middle;                ///< of its box, in the scope of the plan; of a regular polygon its centre
  double x = 0, z = 0;              ///< edges of its box, which contains it and is centred on the middle
  bool rect = false;                ///< its first corner is the lowest along both axes
  std::vector<PlanCorner> corners;  ///< relative to the middle
};

PlanPiece rectPiece(double x, double z);
/// The middle of the first edge lies towards +z. corners: 3 to 64.
PlanPiece regularPiece(int corners, double radius);
PlanPiece polygonPiece(std::span<const PlanCorner> corners);

/// Puts the middle of a piece on the outline of another, at a position drawn from key: a piece that contains its middle
/// overlaps with the other.
void putOnOutline(PlanPiece& piece, const PlanPiece& other, PathKey key);

bool isConvex(const PlanPiece& piece);

/// True if it has an area, and no two of its edges cross.
bool isSimple(const PlanPiece& piece);
/// True if an outline grown from the piece's is still valid: no edge is reversed, and none cross. Otherwise the growth
/// closed a notch.
bool isSimple(const PlanPiece& piece, const std::vector<PlanCorner>& grown);

/// The corners with all edges moved outwards by `margin`, at least 0; a corner moves by at most kMostMiter margins.
std::vector<PlanCorner> grownOutline(const PlanPiece& piece, double margin);

}  // namespace sgm
