#pragma once
// Tubes and beams: a quadratic bend, flattened to segments.

#include <array>
#include <span>
#include <vector>

#include "derive/frame.h"
#include "derive/shape.h"

namespace sgm {

/// Corners of the flattened arc from a to b, world units. The arc is the parabola that leaves the line a b by up to
/// `bend` units, half way, in a direction across it that `key` draws together with how much of the bend is used (half
/// of it to all). Segments: 1 without a bend, otherwise 8 + ceil(16 bend / |b - a|), at most 16, so that the corners'
/// chords stay within bend / segments^2 of the arc. Fewer than two corners where a equals b.
std::vector<Int3> bentLine(Int3 a, Int3 b, double bend, PathKey key);

/// One segment of a line, and a direction across it that is carried along without twist.
struct LineFrame {
  Vec3 tangent, normal;  ///< of length 1, at right angles
  double length = 0;     ///< units
};
/// Of each segment; the first normal is as near to `up` as it gets. Neighbouring corners are not the same.
std::vector<LineFrame> framesAlong(std::span<const Int3> corners, Vec3 up);

/// A box about each segment with a square section of half edge r (units), longer by r at both ends so that it holds the
/// round tube's segment. The section is carried along without twist; it starts with one side as near to `up` as it
/// gets.
struct BeamPiece {
  Frame frame;
  std::array<float, 3> half{};  ///< units
};
std::vector<BeamPiece> beamAlong(const std::vector<Int3>& corners, double r, Vec3 up);

}  // namespace sgm
