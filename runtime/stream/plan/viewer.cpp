#include "stream/plan/viewer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec3.h"
#include "mesh/chunk.h"

namespace sgm {

namespace {

constexpr double kFastest = 10000.0 * kUnitsPerMetre;
constexpr int kStepsOfChunk = 8;
/// Factor on the urgency value of a chunk straight behind a viewer; chunks straight ahead have the factor 1. A larger
/// value means less urgent.
constexpr double kBehind = 3;

bool finite(const Vector3& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

double reachOf(const Viewer& viewer) {
  if (viewer.fov == 0) return viewer.weight;
  return viewer.weight * std::clamp(std::tan(kUsualFov / 2) / std::tan(viewer.fov / 2), 0.25, 8.0);
}

Vector3 ahead(const Viewer& viewer) {
  Vector3 p = viewer.position;
  for (size_t axis = 0; axis < 3; ++axis) p[axis] += viewer.velocity[axis] * kLookAhead;
  return p;
}

/// Returns the distance from the chunk's box to the viewer's path, sampled at three positions between `from` and `to`.
double distanceToWay(const Vector3& from, const Vector3& to, const ChunkKey& key, int32_t finest_cell) {
  double least = distanceToChunk(from, key, finest_cell);
  if (from == to) return least;
  const Vector3 middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2};
  for (const Vector3& place : {middle, to}) least = std::min(least, distanceToChunk(place, key, finest_cell));
  return least;
}

}  // namespace

Result<void> checkViewer(const Viewer& viewer) {
  if (!finite(viewer.position) || !finite(viewer.direction) || !finite(viewer.velocity) || !std::isfinite(viewer.fov) ||
      !std::isfinite(viewer.weight)) {
    return Error{Code::invalid_argument, "a viewer has a value that is not finite"};
  }
  constexpr double lowest = std::numeric_limits<int32_t>::min(), highest = std::numeric_limits<int32_t>::max();
  for (const double p : viewer.position) {
    if (p < lowest || p > highest) {
      return Error{Code::range, "a viewer is outside the world, which ends about 2,097 km from the origin"};
    }
  }
  if (dot(viewer.velocity, viewer.velocity) > kFastest * kFastest) {
    return Error{Code::range, "a viewer moves faster than 10,000 m/s: move it without velocity, as a teleport"};
  }
  if (viewer.weight < 0.01 || viewer.weight > 100) {
    return Error{Code::invalid_argument, "a viewer's weight is not between 0.01 and 100"};
  }
  if (viewer.fov < 0 || viewer.fov > 3) {
    return Error{Code::invalid_argument, "a viewer's field of view is not between 0 and 3 radians"};
  }
  return {};
}

std::vector<LodViewer> lodViewers(std::span<const Viewer> viewers, const LodSettings& settings) {
  const double step = static_cast<double>(kChunkCells) * settings.finest_cell / kStepsOfChunk;
  const auto inSteps = [step](Vector3 p) {
    for (double& x : p) x = std::floor(x / step + 0.5) * step;
    return p;
  };
  std::vector<LodViewer> wanting;
  for (const Viewer& viewer : viewers) {
    wanting.push_back({inSteps(viewer.position), reachOf(viewer)});
    const LodViewer soon{inSteps(ahead(viewer)), reachOf(viewer)};
    if (soon.position != wanting.back().position) wanting.push_back(soon);
  }
  return wanting;
}

SeenBy::SeenBy(const Viewer& of) : viewer(of), soon(ahead(of)), reach(reachOf(of)) {}

double urgencyFor(const ChunkKey& key, const SeenBy& seen, const LodSettings& settings, double all_around) {
  const Viewer& viewer = seen.viewer;
  const double edge = std::ldexp(static_cast<double>(kChunkCells) * settings.finest_cell, key.level);
  const double away = distanceToWay(viewer.position, seen.soon, key, settings.finest_cell);
  const double waits = away / (std::ldexp(settings.finest_distance, key.level) * seen.reach);
  const Vector3 towards{(key.at.x + 0.5) * edge - viewer.position[0], (key.at.y + 0.5) * edge - viewer.position[1],
                        (key.at.z + 0.5) * edge - viewer.position[2]};
  const double lengths = std::sqrt(dot(towards, towards) * dot(viewer.direction, viewer.direction));
  // Near the viewer, chunks behind it are as urgent as those in front, because the viewer may turn round.
  if (lengths == 0 || away <= all_around) return waits;
  return waits * (1 + (kBehind - 1) * (1 - dot(towards, viewer.direction) / lengths) / 2);
}

}  // namespace sgm
