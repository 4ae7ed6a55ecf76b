#pragma once
// The distance between two surfaces (Hausdorff distance; sampled as in Metro: Cignoni, Rocchini and Scopigno, 1998).

#include "base/jobs.h"
#include "base/result.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct HausdorffSettings {
  /// Each triangle is cut into this number squared of equal parts, which are sampled at their middles. 1..64
  uint32_t cuts = 2;
  /// The search ends when the bounds of the farthest point are this close, in the mesh's unit. >= 0
  double tolerance = 0;
  /// At most this number of parts that may contain the farthest point are split into four; the bounds of the remaining
  /// parts enter at_most.
  uint64_t refinements = uint64_t{1} << 16;
};

/// From each point of one surface to the nearest point of the other.
struct OneSided {
  uint64_t samples = 0;  ///< vertices of triangles, and middles of their parts
  /// Bounds of the largest distance: one that was found, and one that no point exceeds, up to rounding.
  double at_least = 0, at_most = 0;
  double mean = 0, rms = 0;  ///< over the area, by the middles
  Point farthest;            ///< the point at distance at_least
};

struct Hausdorff {
  OneSided there, back;  ///< from the first to the second, from the second to the first

  double atLeast() const { return there.at_least > back.at_least ? there.at_least : back.at_least; }
  double atMost() const { return there.at_most > back.at_most ? there.at_most : back.at_most; }
};

/// Precondition: the coordinates are at most kFarthest. All 0 if `from` has no triangle. Pure; the same bits for any
/// number of threads. Memory: that of a Bvh of `to`, and 12 bytes per part of `from`, or 100 if it may contain the
/// farthest point. Errors: invalid_argument if `to` has no triangle and `from` has one, or for settings out of range.
Result<OneSided> distanceFrom(const Triangles& from, const Triangles& to, const HausdorffSettings& settings,
                              JobSystem& jobs);

/// Errors: those of distanceFrom in either direction.
Result<Hausdorff> hausdorff(const Triangles& first, const Triangles& second, const HausdorffSettings& settings,
                            JobSystem& jobs);

}  // namespace sgm::measure
