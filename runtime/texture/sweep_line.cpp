#include "texture/sweep_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "derive/sweep.h"

namespace sgm {
namespace {

Vec3 between(Int3 a, Int3 b) {
  return {static_cast<double>(int64_t{b.x} - a.x), static_cast<double>(int64_t{b.y} - a.y),
          static_cast<double>(int64_t{b.z} - a.z)};
}

}  // namespace

SweepLine::SweepLine(std::span<const Int3> points, Vec3 up) {
  const std::vector<LineFrame> frames = framesAlong(points, up);
  for (size_t i = 0; i < frames.size(); ++i) {
    const LineFrame& frame = frames[i];
    segments_.push_back({between(points[0], points[i]), frame.tangent, frame.normal, cross(frame.tangent, frame.normal),
                         frame.length, length_});
    length_ += frame.length;
  }
}

SweepPlace SweepLine::at(Vec3 p) const {
  const Segment* nearest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const Segment& segment : segments_) {
    const Vec3 off = p - segment.from;
    const double t = std::clamp(dot(off, segment.tangent), 0.0, segment.length);
    const Vec3 rest = off - t * segment.tangent;
    const double square = dot(rest, rest);
    if (square < least) {
      least = square;
      nearest = &segment;
    }
  }
  const Vec3 off = p - nearest->from;
  double t = dot(off, nearest->tangent);
  // Only the first segment is extended backwards, beyond the start of the line. Any other segment is clamped at its own
  // start, since the previous segment continues there.
  if (nearest != &segments_.front()) t = std::max(t, 0.0);
  if (nearest != &segments_.back()) t = std::min(t, nearest->length);
  SweepPlace place;
  place.along = nearest->before + t;
  place.outward = off - dot(off, nearest->tangent) * nearest->tangent;
  place.side = dot(place.outward, nearest->side);
  place.up = dot(place.outward, nearest->up);
  place.tangent = nearest->tangent;
  return place;
}

}  // namespace sgm
