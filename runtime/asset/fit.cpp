#include "asset/fit.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "asset/constrained_fit.h"
#include "asset/copies.h"
#include "asset/weld_triangles.h"

namespace sgm::asset {

namespace {

constexpr double kMaxCopies = 1000;
constexpr int kBisections = 14;
constexpr char kAxes[] = "xyz";

Error refused(std::string message) { return {Code::bad_input, std::move(message), 0, 0}; }

std::string along(int axis) { return std::string(" along ") + kAxes[axis]; }

/// The zones along one axis of an asset: those that stretch, and those that are repeated.
struct AxisPlan {
  std::vector<Stretch> stretches, repeats;  ///< sorted by `from`
  double length = 0;                        ///< length of the asset along the axis, in metres

  static double sum(const std::vector<Stretch>& zones) {
    double total = 0;
    for (const Stretch& zone : zones) total += zone.to - zone.from;
    return total;
  }

  size_t leastCopies() const { return stretches.empty() || length - sum(repeats) <= 0 ? 1 : 0; }

  /// Returns the number of copies of the repeating zones for which the asset's length comes nearest to `size`.
  size_t copiesFor(double size) const {
    if (repeats.empty()) return 1;
    const double fixed = length - sum(repeats), one = sum(repeats);
    const double least = static_cast<double>(leastCopies());
    const double nearest = std::floor((size - fixed) / one + 0.5);
    return static_cast<size_t>(std::clamp(nearest, least, kMaxCopies));
  }

  /// Returns the plan of the asset after its repeating zones were removed (zero copies).
  AxisPlan without() const {
    AxisPlan out;
    out.length = length - sum(repeats);
    for (Stretch zone : stretches) {
      double gone = 0;
      for (const Stretch& repeat : repeats)
        if (repeat.to <= zone.from) gone += repeat.to - repeat.from;
      out.stretches.push_back({zone.from - gone, zone.to - gone});
    }
    return out;
  }

  /// Returns a map of positions along the axis. It stretches the asset in which each repeating zone occurs once, so
  /// that the asset has the length `size` after the zones are repeated.
  AxisMap map(double size, size_t copies) const {
    const std::vector<Stretch>& free = stretches.empty() ? repeats : stretches;
    const double count = static_cast<double>(copies);
    const double stiff = length - sum(free);
    double ratio = size / length;
    if (!stretches.empty() && !repeats.empty())
      ratio = (size - (count - 1) * sum(repeats) - stiff) / sum(free);
    else if (!free.empty())
      ratio = (size - stiff) / (sum(free) * (repeats.empty() ? 1 : count));
    AxisMap out;
    out.knots.push_back({0, 0});
    const auto go = [&](double to, double by, bool is_stiff) {
      const AxisMap::Knot last = out.knots.back();
      if (to <= last.from) return;
      out.knots.push_back({to, last.to + (to - last.from) * by});
      out.stiff.push_back(is_stiff);
    };
    for (const Stretch& zone : free) {
      go(zone.from, 1, true);
      go(zone.to, ratio, false);
    }
    go(length, free.empty() ? ratio : 1, !free.empty());
    return out;
  }
};

class Fitter {
 public:
  Fitter(const Polyhedron& asset, std::span<const FitZone> zones) : asset_(asset), zones_(zones) {
    // Move the asset so that positions count from the low end of its bounding box, as those of zones do.
    for (Point& p : asset_.points) p = p - asset.low;
    for (Face& face : asset_.faces) face.plane.offset -= dot(face.plane.normal, asset.low);
    asset_.findBox();
  }

  Result<Polyhedron> run(Point size) {
    if (Result<void> right = planAxes(); !right) return right.error();
    Copies copies = copiesFor(size);
    Result<std::optional<Polyhedron>> one = fitted(size, copies);
    if (!one) return one.error();
    for (size_t axis = 0; axis < 3 && !*one; ++axis)
      if (const Copies fewer = oneFewer(copiesFor(size), axis); fewer != copiesFor(size)) {
        copies = fewer;
        one = fitted(size, copies);
        if (!one) return one.error();
      }
    if (!*one) return refused(impossible(size));
    Polyhedron solid = std::move(**one);
    for (int axis = 0; axis < 3; ++axis) {
      const AxisPlan& plan = plans_[static_cast<size_t>(axis)];
      const size_t count = copies[static_cast<size_t>(axis)];
      if (count < 2) continue;
      const AxisMap map = plan.map(size[axis], count);
      std::vector<Stretch> moved;
      for (const Stretch& zone : plan.repeats) moved.push_back({map(zone.from), map(zone.to)});
      Result<Polyhedron> more = repeatAlong(solid, axis, moved, count);
      if (!more) return unjoined(more.error(), axis);
      solid = std::move(*more);
    }
    for (Point& p : solid.points) p = p - 0.5 * size;
    for (Face& face : solid.faces) face.plane.offset -= 0.5 * dot(face.plane.normal, size);
    solid.findBox();
    return solid;
  }

