#pragma once
// The paper's histogram of dihedral angles at the edges of a surface (section 7.4, equations 9 to 14). An edge e leads
// from V1 to V2, where the unit normals are n1 and n2. Angles: a1 = acos(e . n1 / |e|), a2 = acos(e . n2 / |e|) and d =
// a2 - a1. With outward normals, d < 0 where the surface is convex. The paper states the opposite.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/jobs.h"
#include "base/large_pages.h"
#include "base/result.h"
#include "measure/edges.h"

namespace sgm::measure {

enum class HistogramMode {
  /// As printed: d = a2 - a1 with the given normals, v = d / (2 (pi + 1)) from -0.38 to 0.38, bin floor(v R) + 1, which
  /// is 0 or less for about half of the edges.
  printed,
  /// v = 1/2 - d / (2 pi), from 0 to 1: flat at 1/2, more where convex; bin min(floor(v R), R - 1) + 1.
  corrected,
  /// v = 1/2 - atan(L d / |e|) / pi. It is computed from the curvature d / |e| instead of the angle d, so that the
  /// histogram does not become narrower as the mesh becomes finer. A ball of radius L is at 3/4.
  curvature,
};

std::string_view nameOf(HistogramMode mode);
/// Returns the mode of that name; nullopt if no mode has it.
std::optional<HistogramMode> modeNamed(std::string_view name);

struct HistogramSettings {
  HistogramMode mode = HistogramMode::corrected;
  /// number R of bins, 1 to 4096. If R is odd, flat edges are in the middle of a bin; if R is even, they are on the
  /// border of two bins.
  uint32_t bins = 33;
  double length = 1;          ///< L of HistogramMode::curvature, in the mesh's unit; > 0 and finite
  bool unique_edges = false;  ///< true: each edge counts once; false: once per triangle, as in the paper
};

struct Histogram {
  HistogramSettings settings;
  int32_t first_bin = 1;       ///< bin number (equation 14) of shares[0]: 1; in mode `printed` it may be less
  std::vector<double> shares;  ///< share of the counted edges in each bin; their sum is 1, or 0 if no edge was counted
  uint64_t edges = 0;          ///< number of counted edges; those of triangles with a repeated corner are not counted
  uint64_t left_out = 0;       ///< edges that are not counted because their length is 0, or a normal at their ends is
                               ///< invalid
  uint64_t below_first = 0;    ///< edges whose bin number (equation 14) is 0 or less; the paper's array begins with bin
                               ///< 1
  /// Shares of the edges with |d| <= kFlatAngle (flat), d < -kFlatAngle (convex) and d > kFlatAngle (concave).
  double flat = 0, convex = 0, concave = 0;
};

/// Returns the number of shares in a histogram of these settings: `bins`, or in mode `printed` the number of bins that
/// equation 13 can reach.
size_t binsOf(const HistogramSettings& settings);

inline constexpr double kFlatAngle = 1e-4;  ///< radians

/// Checks the settings. Errors: invalid_argument if a setting is out of range.
Result<void> checkHistogram(const HistogramSettings& settings);

/// Computes the histogram of a mesh. normals: one per point of the mesh, outward, of any length above 0. edges:
/// required if unique_edges is set, otherwise null. Errors: invalid_argument if a setting is out of range. The same
/// bits for any number of threads.
Result<Histogram> histogramOf(const Triangles& mesh, std::span<const Point> normals, const Edges* edges,
                              const HistogramSettings& settings, JobSystem& jobs);

/// Computes the histogram that classify.h uses; edges at the borders of the mesh do not count. Points with equal
/// coordinates are welded; normals are computed by smoothNormals(). An edge that touches a border is excluded because
/// the border may come from cutting out a region of a world: the missing surface there would change the normals.
/// Errors: those of histogramOf.
Result<Histogram> innerHistogram(const Triangles& mesh, const HistogramSettings& settings, JobSystem& jobs);

/// Returns for each point the sum of its triangles' cross products, normalised; 0 if the sum is 0.
LargeVector<Point> smoothNormals(const Triangles& mesh);

}  // namespace sgm::measure
