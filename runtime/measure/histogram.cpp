#include "measure/histogram.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "measure/area_volume.h"
#include "measure/weld_points.h"

namespace sgm::measure {
namespace {

constexpr double kPi = std::numbers::pi;
/// The largest |v| that equation 13 of the paper gives.
constexpr double kPrintedReach = kPi / (2 * (kPi + 1));

struct Bend {
  double angle = 0, edge = 0;  ///< angle: the angle d of histogram.h, in radians; edge: |e|, the length of the mesh's
                               ///< edge
};

/// Returns the angle and length of the edge from v1 to v2 with the normals n1 and n2 at its ends; nullopt if the edge
/// has no length, or a normal is invalid.
std::optional<Bend> bendOf(Point v1, Point v2, Point n1, Point n2) {
  const Point e = v2 - v1;
  const double edge = length(e), l1 = length(n1), l2 = length(n2);
  if (!(edge > 0 && l1 > 0 && l2 > 0) || !std::isfinite(edge) || !std::isfinite(l1) || !std::isfinite(l2)) return {};
  const auto angle = [&](Point n, double l) { return std::acos(std::clamp(dot(e, n) / (edge * l), -1.0, 1.0)); };
  return Bend{angle(n2, l2) - angle(n1, l1), edge};
}

/// Returns v by equation 13 of the paper in mode `printed`, otherwise by the formulas in histogram.h.
double valueOf(const Bend& bend, const HistogramSettings& settings) {
  switch (settings.mode) {
    case HistogramMode::printed:
      return bend.angle / (2 * (kPi + 1));
    case HistogramMode::corrected:
      return 0.5 - bend.angle / (2 * kPi);
    case HistogramMode::curvature:
      return 0.5 - std::atan(settings.length * bend.angle / bend.edge) / kPi;
  }
  return 0;
}

struct Counts {
  std::vector<uint64_t> bins;
  uint64_t left_out = 0, flat = 0, convex = 0, concave = 0;
};

}  // namespace

std::string_view nameOf(HistogramMode mode) {
  switch (mode) {
    case HistogramMode::printed:
      return "printed";
    case HistogramMode::corrected:
      return "corrected";
    case HistogramMode::curvature:
      return "curvature";
  }
  return "";
}

std::optional<HistogramMode> modeNamed(std::string_view name) {
  for (const HistogramMode mode : {HistogramMode::printed, HistogramMode::corrected, HistogramMode::curvature}) {
    if (nameOf(mode) == name) return mode;
  }
  return std::nullopt;
}

size_t binsOf(const HistogramSettings& settings) {
  if (settings.mode != HistogramMode::printed) return settings.bins;
  const double reach = kPrintedReach * settings.bins;
  return static_cast<size_t>(std::floor(reach) - std::floor(-reach)) + 1;
}

Result<void> checkHistogram(const HistogramSettings& settings) {
  if (settings.bins < 1 || settings.bins > 4096) {
    return Error{Code::invalid_argument,
                 "a histogram has 1 to 4096 bins, not " + std::to_string(settings.bins) + ": an odd number is best"};
  }
  if (!(settings.length > 0) || !std::isfinite(settings.length)) {
    return Error{Code::invalid_argument, "the length that curvature is scaled by must be more than 0"};
  }
  return {};
}

Result<Histogram> histogramOf(const Triangles& mesh, std::span<const Point> normals, const Edges* edges,
                              const HistogramSettings& settings, JobSystem& jobs) {
  if (Result<void> ok = checkHistogram(settings); !ok) return ok.error();
  if (normals.size() != mesh.points.size() || (settings.unique_edges && !edges)) {
    return Error{Code::invalid_argument, "a histogram needs a normal for each point, and edges to count each once"};
  }
  const bool printed = settings.mode == HistogramMode::printed;
  const auto bins = static_cast<double>(settings.bins);
  Histogram result;
  result.settings = settings;
  result.first_bin = printed ? static_cast<int32_t>(std::floor(-kPrintedReach * bins)) + 1 : 1;
  const size_t slots = binsOf(settings);
  const int32_t last_bin = result.first_bin + static_cast<int32_t>(slots) - 1;

  const size_t halves = settings.unique_edges ? edges->count() : 3 * mesh.triangles.size();
  const size_t blocks = (halves + kBlock - 1) / kBlock;
  std::vector<Counts> counts(blocks);
  parallelFor(jobs, blocks, [&](size_t block) {
    Counts& c = counts[block];
    c.bins.resize(slots);
    for (size_t i = block * kBlock; i < std::min(halves, (block + 1) * kBlock); ++i) {
      const HalfEdge half = settings.unique_edges ? edges->around(i)[0] : static_cast<HalfEdge>(i);
      const Triangle& t = mesh.triangles[half / 3];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      const uint32_t a = beginOf(mesh.triangles, half), b = endOf(mesh.triangles, half);
      const std::optional<Bend> bend = bendOf(mesh.points[a], mesh.points[b], normals[a], normals[b]);
      if (!bend) {
        ++c.left_out;
        continue;
      }
      c.flat += std::fabs(bend->angle) <= kFlatAngle;
      c.convex += bend->angle < -kFlatAngle;
      c.concave += bend->angle > kFlatAngle;
      // Equation 14 of the paper. If the value v is 1, the upper end of its range, the equation gives bin R + 1; the
      // clamp puts this edge into the last bin, R.
      const auto bin = static_cast<int32_t>(std::floor(valueOf(*bend, settings) * bins)) + 1;
      ++c.bins[static_cast<size_t>(std::clamp(bin, result.first_bin, last_bin) - result.first_bin)];
    }
  });
  std::vector<uint64_t> sums(slots);
  uint64_t flat = 0, convex = 0, concave = 0;
  for (const Counts& c : counts) {
    for (size_t i = 0; i < slots; ++i) sums[i] += c.bins[i];
    result.left_out += c.left_out;
    flat += c.flat;
    convex += c.convex;
    concave += c.concave;
  }
  result.edges = flat + convex + concave;
  const double each = result.edges > 0 ? 1 / static_cast<double>(result.edges) : 0;
  result.shares.resize(slots);
  for (size_t i = 0; i < slots; ++i) {
    result.shares[i] = static_cast<double>(sums[i]) * each;
    if (result.first_bin + static_cast<int32_t>(i) <= 0) result.below_first += sums[i];
  }
  result.flat = static_cast<double>(flat) * each;
  result.convex = static_cast<double>(convex) * each;
  result.concave = static_cast<double>(concave) * each;
  return result;
}

Result<Histogram> innerHistogram(const Triangles& mesh, const HistogramSettings& settings, JobSystem& jobs) {
  const WeldedPoints welded = weldPoints(mesh);
  const Triangles clean{welded.points, welded.triangles, mesh.memory};
  const Edges edges(clean);
  LargeVector<Point> normals = smoothNormals(clean);
  for (size_t i = 0; i < edges.count(); ++i) {
    const std::span<const HalfEdge> around = edges.around(i);
    if (around.size() > 1) continue;
    normals[beginOf(clean.triangles, around[0])] = {};
    normals[endOf(clean.triangles, around[0])] = {};
  }
  return histogramOf(clean, normals, &edges, settings, jobs);
}

LargeVector<Point> smoothNormals(const Triangles& mesh) {
  LargeVector<Point> normals(mesh.points.size(), mesh.memory);
  for (const Triangle& t : mesh.triangles) {
    const Point cross = crossOf(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    for (const uint32_t v : t) normals[v] = normals[v] + cross;
  }
  for (Point& n : normals) n = normalised(n);
  return normals;
}

}  // namespace sgm::measure