 private:
  Result<void> planAxes() {
    for (int axis = 0; axis < 3; ++axis) {
      AxisPlan& plan = plans_[static_cast<size_t>(axis)];
      plan.length = asset_.high[axis];
      std::vector<Stretch> all;
      for (const FitZone& zone : zones_) {
        if (zone.axis != axis) continue;
        Stretch part{zone.from, zone.to};
        // Zones are written to the millimetre: a zone that ends within 1 mm of the asset's end ends exactly there.
        if (std::fabs(part.to - plan.length) <= 1e-3) part.to = plan.length;
        const std::string name = "the zone " + metresText(zone.from) + "m.." + metresText(zone.to) + "m" + along(axis);
        if (!(part.from >= 0 && part.to <= plan.length && part.to - part.from >= 1e-3))
          return refused(name + " is not a part of this asset, which goes from 0m to " + metresText(plan.length) +
                         "m there");
        for (const Stretch& other : all)
          if (part.from < other.to - 1e-9 && other.from < part.to - 1e-9)
            return refused(name + " overlaps another one");
        all.push_back(part);
        (zone.repeats ? plan.repeats : plan.stretches).push_back(part);
      }
      const auto before = [](const Stretch& a, const Stretch& b) { return a.from < b.from; };
      std::sort(plan.repeats.begin(), plan.repeats.end(), before);
      std::sort(plan.stretches.begin(), plan.stretches.end(), before);
    }
    return {};
  }

  Error unjoined(const Error& error, int axis) const {
    if (error.code == Code::limit) return error;
    return refused("a repeated zone" + along(axis) + " does not join: its sections at both ends differ");
  }

  /// For each axis: the number of copies of its repeating zones.
  using Copies = std::array<size_t, 3>;

  Copies copiesFor(Point size) const {
    Copies out{};
    for (int axis = 0; axis < 3; ++axis)
      out[static_cast<size_t>(axis)] = plans_[static_cast<size_t>(axis)].copiesFor(size[axis]);
    return out;
  }

  /// Returns `copies` with one copy fewer along an axis. This is tried if the number of copies nearest to the size
  /// leaves too little length for the stretching zones.
  Copies oneFewer(Copies copies, size_t axis) const {
    if (!plans_[axis].repeats.empty() && copies[axis] > plans_[axis].leastCopies()) --copies[axis];
    return copies;
  }

  /// Returns the asset in which each repeating zone occurs once. It is resized so that it has the given size after the
  /// zones are repeated; nullopt if that is impossible.
  Result<std::optional<Polyhedron>> fitted(Point size, const Copies& copies) const {
    std::array<AxisMap, 3> maps;
    Polyhedron taken;
    const Polyhedron* from = &asset_;
    for (int axis = 0; axis < 3; ++axis) {
      const AxisPlan& plan = plans_[static_cast<size_t>(axis)];
      const size_t count = copies[static_cast<size_t>(axis)];
      maps[static_cast<size_t>(axis)] = (count == 0 ? plan.without() : plan).map(size[axis], count);
      if (count > 0) continue;
      Result<Polyhedron> less = repeatAlong(*from, axis, plan.repeats, 0);
      if (!less) return unjoined(less.error(), axis);
      taken = std::move(*less);
      from = &taken;
    }
    return fitConstrained(*from, maps);
  }

  bool possible(Point size) const {
    const Copies nearest = copiesFor(size);
    const auto fits = [&](const Copies& copies) {
      const Result<std::optional<Polyhedron>> one = fitted(size, copies);
      return one && one->has_value();
    };
    if (fits(nearest)) return true;
    for (size_t axis = 0; axis < 3; ++axis)
      if (const Copies fewer = oneFewer(nearest, axis); fewer != nearest && fits(fewer)) return true;
    return false;
  }

  std::string impossible(Point size) const {
    std::string out =
        "impossible fit: with its angles kept, and stiff where it has no zone to stretch, this asset cannot be " +
        sizeText(size);
    std::string others;
    for (int axis = 0; axis < 3; ++axis) {
      Point good = size, bad = size;
      good[axis] = asset_.high[axis];
      if (std::fabs(good[axis] - bad[axis]) < 1e-3 || !possible(good)) continue;
      for (int i = 0; i < kBisections; ++i) {
        Point middle = size;
        middle[axis] = 0.5 * (good[axis] + bad[axis]);
        (possible(middle) ? good : bad)[axis] = middle[axis];
      }
      const bool least = good[axis] > bad[axis];
      const double whole = (least ? std::ceil(good[axis] * 1000) : std::floor(good[axis] * 1000)) / 1000;
      others += std::string(others.empty() ? "" : ", or") + (least ? " at least " : " at most ") + metresText(whole) +
                "m" + along(axis);
    }
    if (!others.empty()) return out + "; it could be" + others;
    return out + "; its own size is " + sizeText(asset_.high);
  }

  static std::string sizeText(Point size) {
    return metresText(size.x) + "m x " + metresText(size.y) + "m x " + metresText(size.z) + "m";
  }

  Polyhedron asset_;
  std::span<const FitZone> zones_;
  std::array<AxisPlan, 3> plans_;
};

}  // namespace

Result<Polyhedron> fitInto(const Polyhedron& asset, Point size, std::span<const FitZone> zones) {
  return Fitter(asset, zones).run(size);
}

}  // namespace sgm::asset
