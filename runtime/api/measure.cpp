#include <cmath>
#include <cstring>
#include <limits>

#include "api/barrier.h"
#include "api/runtime.h"
#include "base/large_pages.h"
#include "measure/mesh_measures.h"

using namespace sgm::api;

namespace {

using sgm::LargeVector;
using sgm::measure::MeshMeasures;
using sgm::measure::Point;
using sgm::measure::Triangle;

constexpr uint64_t kMost = std::numeric_limits<uint32_t>::max();
constexpr uint32_t kFlags = SGM_MEASURE_UNIQUE_EDGES | SGM_MEASURE_NO_SELF_INTERSECTIONS;

sgm_result checkMeasure(const sgm_measure_desc& desc, sgm_error* error) {
  const auto wrong = [error](const std::string& what) { return fail(error, SGM_ERR_INVALID_ARGUMENT, what); };
  if (desc.position_count > kMost) return wrong("desc.position_count is more than 2^32 - 1");
  if (desc.index_count > kMost || desc.index_count % 3 != 0)
    return wrong("desc.index_count is not a multiple of 3 or is above 2^32 - 1");
  if ((desc.positions != nullptr && desc.positions_double != nullptr) ||
      (desc.position_count > 0 && desc.positions == nullptr && desc.positions_double == nullptr))
    return wrong("exactly one of desc.positions and desc.positions_double must be given");
  const uint64_t number = desc.positions_double != nullptr ? sizeof(double) : sizeof(float);
  if (desc.position_stride != 0 && (desc.position_stride < 3 * number || desc.position_stride % number != 0))
    return wrong("desc.position_stride is below the size of three coordinates or not a multiple of the size of one");
  if (desc.position_stride > SIZE_MAX / (desc.position_count + 1)) return wrong("desc.position_stride is too large");
  if (desc.index_count > 0 && desc.indices == nullptr) return nullArgument(error, "desc.indices");
  if (!(desc.weld >= 0) || !std::isfinite(desc.weld)) return wrong("desc.weld is not a finite number of at least 0");
  if (!(desc.cubes >= 0) || !std::isfinite(desc.cubes)) return wrong("desc.cubes is not a finite number of at least 0");
  if (desc.histogram_mode < SGM_HISTOGRAM_CORRECTED || desc.histogram_mode > SGM_HISTOGRAM_CURVATURE)
    return wrong("desc.histogram_mode is not a valid sgm_histogram_mode");
  if ((desc.flags & ~kFlags) != 0) return wrong("desc.flags has unknown bits: pass 0 or values of sgm_measure_flag");
  if (desc.histogram == nullptr && desc.histogram_capacity > 0) return nullArgument(error, "desc.histogram");
  return SGM_OK;
}

template <class Number>
void readPoints(const Number* first, uint64_t stride, LargeVector<Point>& points) {
  const auto* at = reinterpret_cast<const std::byte*>(first);
  for (Point& p : points) {
    Number v[3];
    std::memcpy(v, at, sizeof v);
    p = {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    at += stride != 0 ? stride : sizeof v;
  }
}

sgm::measure::HistogramMode modeOf(int32_t mode) {
  switch (mode) {
    case SGM_HISTOGRAM_PRINTED:
      return sgm::measure::HistogramMode::printed;
    case SGM_HISTOGRAM_CURVATURE:
      return sgm::measure::HistogramMode::curvature;
    default:
      return sgm::measure::HistogramMode::corrected;
  }
}

void fill(sgm_measures& out, const MeshMeasures& m) {
  out.watertight = m.watertight();
  out.valid = m.valid();
  out.triangles = m.triangles;
  out.points = m.points;
  out.welded_points = m.welded_points;
  out.non_finite_triangles = m.non_finite;
  out.area = m.sums.area;
  out.volume = m.sums.volume;
  for (int axis = 0; axis < 3; ++axis) {
    out.area_vector[axis] = m.sums.area_vector[axis];
    out.bounds_min[axis] = m.sums.low[axis];
    out.bounds_max[axis] = m.sums.high[axis];
  }
  out.objects = m.parts.objects;
  out.shells = m.parts.shells.size();
  out.euler = m.euler();
  const std::optional<uint64_t> genus = m.genus();
  out.genus = genus ? static_cast<int64_t>(*genus) : -1;
  out.edges = m.identity.edges;
  out.open_edges = m.identity.open_edges;
  out.turned_edges = m.identity.unmatched_edges - m.identity.open_edges;
  out.nonmanifold_edges = m.identity.non_manifold_edges;
  out.nonmanifold_vertices = m.identity.pinched_vertices;
  out.degenerate_triangles = m.identity.degenerate_triangles;
  out.flat_triangles = m.flat_triangles;
  out.duplicate_triangles = m.identity.duplicate_triangles;
  out.sliver_triangles = m.slivers;
  out.inside_out_shells = m.nesting.inside_out;
  out.cavity_shells = m.nesting.cavities;
  out.nested_shells = m.nesting.nested;
  out.folded_triangles = m.self_intersections ? m.self_intersections->folded : 0;
  out.self_intersections = m.self_intersections ? m.self_intersections->cuts() : 0;
  out.self_intersections_complete = m.self_intersections && m.self_intersections->complete;
  out.histogram_first = m.histogram.first_bin;
  out.histogram_bins = m.histogram.shares.size();
  out.histogram_edges = m.histogram.edges;
  out.histogram_left_out = m.histogram.left_out;
  out.flat = m.histogram.flat;
  out.convex = m.histogram.convex;
  out.concave = m.histogram.concave;
  out.cubes_all = m.cubes ? m.cubes->volumeOf(m.cubes->all) : 0;
  out.cubes_any = m.cubes ? m.cubes->volumeOf(m.cubes->any) : 0;
  out.cubes_centre = m.cubes ? m.cubes->volumeOf(m.cubes->centre) : 0;
}

}  // namespace

sgm_result sgm_measure(sgm_runtime* runtime, const sgm_measure_desc* desc, sgm_measures* out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (sgm_result r = checkDesc(error, out, "out"); r != SGM_OK) return r;
    if (sgm_result r = checkMeasure(*desc, error); r != SGM_OK) return r;

    LargeVector<Triangle> triangles(desc->index_count / 3, &runtime->memory);
    for (uint64_t i = 0; i < desc->index_count; ++i) {
      if (desc->indices[i] >= desc->position_count)
        return fail(error, SGM_ERR_INVALID_ARGUMENT,
                    "desc.indices[" + std::to_string(i) + "] is " + std::to_string(desc->indices[i]) +
                        ", but there are " + std::to_string(desc->position_count) + " points");
      triangles[i / 3][i % 3] = desc->indices[i];
    }
    LargeVector<Point> points(desc->position_count, &runtime->memory);
    if (desc->positions_double != nullptr) {
      readPoints(desc->positions_double, desc->position_stride, points);
    } else if (desc->positions != nullptr) {
      readPoints(desc->positions, desc->position_stride, points);
    }
    sgm::measure::MeshSettings settings;
    settings.weld = desc->weld;
    if (desc->cubes > 0) settings.cubes = desc->cubes;
    settings.histogram = {modeOf(desc->histogram_mode), desc->histogram_bins, desc->curvature_length,
                          (desc->flags & SGM_MEASURE_UNIQUE_EDGES) != 0};
    settings.self_intersections = (desc->flags & SGM_MEASURE_NO_SELF_INTERSECTIONS) == 0;
    const sgm::Result<MeshMeasures> measures =
        sgm::measure::measureMesh({points, triangles, &runtime->memory}, settings, *runtime->jobs);
    if (!measures) return fail(error, measures.error());
    fill(*out, *measures);
    const std::vector<double>& shares = measures->histogram.shares;
    const size_t fit = std::min<size_t>(shares.size(), desc->histogram_capacity);
    if (fit > 0) std::memcpy(desc->histogram, shares.data(), fit * sizeof(double));
    return desc->histogram != nullptr && fit < shares.size() ? SGM_INCOMPLETE : SGM_OK;
  });
}
