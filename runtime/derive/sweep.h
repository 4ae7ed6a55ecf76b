#pragma once
// Tubes and beams: computes an arc between two points, divided into straight segments.

#include <array>
#include <span>
#include <vector>

#include "derive/frame.h"
#include "derive/shape.h"

namespace sgm {

/// Returns the corners of an arc from a to b, flattened to line segments, in world units. The arc is a parabola that
/// deviates from the line a b by at most `bend` units, in its middle. `key` draws the direction of the deviation, and
/// its amount: half to all of the bend. Number of segments: 1 without a bend; otherwise 8 + ceil(16 bend / |b - a|), at
/// most 16, so that the chords stay within bend / segments^2 of the arc. Returns fewer than two corners if a equals b.
std::vector<Int3> bentLine(Int3 a, Int3 b, double bend, PathKey key);

/// One segment of a polyline, with a normal that follows the polyline without twist.
struct LineFrame {
  Vec3 tangent, normal;  ///< unit vectors, perpendicular to each other
  double length = 0;     ///< units
};
/// Returns one frame per segment. The first normal is as close to `up` as possible. Consecutive corners must differ.
std::vector<LineFrame> framesAlong(std::span<const Int3> corners, Vec3 up);

/// A box around one segment of a polyline, with a square cross-section of half edge r (units). The box extends beyond
/// both ends by r, so that it contains the segment of a round tube. The cross-section follows the polyline without
/// twist; one of its sides starts as close to `up` as possible.
struct BeamPiece {
  Frame frame;
  std::array<float, 3> half{};  ///< half extents, units
};
std::vector<BeamPiece> beamAlong(const std::vector<Int3>& corners, double r, Vec3 up);

}  // namespace sgm
