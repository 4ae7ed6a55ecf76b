#pragma once
// Common code of the queries: checks of arguments, positions that keep their precision far from the origin, and
// evaluation of points in groups.

#include <cmath>
#include <string>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "base/vec3.h"
#include "field/prune.h"
#include "mesh/vertex.h"
#include "query/queries.h"

namespace sgm {

/// A position as whole units plus a fraction from 0 to 1. Thereby sums with offsets are rounded in the same way
/// everywhere in the world.
struct SplitPosition {
  Int3 base;
  Vector3 rest{};

  /// Returns this position plus an offset, rounded to whole units. Precondition: the result lies in the world.
  Int3 at(const Vector3& offset) const {
    Int3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      p[axis] = saturate(base[axis] + static_cast<int64_t>(std::floor(rest[a] + offset[a] + 0.5)));
    }
    return p;
  }
  Vector3 position(const Vector3& offset) const {
    return {base.x + (rest[0] + offset[0]), base.y + (rest[1] + offset[1]), base.z + (rest[2] + offset[2])};
  }
  /// Returns the vector from this position to a position in whole units.
  Vector3 to(const Int3& p) const {
    return {static_cast<double>(int64_t{p.x} - base.x) - rest[0], static_cast<double>(int64_t{p.y} - base.y) - rest[1],
            static_cast<double>(int64_t{p.z} - base.z) - rest[2]};
  }
};

/// Splits a position. Errors: invalid_argument if it is not finite; range if it lies outside of the world.
inline Result<SplitPosition> splitPosition(const Vector3& position) {
  SplitPosition split;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = position[static_cast<size_t>(axis)];
    if (!std::isfinite(p)) return Error{Code::invalid_argument, "the position is not finite"};
    if (p < -2147483648.0 || p > 2147483647.0) {
      return Error{Code::range, "the position lies outside of the world, which ends about 2,097 km from the origin"};
    }
    split.base[axis] = static_cast<int32_t>(std::floor(p));
    split.rest[static_cast<size_t>(axis)] = p - std::floor(p);
  }
  return split;
}

/// Checks a length. Errors: invalid_argument if it is negative or NaN; limit if it is more than `most`. name: the
/// length's name in the error message.
inline Result<void> checkLength(double length, int64_t most, const char* name) {
  if (!(length >= 0)) return Error{Code::invalid_argument, std::string(name) + " is not a number of at least 0"};
  if (length > static_cast<double>(most)) {
    return Error{Code::limit, std::string(name) + " is more than " + std::to_string(most) +
                                  " units, the maximum at this cell size; split the query"};
  }
  return {};
}

/// A list of points that are evaluated together. Not thread-safe.
class QuerySampler {
 public:
  explicit QuerySampler(std::pmr::memory_resource* memory)
      : pruning(memory), scratch_(memory), x_(memory), y_(memory), z_(memory), q_(memory) {}

  void clear() {
    x_.clear();
    y_.clear();
    z_.clear();
  }
  void add(const Int3& p) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
  /// Returns the quantised samples at the points, in the order of the points.
  const std::pmr::vector<int32_t>& samples(const ProgramView& view) {
    q_.resize(x_.size());
    bestKernels().samples(view, {x_.data(), y_.data(), z_.data(), x_.size()}, scratch_, q_.data());
    return q_;
  }
  bool solid(const ProgramView& view, const Int3& p) {
    clear();
    add(p);
    return samples(view)[0] < 0;
  }
  /// Returns the surface attributes (normal, material, tag) at a place.
  SurfacePoint surface(const ProgramView& view, const Int3& p) {
    int16_t nx = 0, ny = 0;
    uint32_t label = 0;
    Attributes attributes;
    attributes.normal_x = &nx;
    attributes.normal_y = &ny;
    attributes.label = &label;
    bestKernels().attributes(view, {&p.x, &p.y, &p.z, 1}, scratch_, attributes);
    SurfacePoint point;
    point.normal = unpackNormal(nx, ny);
    point.material = static_cast<uint16_t>(label & 0xFFFFu);
    point.tag = static_cast<uint16_t>(label >> 16);
    return point;
  }

  PruneScratch pruning;

 private:
  EvalScratch scratch_;
  std::pmr::vector<int32_t> x_, y_, z_, q_;
};

inline IntBox boxAround(const Int3& a, const Int3& b) { return IntBox{a, a}.joined({b, b}); }

}  // namespace sgm
