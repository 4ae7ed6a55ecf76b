#pragma once
// Tubes and beams: a quadratic bend, flattened to segments.

#include <array>
#include <span>
#include <vector>

#include "derive/frame.h"
#include "derive/shape.h"

namespace sgm {

/// Corners of the flattened arc from a to b, world units. The arc is a parabola that deviates from the line a b by up
/// to `bend` units at its middle. `key` draws the direction across the line and the used share of the bend (half of it
/// to all). Segments: 1 without a bend, otherwise 8 + ceil(16 bend / |b - a|), at most 16, so that the chords stay
/// within bend / segments^2 of the arc. Fewer than two corners if a equals b.
std::vector<Int3> bentLine(Int3 a, Int3 b, double bend, PathKey key);

/// One segment of a line, and a normal that is transported along it without twist.
struct LineFrame {
  Vec3 tangent, normal;  ///< of length 1, perpendicular
  double length = 0;     ///< units
};
/// One per segment; the first normal is as close to `up` as possible. Consecutive corners must differ.
std::vector<LineFrame> framesAlong(std::span<const Int3> corners, Vec3 up);

/// A box around each segment with a square section of half edge r (units), extended by r at both ends so that it
/// contains the round tube's segment. The section is transported without twist; one side starts as close to `up` as
/// possible.
struct BeamPiece {
  Frame frame;
  std::array<float, 3> half{};  ///< units
};
std::vector<BeamPiece> beamAlong(const std::vector<Int3>& corners, double r, Vec3 up);

}  // namespace sgm
