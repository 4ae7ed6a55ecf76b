#include "measure/hausdorff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

#include "measure/area_volume.h"
#include "measure/nearest.h"

namespace sgm::measure {
namespace {

constexpr uint32_t kMaxCuts = 64;
// Sizes of one job. They are fixed, so that results do not depend on the number of threads. They are small, because one
// search may visit much of the other surface if all of it is about equally far away.
constexpr size_t kSampledTogether = 128;  // number of triangles, or points, per job
constexpr size_t kRefinedTogether = 64;   // number of parts per job

using Part = std::array<Point, 3>;

Point middleOf(const Part& part) { return (1.0 / 3) * (part[0] + part[1] + part[2]); }

/// Returns part `number` of the cuts^2 equal parts of a triangle, counted row by row from the side between its first
/// and third corners.
Part partOf(const Part& whole, uint32_t cuts, uint32_t number) {
  const auto at = [&](uint32_t i, uint32_t j) {
    const double u = static_cast<double>(i) / cuts, v = static_cast<double>(j) / cuts;
    return whole[0] + u * (whole[1] - whole[0]) + v * (whole[2] - whole[0]);
  };
  uint32_t i = 0;
  while (number >= 2 * (cuts - i) - 1) number -= 2 * (cuts - i++) - 1;
  const uint32_t j = number / 2;
  if (number % 2 == 0) return {at(i, j), at(i + 1, j), at(i, j + 1)};
  return {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
}

/// Measures distances from points to the surface `to`.
class Distances {
 public:
  Distances(const Triangles& to, JobSystem& jobs) : to_(to), tree_(to, jobs) {}

  Nearest from(Point place, uint32_t guess) const { return nearestOf(to_, tree_, place, guess); }

  /// Returns an upper bound of the distance for all points of a part, given the triangle nearest to its middle. At any
  /// other point of the part, the distance is larger by at most that point's distance from the middle.
  double atMost(const Part& part, const Nearest& of_middle) const {
    const Point middle = middleOf(part);
    double reach = 0;
    for (const Point corner : part) reach = std::max(reach, length(corner - middle));
    return std::min(of_middle.distance + reach, atMost(part, of_middle.triangle));
  }

  /// Returns an upper bound of the distance for all points of a part, given any triangle of the other surface: the
  /// distance to that triangle is convex, and so largest at a corner of the part.
  double atMost(const Part& part, uint32_t triangle) const {
    const Triangle& t = to_.triangles[triangle];
    const Part corners{to_.points[t[0]], to_.points[t[1]], to_.points[t[2]]};
    double farthest = 0;
    for (const Point corner : part) farthest = std::max(farthest, length(nearestOn(corners, corner) - corner));
    return farthest;
  }

 private:
  const Triangles& to_;
  Bvh tree_;
};

/// The result of one job: the farthest point, and the sums for the mean and the root mean square.
struct Found {
  double at_least = -1;
  Point farthest;
  double area = 0, sum = 0, squares = 0;

  void offer(double distance, Point place) {
    if (distance <= at_least) return;
    at_least = distance;
    farthest = place;
  }
};

/// A part that may contain the point farthest from the other surface.
struct Candidate {
  double at_most = 0;
  Part part;
  uint32_t triangle = 0;  ///< the triangle nearest to the part's middle

  friend bool operator<(const Candidate& a, const Candidate& b) { return a.at_most < b.at_most; }
};

/// A quarter of a candidate. The candidate's nearest triangle gives a first bound for the quarter. Unless this bound is
/// low enough, the triangle nearest to the quarter's middle is searched.
struct Quarter {
  Candidate rest;
  double distance = -1;  ///< distance of its middle; -1 if it was not searched
};

/// Splits the parts with the highest bounds, several at a time, until the bounds are within the
/// tolerance; returns the highest bound.
double refine(const Distances& distances, std::vector<Candidate> candidates, const HausdorffSettings& settings,
              JobSystem& jobs, Found& found) {
  std::priority_queue<Candidate> open({}, std::move(candidates));
  double settled = found.at_least;  // highest bound among the parts that will not be split any more
  uint64_t left = settings.refinements;
  std::vector<Candidate> cut;
  std::vector<std::array<Quarter, 4>> quarters(kRefinedTogether);
  for (;;) {
    const double enough = found.at_least + settings.tolerance;
    cut.clear();
    for (; cut.size() < kRefinedTogether && left > 0 && !open.empty() && open.top().at_most > enough; --left) {
      cut.push_back(open.top());
      open.pop();
    }
    if (cut.empty()) break;
    parallelFor(jobs, cut.size(), [&](size_t i) {
      for (uint32_t k = 0; k < 4; ++k) {
        const Part part = partOf(cut[i].part, 2, k);
        Quarter& quarter = quarters[i][k];
        quarter = {{std::min(cut[i].at_most, distances.atMost(part, cut[i].triangle)), part, cut[i].triangle}};
        if (quarter.rest.at_most <= enough) continue;
        const Nearest nearest = distances.from(middleOf(part), cut[i].triangle);
        quarter.distance = nearest.distance;
        quarter.rest.triangle = nearest.triangle;
        quarter.rest.at_most = std::min(quarter.rest.at_most, distances.atMost(part, nearest));
      }
    });
    for (size_t i = 0; i < cut.size(); ++i) {
      for (const Quarter& quarter : quarters[i]) {
        found.offer(quarter.distance, middleOf(quarter.rest.part));
        if (quarter.rest.at_most > found.at_least + settings.tolerance) {
          open.push(quarter.rest);
        } else {
          settled = std::max(settled, quarter.rest.at_most);
        }
      }
    }
  }
  if (!open.empty()) settled = std::max(settled, open.top().at_most);
  return std::max(settled, found.at_least);
}

Error wrong(const char* message) { return {Code::invalid_argument, message}; }

}  // namespace

Result<OneSided> distanceFrom(const Triangles& from, const Triangles& to, const HausdorffSettings& settings,
                              JobSystem& jobs) {
  if (settings.cuts < 1 || settings.cuts > kMaxCuts) return wrong("the cuts along an edge must be 1 to 64");
  if (!(settings.tolerance >= 0)) return wrong("the tolerance is not a number of 0 or more");
  OneSided result;
  if (from.triangles.empty()) return result;
  if (to.triangles.empty()) return wrong("a mesh without triangles has no distance");

  const Distances distances(to, jobs);
  const size_t count = from.triangles.size();
  const uint32_t parts = settings.cuts * settings.cuts;
  const auto wholeOf = [&](size_t i) {
    const Triangle& t = from.triangles[i];
    return Part{from.points[t[0]], from.points[t[1]], from.points[t[2]]};
  };
  std::vector<Found> blocks((count + kSampledTogether - 1) / kSampledTogether);
  LargeVector<double> bounds(count * parts, from.memory);
  LargeVector<uint32_t> nearest_to(count * parts, from.memory);
  parallelFor(jobs, blocks.size(), [&](size_t block) {
    Found& found = blocks[block];
    uint32_t guess = 0;
    for (size_t i = block * kSampledTogether; i < std::min(count, (block + 1) * kSampledTogether); ++i) {
      const Part whole = wholeOf(i);
      const double area = 0.5 / parts * length(crossOf(whole[0], whole[1], whole[2]));
      for (uint32_t k = 0; k < parts; ++k) {
        const Part part = partOf(whole, settings.cuts, k);
        const Nearest nearest = distances.from(middleOf(part), guess);
        guess = nearest.triangle;
        found.offer(nearest.distance, middleOf(part));
        found.area += area;
        found.sum += area * nearest.distance;
        found.squares += area * nearest.distance * nearest.distance;
        bounds[i * parts + k] = distances.atMost(part, nearest);
        nearest_to[i * parts + k] = nearest.triangle;
      }
    }
  });

  LargeVector<uint8_t> used(from.points.size(), from.memory);
  for (const Triangle& t : from.triangles)
    for (const uint32_t v : t) used[v] = true;
  const size_t points = from.points.size();
  std::vector<Found> of_points((points + kSampledTogether - 1) / kSampledTogether);
  parallelFor(jobs, of_points.size(), [&](size_t block) {
    uint32_t guess = 0;
    for (size_t v = block * kSampledTogether; v < std::min(points, (block + 1) * kSampledTogether); ++v) {
      if (!used[v]) continue;
      const Nearest nearest = distances.from(from.points[v], guess);
      guess = nearest.triangle;
      of_points[block].offer(nearest.distance, from.points[v]);
    }
  });

  Found all;
  for (const std::vector<Found>& some : {blocks, of_points}) {
    for (const Found& found : some) {
      all.offer(found.at_least, found.farthest);
      all.area += found.area;
      all.sum += found.sum;
      all.squares += found.squares;
    }
  }
  std::vector<Candidate> candidates;
  for (size_t i = 0; i < bounds.size(); ++i) {
    if (bounds[i] <= all.at_least) continue;
    candidates.push_back(
        {bounds[i], partOf(wholeOf(i / parts), settings.cuts, static_cast<uint32_t>(i % parts)), nearest_to[i]});
  }
  result.samples = count * parts + static_cast<uint64_t>(std::count(used.begin(), used.end(), uint8_t{1}));
  result.at_most = refine(distances, std::move(candidates), settings, jobs, all);
  result.at_least = all.at_least;
  result.farthest = all.farthest;
  result.mean = all.area > 0 ? all.sum / all.area : 0;
  result.rms = all.area > 0 ? std::sqrt(all.squares / all.area) : 0;
  return result;
}

Result<Hausdorff> hausdorff(const Triangles& first, const Triangles& second, const HausdorffSettings& settings,
                            JobSystem& jobs) {
  const Result<OneSided> there = distanceFrom(first, second, settings, jobs);
  if (!there) return there.error();
  const Result<OneSided> back = distanceFrom(second, first, settings, jobs);
  if (!back) return back.error();
  return Hausdorff{*there, *back};
}

}  // namespace sgm::measure
