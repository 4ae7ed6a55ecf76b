#pragma once
// Plans: what buildings stand on. After Greuter, Parker, Stewart, Leach, Real-time procedural generation of `pseudo
// infinite' cities, GRAPHITE 2003, section 5: regular polygons and rectangles that are put together at random. The
// pieces stay apart: what is extruded from them is united by the field, exactly and without clipping of polygons.

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
  PlanCorner middle;    ///< of its box, in the scope in which the plan was made; of a regular polygon its centre
  double x = 0, z = 0;  ///< edges of its box, which holds it and lies about the middle
  bool rect = false;    ///< its first corner is the lowest along both axes
  std::vector<PlanCorner> corners;  ///< from the middle
};

PlanPiece rectPiece(double x, double z);
/// The middle of the first edge lies towards +z. corners: 3 to 64.
PlanPiece regularPiece(int corners, double radius);
PlanPiece polygonPiece(std::span<const PlanCorner> corners);

/// Puts a piece with its middle on the outline of another, at a place drawn from key: one that holds its middle inside
/// overlaps with the other.
void putOnOutline(PlanPiece& piece, const PlanPiece& other, PathKey key);

bool isConvex(const PlanPiece& piece);

/// Whether it holds an area, and no two of its edges cross.
bool isSimple(const PlanPiece& piece);
/// Whether an outline that grew from the piece's is one still: no edge has been turned about, and none cross. Otherwise
/// a notch was narrower than what grew into it.
bool isSimple(const PlanPiece& piece, const std::vector<PlanCorner>& grown);

/// The corners with all edges moved out by `margin`, which is not negative; a corner by at most kMostMiter margins.
std::vector<PlanCorner> grownOutline(const PlanPiece& piece, double margin);

}  // namespace sgm
