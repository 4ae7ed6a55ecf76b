#pragma once
// The distance between two surfaces (Hausdorff distance; sampled as in Metro: Cignoni, Rocchini and Scopigno, 1998).

#include "base/jobs.h"
#include "base/result.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct HausdorffSettings {
  /// Each triangle is divided into cuts^2 equal parts, each of which is sampled at its middle. 1..64
  uint32_t cuts = 2;
  /// The search for the farthest point ends when the bounds at_least and at_most of its distance differ by at most this
  /// length, in the mesh's unit. >= 0
  double tolerance = 0;
  /// The maximum number of splits: a part that may contain the farthest point is split into four. After the last split,
  /// at_most includes the bounds of the parts that could still contain it.
  uint64_t refinements = uint64_t{1} << 16;
};

/// The distances from points of one surface to the nearest points of the other surface.
struct OneSided {
  uint64_t samples = 0;  ///< number of samples: vertices of triangles, and middles of their parts
  /// Bounds of the largest distance. at_least: a distance that was found at a point of the surface; at_most: no point
  /// of the surface has a larger distance, up to rounding.
  double at_least = 0, at_most = 0;
  /// mean and root mean square of the distances at the middles of the triangles' parts, weighted by area
  double mean = 0, rms = 0;
  Point farthest;  ///< the point at distance at_least
};

struct Hausdorff {
  OneSided there, back;  ///< from the first surface to the second, and in the opposite direction

  double atLeast() const { return there.at_least > back.at_least ? there.at_least : back.at_least; }
  double atMost() const { return there.at_most > back.at_most ? there.at_most : back.at_most; }
};

/// Measures the distances from points of `from` to `to`. Returns all 0 if `from` has no triangle. Precondition: the
/// coordinates are at most kFarthest. Pure; the same bits for any number of threads. Memory: a Bvh of `to`, and 12
/// bytes per part of `from`, or 100 if the part may contain the farthest point. Errors: invalid_argument if a setting
/// is out of range, or if `to` has no triangle and `from` has one.
Result<OneSided> distanceFrom(const Triangles& from, const Triangles& to, const HausdorffSettings& settings,
                              JobSystem& jobs);

/// Calls distanceFrom in both directions. Errors: those of distanceFrom.
Result<Hausdorff> hausdorff(const Triangles& first, const Triangles& second, const HausdorffSettings& settings,
                            JobSystem& jobs);

}  // namespace sgm::measure
