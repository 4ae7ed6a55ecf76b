#pragma once
// The paper's histogram of dihedral angles at the edges of a surface (section 7.4, equations 9 to 14).
//
// An edge e from V1 to V2 with unit normals n1, n2 at its ends has a1 = acos(e . n1 / |e|), a2 = acos(e . n2 / |e|) and
// d = a2 - a1: with outward normals d < 0 if the surface is convex, contrary to the paper.

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
  /// v = 1/2 - atan(L d / |e|) / pi: uses the curvature d / |e| instead of the angle, so that it does not narrow as the
  /// mesh becomes finer. A ball of radius L is at 3/4.
  curvature,
};

std::string_view nameOf(HistogramMode mode);
/// Returns the mode of that name; nullopt if no mode has it.
std::optional<HistogramMode> modeNamed(std::string_view name);

struct HistogramSettings {
  HistogramMode mode = HistogramMode::corrected;
  /// R, 1..4096. If it is odd, flat edges are in the middle of a bin; if it is even, on the border of two bins.
  uint32_t bins = 33;
  double length = 1;          ///< L of HistogramMode::curvature, in the mesh's unit; > 0 and finite
  bool unique_edges = false;  ///< true: each edge counts once; false: once per triangle, as in the paper
};

struct Histogram {
  HistogramSettings settings;
  int32_t first_bin = 1;       ///< the number, by equation 14, of the bin of shares[0]: 1, or less in mode `printed`
  std::vector<double> shares;  ///< share of the counted edges in each bin; their sum is 1, or 0 if no edge was counted
  uint64_t edges = 0;          ///< number of counted edges; those of triangles with a repeated corner are not counted
  uint64_t left_out = 0;       ///< edges excluded because they have no length, or a normal is invalid
  uint64_t below_first = 0;    ///< edges in bins numbered 0 or less, which the paper's array does not have
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

/// Computes the histogram that classify.h uses, without the borders of the mesh. Points with equal coordinates are
/// welded, and normals are smoothNormals(). Edges that touch a border are left out: a region of a world is cut off
/// there, and the missing surface would change the normals. Errors: those of histogramOf.
Result<Histogram> innerHistogram(const Triangles& mesh, const HistogramSettings& settings, JobSystem& jobs);

/// Returns for each point the sum of its triangles' cross products, normalised; 0 if the sum is 0.
LargeVector<Point> smoothNormals(const Triangles& mesh);

}  // namespace sgm::measure
