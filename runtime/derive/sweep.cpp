#include "derive/sweep.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace sgm {
namespace {

Vec3 difference(Int3 a, Int3 b) {
  return {static_cast<double>(int64_t{a.x} - b.x), static_cast<double>(int64_t{a.y} - b.y),
          static_cast<double>(int64_t{a.z} - b.z)};
}

Int3 offsetBy(Int3 p, Vec3 units) {
  const auto along = [](int32_t at, double d) { return saturate(at + static_cast<int64_t>(detFloor(d + 0.5))); };
  return {along(p.x, units.x), along(p.y, units.y), along(p.z, units.z)};
}

}  // namespace

std::vector<Int3> bentLine(Int3 a, Int3 b, double bend, PathKey key) {
  const Vec3 line = difference(b, a);
  const double size = length(line);
  if (!(size > 0)) return {a};
  if (!(bend > 0)) return {a, b};
  const int segments = static_cast<int>(std::min(16.0, 8.0 + std::ceil(16.0 * bend / size)));
  const Vec3 tangent = (1.0 / size) * line;
  const Vec3 side = across(tangent, {0, 1, 0}), other = cross(tangent, side);
  const double angle = 2 * kPi * key.unit(0);
  const double height = bend * (0.5 + 0.5 * key.unit(1));
  const Vec3 rise = height * (detCos(angle) * side + detSin(angle) * other);
  std::vector<Int3> corners{a};
  for (int i = 1; i < segments; ++i) {
    const double t = static_cast<double>(i) / segments;
    corners.push_back(offsetBy(a, t * line + (4.0 * t * (1.0 - t)) * rise));
  }
  corners.push_back(b);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<LineFrame> framesAlong(std::span<const Int3> corners, Vec3 up) {
  std::vector<LineFrame> frames;
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec3 line = difference(corners[i + 1], corners[i]);
    LineFrame next;
    next.length = length(line);
    next.tangent = (1.0 / next.length) * line;
    if (i == 0) {
      next.normal = across(next.tangent, up);
    } else {
      // The normal is turned by the smallest rotation from the old tangent to the new one. For a vector perpendicular
      // to the old tangent, this rotation equals the reflection in the plane perpendicular to the sum of both tangents.
      const LineFrame& last = frames.back();
      const Vec3 sum = last.tangent + next.tangent;
      const double square = dot(sum, sum);
      const Vec3 carried = square > 1e-12 ? last.normal - (2.0 * dot(sum, last.normal) / square) * sum : last.normal;
      next.normal = across(next.tangent, carried);
    }
    frames.push_back(next);
  }
  return frames;
}

std::vector<BeamPiece> beamAlong(const std::vector<Int3>& corners, double r, Vec3 up) {
  std::vector<BeamPiece> pieces;
  const std::vector<LineFrame> frames = framesAlong(corners, up);
  for (size_t i = 0; i < frames.size(); ++i) {
    const auto& [tangent, normal, size] = frames[i];
    const Vec3 line = difference(corners[i + 1], corners[i]);
    const Vec3 side = cross(normal, tangent);
    BeamPiece piece;
    piece.frame.origin = offsetBy(corners[i], 0.5 * line);
    const Vec3 rows[3] = {side, normal, tangent};
    for (size_t row = 0; row < 3; ++row) {
      for (int axis = 0; axis < 3; ++axis) {
        piece.frame.rows[3 * row + static_cast<size_t>(axis)] = static_cast<float>(rows[row][axis] + 0.0);
      }
    }
    // The half extents are one unit larger, to compensate for the rounding of the centre.
    const float half = static_cast<float>(r + 1.0);
    piece.half = {half, half, static_cast<float>(0.5 * size + r + 1.0)};
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace sgm
