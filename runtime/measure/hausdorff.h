#pragma once
// How far two surfaces lie from each other (Hausdorff distance; sampled as Metro does it: Cignoni, Rocchini and
// Scopigno, 1998).

#include "base/jobs.h"
#include "base/result.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct HausdorffSettings {
  /// Each triangle is cut into the square of this many alike, and sampled in their middles. 1..64
  uint32_t cuts = 2;
  /// Where the bounds of the farthest place lie so close together, in the mesh's unit, no more is looked at. >= 0
  double tolerance = 0;
  /// At most so many of the parts that may hold the farthest place are cut in four again; what is left then has its
  /// bound in at_most.
  uint64_t refinements = uint64_t{1} << 16;
};

/// From each place of one surface to the nearest of the other.
struct OneSided {
  uint64_t samples = 0;  ///< vertices of triangles, and middles of their parts
  /// Bounds of the distance from the farthest place: one that was found, and what no place is beyond, up to rounding.
  double at_least = 0, at_most = 0;
  double mean = 0, rms = 0;  ///< over the area, by the middles
  Point farthest;            ///< the place that has at_least
};

struct Hausdorff {
  OneSided there, back;  ///< from the first to the second, from the second to the first

  double atLeast() const { return there.at_least > back.at_least ? there.at_least : back.at_least; }
  double atMost() const { return there.at_most > back.at_most ? there.at_most : back.at_most; }
};

/// Contract: the coordinates are at most kFarthest. All 0 where `from` has no triangle. Pure; the same bits for any
/// number of threads. Memory: that of a Bvh of `to`, and 12 bytes a part of `from`, 100 where it may hold the farthest
/// place.
/// Errors: invalid_argument where `to` has no triangle and `from` has one, or for settings out of range.
Result<OneSided> distanceFrom(const Triangles& from, const Triangles& to, const HausdorffSettings& settings,
                              JobSystem& jobs);

/// Errors: those of distanceFrom, either way.
Result<Hausdorff> hausdorff(const Triangles& first, const Triangles& second, const HausdorffSettings& settings,
                            JobSystem& jobs);

}  // namespace sgm::measure
