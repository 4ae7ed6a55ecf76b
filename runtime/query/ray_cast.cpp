#include <algorithm>
#include <limits>

#include "query/query_sampler.h"

namespace sgm {

namespace {

// The ray is divided into pieces, and a program is compiled for each piece. Length of a piece: the larger of these two
// lengths.
constexpr int64_t kPieceUnits = 64 * kUnitsPerMetre, kPieceCells = 128;
constexpr int64_t kMaxPieces = 64;
// length of a piece in cells, if the world has host fields, which each program has to sample
constexpr int64_t kSampledPieceCells = 32;
// number of samples whose evaluation costs as much as another attempt to prove a stretch of the ray empty
constexpr int64_t kLeafSteps = 48;
// distance in units from the end of the world at which the ray ends, so that rounded positions stay inside
constexpr double kInWorld = 1.0;

/// One ray, as a row of positions at distances of `step_`. The last position is the end of the ray, so the last
/// distance may be shorter.
class RayWalk {
 public:
  RayWalk(const QueryField& field, const SplitPosition& from, const Vector3& direction, double length)
      : field_(field),
        from_(from),
        direction_(direction),
        length_(length),
        step_(std::max(1.0, field.finest_cell / 16.0)),
        sampler_(field.memory) {}

  Result<std::optional<SurfacePoint>> run() {
    const auto last = static_cast<int64_t>(std::ceil(length_ / step_));
    const int64_t units =
        field_.sampled ? kSampledPieceCells * field_.finest_cell : longestRay(field_.finest_cell) / kMaxPieces;
    const auto piece = static_cast<int64_t>(static_cast<double>(units) / step_);
    for (int64_t first = 0; first <= last; first += piece) {
      const int64_t end = std::min(last, first + piece - 1);
      Result<std::shared_ptr<const FieldProgram>> program = field_.at(stretch(first, end));
      if (!program) return program.error();
      if (const std::optional<int64_t> hit = firstSolid((*program)->view(), first, end, 0)) return surfaceAt(*hit);
    }
    return std::optional<SurfacePoint>{};
  }

 private:
  double along(int64_t i) const { return std::min(static_cast<double>(i) * step_, length_); }
  Int3 pointAt(double t) const { return from_.at(times(direction_, t)); }
  /// Rounding is monotonic on each axis, so the box around the two ends contains all rounded positions between them.
  IntBox stretch(int64_t first, int64_t last) const { return boxAround(pointAt(along(first)), pointAt(along(last))); }

  /// Returns the first of the steps first..last whose position is solid; nullopt if none is.
  std::optional<int64_t> firstSolid(const ProgramView& view, int64_t first, int64_t last, size_t depth) {
    while (pruned_.size() <= depth) pruned_.push_back(std::make_unique<PrunedProgram>(field_.memory));
    PrunedProgram& here = *pruned_[depth];
    prune(view, stretch(first, last), sampler_.pruning, here);
    if (here.empty()) return std::nullopt;
    if (here.solid()) return first;
    if (last - first >= kLeafSteps) {
      const int64_t middle = first + (last - first) / 2;
      const std::optional<int64_t> hit = firstSolid(here.view(), first, middle, depth + 1);
      return hit ? hit : firstSolid(here.view(), middle + 1, last, depth + 1);
    }
    sampler_.clear();
    for (int64_t i = first; i <= last; ++i) sampler_.add(pointAt(along(i)));
    const std::pmr::vector<int32_t>& q = sampler_.samples(here.view());
    const auto hit = std::find_if(q.begin(), q.end(), [](int32_t v) { return v < 0; });
    if (hit == q.end()) return std::nullopt;
    return first + (hit - q.begin());
  }

  /// Bisects between the first solid step and the step before it, to half a unit. Uses only quantised samples, so that
  /// every machine gets the same result.
  Result<std::optional<SurfacePoint>> surfaceAt(int64_t step) {
    double open = step == 0 ? 0 : along(step - 1), closed = along(step);
    Result<std::shared_ptr<const FieldProgram>> program = field_.at(boxAround(pointAt(open), pointAt(closed)));
    if (!program) return program.error();
    const ProgramView view = (*program)->view();
    while (closed - open > 0.5) {
      const double middle = open + (closed - open) / 2;
      (sampler_.solid(view, pointAt(middle)) ? closed : open) = middle;
    }
    SurfacePoint hit = sampler_.surface(view, pointAt(closed));
    hit.inside = step == 0;
    hit.distance = open;
    hit.position = from_.position(times(direction_, open));
    return std::optional<SurfacePoint>(hit);
  }

  const QueryField& field_;
  const SplitPosition from_;
  const Vector3 direction_;
  const double length_, step_;
  QuerySampler sampler_;
  std::vector<std::unique_ptr<PrunedProgram>> pruned_;  ///< pruned program for each depth of the recursion
};

/// Returns the length of that part of the ray that lies within the world.
double lengthInWorld(const SplitPosition& from, const Vector3& direction, double length) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const int64_t base = from.base[static_cast<int>(axis)];
    const double room = direction[axis] > 0 ? static_cast<double>(INT64_C(2147483647) - base) - from.rest[axis]
                                            : static_cast<double>(base + INT64_C(2147483648)) + from.rest[axis];
    const double speed = std::fabs(direction[axis]);
    if (speed * length > room - kInWorld) length = std::min(length, std::max(0.0, room - kInWorld) / speed);
  }
  return length;
}

}  // namespace

int64_t longestRay(int32_t finest_cell) { return kMaxPieces * std::max(kPieceUnits, kPieceCells * finest_cell); }

Result<std::optional<SurfacePoint>> rayCast(const QueryField& field, const Vector3& from, const Vector3& direction,
                                            double length) {
  const Result<SplitPosition> start = splitPosition(from);
  if (!start) return start.error();
  double largest = 0;
  for (double d : direction) {
    if (!std::isfinite(d)) return Error{Code::invalid_argument, "the direction is not finite"};
    largest = std::max(largest, std::fabs(d));
  }
  if (largest == 0) return Error{Code::invalid_argument, "the direction has no length"};
  if (const Result<void> ok = checkLength(length, longestRay(field.finest_cell), "the ray's length"); !ok)
    return ok.error();
  // The direction is scaled first, because squares of very large or very small numbers leave the range of a double.
  Vector3 unit{direction[0] / largest, direction[1] / largest, direction[2] / largest};
  const double size = std::sqrt(dot(unit, unit));
  unit = {unit[0] / size, unit[1] / size, unit[2] / size};
  return RayWalk(field, *start, unit, lengthInWorld(*start, unit, length)).run();
}

}  // namespace sgm
