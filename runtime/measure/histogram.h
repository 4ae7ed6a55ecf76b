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
  /// is not positive about half of the time.
  printed,
  /// v = 1/2 - d / (2 pi), from 0 to 1: flat at 1/2, more where convex; bin min(floor(v R), R - 1) + 1.
  corrected,
  /// v = 1/2 - atan(L d / |e|) / pi: uses the curvature d / |e| instead of the angle, so that it does not narrow as the
  /// mesh becomes finer. A ball of radius L is at 3/4.
  curvature,
};

std::string_view nameOf(HistogramMode mode);
/// The mode of that name; nullopt if there is none.
std::optional<HistogramMode> modeNamed(std::string_view name);

struct HistogramSettings {
  HistogramMode mode = HistogramMode::corrected;
  /// R. With an odd number, flat edges are in the middle of a bin; with an even one, on the border of two. 1..4096
  uint32_t bins = 33;
  double length = 1;          ///< L of HistogramMode::curvature, in the mesh's unit; > 0 and finite
  bool unique_edges = false;  ///< each edge once; otherwise once per triangle, as in the paper
};

struct Histogram {
  HistogramSettings settings;
  int32_t first_bin = 1;       ///< the number of shares[0], by equation 14: 1, or less in mode `printed`
  std::vector<double> shares;  ///< of the counted edges; they add up to 1, or are all 0 if no edge was counted
  uint64_t edges = 0;          ///< counted; those of triangles with a repeated corner are not
  uint64_t left_out = 0;       ///< without length, or with an invalid normal
  uint64_t below_first = 0;    ///< in bins numbered 0 or less, before the array described in the paper
  /// Shares of edges with |d| at most kFlatAngle, and with d below and above it.
  double flat = 0, convex = 0, concave = 0;
};

/// The number of shares in a histogram of these settings: `bins`, or in mode `printed` the bins that equation 13
/// reaches.
size_t binsOf(const HistogramSettings& settings);

inline constexpr double kFlatAngle = 1e-4;  ///< radians

/// Errors: invalid_argument for settings out of range.
Result<void> checkHistogram(const HistogramSettings& settings);

/// normals: one per point, of any length above 0, outward. triangles: their corners index points and normals alike.
/// edges: required if unique_edges is set; null otherwise. Errors: invalid_argument for settings out of range. The same
/// bits for any number of threads.
Result<Histogram> histogramOf(const Triangles& mesh, std::span<const Point> normals, const Edges* edges,
                              const HistogramSettings& settings, JobSystem& jobs);

/// The histogram without borders, which classify.h uses: points with equal coordinates are welded, normals are
/// smoothNormals(), and edges that touch a border are left out, because a region of a world is cut off there, and the
/// missing surface would change the normal. Errors: those of histogramOf.
Result<Histogram> innerHistogram(const Triangles& mesh, const HistogramSettings& settings, JobSystem& jobs);

/// At each point the sum of its triangles' cross products, normalised; zero if the sum is zero.
LargeVector<Point> smoothNormals(const Triangles& mesh);

}  // namespace sgm::measure
