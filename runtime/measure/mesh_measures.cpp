#include "measure/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "measure/triangle_pair.h"
#include "measure/weld_points.h"

namespace sgm::measure {
namespace {

bool measurable(Point p) {
  return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest && std::fabs(p.z) <= kFarthest;
}

/// Counts the triangles with a corner that cannot be measured (NaN, or beyond kFarthest). Returns all other triangles
/// if there are any such triangles; otherwise an empty vector, since the mesh can be used as it is.
LargeVector<Triangle> finiteOf(const Triangles& mesh, MeshMeasures& result) {
  LargeVector<uint8_t> used(mesh.points.size(), mesh.memory);
  const auto good = [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return measurable(mesh.points[v]); });
  };
  for (const Triangle& t : mesh.triangles) {
    for (const uint32_t v : t) used[v] = true;
    if (good(t)) continue;
    if (!result.first_non_finite) result.first_non_finite = static_cast<uint32_t>(&t - mesh.triangles.data());
    ++result.non_finite;
  }
  result.unused_points = static_cast<size_t>(std::count(used.begin(), used.end(), uint8_t{0}));
  LargeVector<Triangle> kept(mesh.memory);
  if (result.non_finite > 0) std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(kept), good);
  return kept;
}

/// Converts triangle numbers in the result. If finiteOf() has excluded triangles, the result numbers only the remaining
/// ones; afterwards it has their numbers in `mesh`.
void numberAsGiven(const Triangles& mesh, MeshMeasures& result) {
  LargeVector<uint32_t> given(mesh.memory);
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (std::all_of(t.begin(), t.end(), [&](uint32_t v) { return measurable(mesh.points[v]); })) given.push_back(i);
  }
  for (Shell& shell : result.parts.shells) shell.first = given[shell.first];
  LargeVector<uint32_t> shells(mesh.triangles.size(), kNoShell, mesh.memory);
  for (size_t i = 0; i < given.size(); ++i) shells[given[i]] = result.parts.of_triangle[i];
  result.parts.of_triangle = std::move(shells);
  for (DefectPlace& place : result.places) place.triangle = given[place.triangle];
  if (!result.self_intersections) return;
  for (auto* examples : {&result.self_intersections->examples, &result.self_intersections->folded_examples}) {
    for (auto& [a, b] : *examples) {
      a = given[a];
      b = given[b];
    }
  }
}

double qualityOf(Point a, Point b, Point c) {
  const double squares = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
  return squares > 0 ? 2 * std::sqrt(3.0) * length(crossOf(a, b, c)) / squares : 0;
}

void countShapes(const Triangles& mesh, JobSystem& jobs, MeshMeasures& result) {
  struct ShapeCounts {
    size_t flat = 0, slivers = 0;
  };
  const size_t count = mesh.triangles.size();
  std::vector<ShapeCounts> counts((count + kBlock - 1) / kBlock);
  parallelFor(jobs, counts.size(), [&](size_t block) {
    for (size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      const Triangle& t = mesh.triangles[i];
      const double quality = qualityOf(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
      counts[block].slivers += quality < kSliver;
      // isFlat() is exact and slow, so only triangles that are nearly flat are tested.
      counts[block].flat += quality < 1e-6 && !hasCornerTwice(t) && isFlat(mesh.points, t);
    }
  });
  for (const ShapeCounts& c : counts) {
    result.flat_triangles += c.flat;
    result.slivers += c.slivers;
  }
}

}  // namespace

int64_t MeshMeasures::euler() const {
  int64_t sum = 0;
  for (const Shell& shell : parts.shells) sum += shell.euler();
  return sum;
}

std::optional<uint64_t> MeshMeasures::genus() const {
  uint64_t sum = 0;
  for (const Shell& shell : parts.shells) {
    const std::optional<uint64_t> genus = shell.genus();
    if (!genus) return std::nullopt;
    sum += *genus;
  }
  return sum;
}

bool MeshMeasures::valid() const { return watertight() && validButForCut(); }

bool MeshMeasures::validButForCut() const {
  return identity.manifold() && identity.open_edges == cut_edges && non_finite == 0 && flat_triangles == 0 &&
         !overlaps() && complete();
}

bool MeshMeasures::complete() const {
  return nesting.not_judged == 0 && (!self_intersections || self_intersections->complete);
}

Result<MeshMeasures> measureMesh(const Triangles& mesh, const MeshSettings& settings, JobSystem& jobs) {
  if (mesh.triangles.size() > kNoShell / 3 || mesh.points.size() > kNoShell) {
    return Error{
        Code::limit,
        "a mesh of more than 1,431,655,765 triangles or 4,294,967,295 points cannot be measured: cut it into parts"};
  }
  if (Result<void> ok = checkHistogram(settings.histogram); !ok) return ok.error();
  MeshMeasures result;
  result.points = mesh.points.size();
  result.triangles = mesh.triangles.size();
  LargeVector<Triangle> kept = finiteOf(mesh, result);
  const std::span<const Triangle> all_finite = result.non_finite > 0 ? std::span<const Triangle>(kept) : mesh.triangles;
  const WeldedPoints welded = weldPoints({mesh.points, all_finite, mesh.memory}, settings.weld);
  kept = LargeVector<Triangle>(mesh.memory);
  result.welded_points = welded.merged;
  const Triangles clean{welded.points, welded.triangles, mesh.memory};
  result.sums = areaVolume(clean, jobs);

  if (settings.cubes) {
    const Result<CubeVolumes> cubes = cubeVolumes(clean, result.sums.low, result.sums.high, *settings.cubes);
    if (!cubes) return cubes.error();
    result.cubes = *cubes;
  }

  const Bvh tree(clean, jobs);
  const uint64_t steps = settings.steps_a_triangle * (clean.triangles.size() + 1);
  std::optional<Edges> edges;
  std::optional<Error> failed;
  // The three jobs write to disjoint data, so they may run concurrently.
  const std::array<std::function<void()>, 3> works{
      [&] {
        if (!settings.self_intersections) return;
        result.self_intersections = selfIntersections(clean, tree, steps, jobs, settings.progress);
      },
      [&] {
        edges.emplace(clean);
        result.parts = shellsOf(clean, *edges, result.sums.centre);
        const Result<Histogram> histogram = histogramOf(clean, smoothNormals(clean), &*edges, settings.histogram, jobs);
        if (histogram) {
          result.histogram = *histogram;
        } else {
          failed = histogram.error();
        }
        result.nesting = nestingOf(clean, tree, result.parts, settings.cut.has_value(), steps, jobs);
        countShapes(clean, jobs, result);
      },
      [&] {
        const uint32_t* corners = clean.triangles.empty() ? nullptr : clean.triangles.front().data();
        result.identity = checkTriangles({corners, 3 * clean.triangles.size()}, clean.points.size(), mesh.memory);
      }};
  parallelFor(jobs, works.size(), [&](size_t work) { works[work](); });
  if (failed) return *failed;
  const Cut* const cut = settings.cut ? &*settings.cut : nullptr;
  if (cut != nullptr && result.identity.open_edges > 0) result.cut_edges = cutEdges(clean, *edges, *cut);
  if (!result.validButForCut()) {
    const SelfIntersections* const crossing = result.self_intersections ? &*result.self_intersections : nullptr;
    result.places = defectPlaces(clean, *edges, result.parts, result.nesting, crossing, cut);
  }
  if (result.non_finite > 0) numberAsGiven(mesh, result);
  return result;
}

}  // namespace sgm::measure
