#include "region/field_agreement.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "field/reference.h"
#include "measure/area_volume.h"
#include "measure/world_triangles.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

using measure::Point;

/// Edge, in cells, of the boxes into which the vertices are sorted. Each box has its own program; the box is so small
/// that this program has few groups.
constexpr int32_t kBoxCells = 16;
constexpr double kBend = 0.25;
/// The smallest length of a gradient at which |f| / |grad f| is meaningful.
constexpr double kLeastGradient = 1e-6;

/// Returns the step for the central differences, in units. It is an eighth of a cell, but at least 16 units or half a
/// cell, whichever is less: a shorter step would suffer from the rounding of warped positions to whole units.
int32_t stepFor(int32_t cell) { return std::max(cell / 8, std::min(16, std::max(cell / 2, 1))); }

/// A vertex's exact position in units, and the nearest position in whole units.
struct Place {
  Point exact;
  Int3 whole;
};

Place placeOf(const WorldMesh& mesh, size_t vertex) {
  Place place;
  for (int axis = 0; axis < 3; ++axis) {
    place.exact[axis] = mesh.origin[axis] + kUnitsPerMetre * mesh.positions[vertex][static_cast<size_t>(axis)];
    place.whole[axis] = saturate(static_cast<int64_t>(std::floor(place.exact[axis] + 0.5)));
  }
  return place;
}

/// The field's value and gradient at a vertex.
struct Sample {
  Point gradient;  ///< change of the field's value, in units, per unit of distance
  double value = 0;
  bool bent = false, flat = false;

  bool hasNormal() const { return !bent && !flat; }
};

Sample sampleAt(const ProgramView& field, const Place& place, int32_t step) {
  Sample sample;
  const double middle = referenceField(field, place.whole);
  double bends = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Int3 low = place.whole, high = place.whole;
    low[axis] = saturate(int64_t{low[axis]} - step);
    high[axis] = saturate(int64_t{high[axis]} + step);
    const double before = referenceField(field, low), behind = referenceField(field, high);
    sample.gradient[axis] = (behind - before) / (2.0 * step);
    const double bend = (behind - 2 * middle + before) / step;
    bends += bend * bend;
  }
  // The field was evaluated at the position rounded to whole units. Adds, to first order, the change of the field from
  // there to the vertex. The distance is less than a unit, so curvature is negligible.
  sample.value = middle + dot(sample.gradient,
                              place.exact - Point{double(place.whole.x), double(place.whole.y), double(place.whole.z)});
  const double size = length(sample.gradient);
  sample.flat = !(size > kLeastGradient);
  sample.bent = std::sqrt(bends) > kBend * size;
  return sample;
}

/// One box, and the range of its vertices in an array that is sorted by box.
struct Box {
  Int3 number;
  size_t begin = 0, end = 0;
};

Result<std::vector<Sample>> samplesOf(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level,
                                      int32_t step) {
  const int64_t edge = int64_t{kBoxCells} * world.cellAt(level);
  std::vector<std::pair<Int3, uint32_t>> order(mesh.positions.size());
  for (uint32_t v = 0; v < order.size(); ++v) {
    const Int3 at = placeOf(mesh, v).whole;
    Int3 number;
    for (int axis = 0; axis < 3; ++axis) number[axis] = static_cast<int32_t>(floorDiv(at[axis], edge));
    order[v] = {number, v};
  }
  std::sort(order.begin(), order.end());
  std::vector<Box> boxes;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) boxes.push_back({order[i].first, i, i});
    boxes.back().end = i + 1;
  }

  std::vector<Sample> samples(order.size());
  std::mutex mutex;
  std::optional<std::pair<size_t, Error>> failed;
  parallelFor(jobs, boxes.size(), [&](size_t b) {
    IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = saturate(boxes[b].number[axis] * edge);
      box.hi[axis] = saturate((boxes[b].number[axis] + 1) * edge);
    }
    const Result<std::shared_ptr<const FieldProgram>> field = world.compile(box.grown(step), level);
    if (!field) {
      // If several boxes fail, keeps the error of the first box, so that the result does not depend on the speed of
      // threads.
      const std::lock_guard lock(mutex);
      if (!failed || b < failed->first) failed.emplace(b, field.error());
      return;
    }
    for (size_t i = boxes[b].begin; i < boxes[b].end; ++i) {
      samples[order[i].second] = sampleAt((*field)->view(), placeOf(mesh, order[i].second), step);
    }
  });
  if (failed) return failed->second;
  return samples;
}

/// Returns the quantile of a set of values: the smallest value v such that at least this share of the values is <= v.
/// sorted: the values, ascending. 0 if there is no value.
double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<size_t>(rank, 1, sorted.size()) - 1];
}

double meanOf(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

class AngleCounter {
 public:
  /// Adds the angle between a normal and a gradient. Precondition: neither has length 0.
  void add(Point normal, Point gradient) {
    const double along = dot(normal, gradient);
    inward_ += !(along > 0);
    angles_.push_back(std::atan2(length(cross(normal, gradient)), along) * 180 / std::numbers::pi);
  }
  NormalAngles result() {
    std::sort(angles_.begin(), angles_.end());
    return {angles_.size(), inward_, quantile(angles_, 0.5), quantile(angles_, 0.99), quantile(angles_, 1)};
  }

 private:
  std::vector<double> angles_;
  uint64_t inward_ = 0;
};

}  // namespace

Result<FieldAgreement> fieldAgreement(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level) {
  FieldAgreement result;
  result.step = stepFor(world.cellAt(level));
  result.vertices = mesh.positions.size();
  const Result<std::vector<Sample>> sampled = samplesOf(world, jobs, mesh, level, result.step);
  if (!sampled) return sampled.error();
  const std::vector<Sample>& samples = *sampled;

  AngleCounter normals, faces;
  std::vector<double> residuals, offsets;
  residuals.reserve(samples.size());
  for (size_t v = 0; v < samples.size(); ++v) {
    const VertexAttributes& packed = mesh.attributes[v];
    const Point normal = measure::pointOf(unpackNormal(packed.normal_x, packed.normal_y));
    residuals.push_back(std::fabs(samples[v].value));
    if (residuals.back() > result.residual_max) {
      result.residual_max = residuals.back();
      result.farthest = mesh.positions[v];
    }
    if (samples[v].hasNormal()) {
      normals.add(normal, samples[v].gradient);
      offsets.push_back(residuals.back() / length(samples[v].gradient));
    } else if (samples[v].flat) {
      ++result.flat;
    } else {
      ++result.bent;
      result.bent_inward += !(dot(normal, samples[v].gradient) > 0);
    }
  }
  result.residual_mean = meanOf(residuals);
  result.offset_mean = meanOf(offsets);
  std::sort(residuals.begin(), residuals.end());
  std::sort(offsets.begin(), offsets.end());
  result.residual_p99 = quantile(residuals, 0.99);
  result.offset_p99 = quantile(offsets, 0.99);
  result.offset_max = quantile(offsets, 1);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](size_t k) { return measure::pointOf(mesh.positions[mesh.indices[i + k]]); };
    const Point normal = measure::crossOf(corner(0), corner(1), corner(2));
    if (!(length(normal) > 0)) continue;
    for (size_t k = 0; k < 3; ++k) {
      const Sample& sample = samples[mesh.indices[i + k]];
      if (sample.hasNormal()) faces.add(normal, sample.gradient);
    }
  }
  result.normals = normals.result();
  result.faces = faces.result();
  return result;
}

}  // namespace sgm
