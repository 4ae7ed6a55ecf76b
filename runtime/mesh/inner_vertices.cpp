#include "mesh/inner_vertices.h"

#include <array>
#include <cmath>
#include <vector>

namespace sgm {
namespace {

constexpr uint32_t kNone = SharpLoops::kNone;

/// Returns the distance of the point `other.point` from the plane `plane`.
double offPlane(const Tangent& plane, const Tangent& other) {
  return std::fabs(dot(plane.normal, between(plane.point, other.point)) - plane.distance);
}

class InnerVertices {
 public:
  InnerVertices(const Creases& creases, const FieldSampler& field, SharpLoops& sharp, std::pmr::memory_resource* memory)
      : creases_(creases), field_(field), sharp_(sharp), ideals_(memory), choices_(memory), memory_(memory) {}

  void place() {
    findIdeals();
    for (uint32_t s = 0; s < sharp_.sides.size(); ++s) {
      const SharpSide& side = sharp_.sides[s];
      if (side.at_border) continue;
      const Tangent &a = creases_.tangent(side.from), &b = creases_.tangent(side.to);
      choose(s, a, b, Creases::nearestOnCrease(a, b, side.corner, meanOnCrease(s)));
      choose(s, a, b, ideals_[s]);
    }
    takeFirstOnSurface();
    chooseCutOff();
    takeFirstOnSurface();
  }

 private:
  struct Choice {
    uint32_t side;
    Int3 place, point;
    FieldSample sample;
  };

  /// Computes the ideal position of each loop side's face vertex, without regard to the other face vertices.
  void findIdeals() {
    ideals_.reserve(sharp_.sides.size());
    for (const SharpSide& side : sharp_.sides) {
      if (side.at_border && !side.places.empty()) {
        Vector3 sum{};
        for (const Int3& place : side.places.all()) sum = plus(sum, unitsOf(place, sharp_.body.grid().cell));
        ideals_.push_back(times(sum, 1.0 / static_cast<double>(side.places.count())));
      } else {
        ideals_.push_back(nearestOnCrease(creases_.tangent(side.from), creases_.tangent(side.to), side));
      }
    }
  }

  /// Returns the point on the crease of two planes that is nearest to the middle of a side, in units from the side's
  /// corner.
  Vector3 nearestOnCrease(const Tangent& a, const Tangent& b, const SharpSide& side) const {
    const Vector3 from = between(side.corner, creases_.tangent(side.from).point);
    const Vector3 to = between(side.corner, creases_.tangent(side.to).point);
    return Creases::nearestOnCrease(a, b, side.corner, times(plus(from, to), 0.5));
  }

  /// Returns the point nearest to the tangent planes of a loop's vertices, where several creases meet; in units from
  /// `corner`.
  Vector3 meetingPoint(const SharpLoop& sharp, const Int3& corner) const {
    const SurfaceLoop& loop = sharp_.of(sharp);
    Vector3 middle{};
    double count = 0;
    for (const uint32_t s : sharp.sides) {
      if (s == kNone) continue;
      middle = plus(middle, plus(between(corner, sharp_.sides[s].corner), ideals_[s]));
      count += 1;
    }
    middle = times(middle, 1 / count);
    PlaneSum planes;
    for (uint32_t i = 0; i < loop.count; ++i) {
      const Tangent& t = creases_.tangent(loop.vertices[i]);
      planes.add(t.normal, t.distance + dot(t.normal, minus(between(corner, t.point), middle)));
    }
    return plus(middle, PlaneAxes(planes).step(3));
  }

  /// Follows the crease of the loop side `own` within `loop`, one of the two loops that share this side. Returns the
  /// next point on the crease: the ideal point of the loop's next side on that crease or, if there is none, the point
  /// where the crease ends. In units from the corner of `own`.
  Vector3 nextOnCrease(uint32_t own, uint32_t loop) const {
    const SharpSide& side = sharp_.sides[own];
    const auto idealOf = [&](uint32_t other) {
      return plus(between(side.corner, sharp_.sides[other].corner), ideals_[other]);
    };
    uint32_t last = kNone, others = 0, along = kNone, others_along = 0;
    for (const uint32_t other : sharp_.loops[loop].sides) {
      if (other == kNone || other == own) continue;
      last = other;
      ++others;
      const Tangent &a = creases_.tangent(side.from), &b = creases_.tangent(side.to);
      if (!creases_.isOnCrease(a, b, side.corner, idealOf(other))) continue;
      along = other;
      ++others_along;
    }
    // If the loop has no other sharp side, the ideal point of `own` counts once more, so that two sides do not get the
    // same mean.
    if (others == 0) return ideals_[own];
    if (others == 1) return idealOf(last);
    // The loop has several other sharp sides. If exactly one of them has its ideal point on the crease of `own`, that
    // point is the next one. Otherwise the crease may end inside the cell, at the point where it meets the loop's other
    // creases.
    return others_along == 1 ? idealOf(along) : meetingPoint(sharp_.loops[loop], side.corner);
  }

  /// Returns the weighted mean of three points on the crease of a loop side: its own ideal point (weight two) and the
  /// next point in each of the two loops that share the side.
  Vector3 meanOnCrease(uint32_t own) const {
    Vector3 sum = times(ideals_[own], 2);
    for (const uint32_t loop : sharp_.sides[own].loops)
      sum = plus(sum, loop == kNone ? ideals_[own] : nextOnCrease(own, loop));
    return times(sum, 0.25);
  }

  void choose(uint32_t s, const Tangent& a, const Tangent& b, const Vector3& on_crease) {
    const SharpSide& side = sharp_.sides[s];
    if (const std::optional<Int3> place = creases_.onGridAlong(a, b, side.corner, on_crease, side.axis))
      choices_.push_back({s, *place, creases_.sampledAt(side.corner, *place), {}});
  }

  void takeFirstOnSurface() {
    std::pmr::vector<Int3> points(memory_);
    for (const Choice& choice : choices_) points.push_back(choice.point);
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    if (!points.empty()) field_(points, samples, Sampled::all);
    for (size_t i = 0; i < choices_.size(); ++i) {
      choices_[i].sample = samples[i];
      SharpSide& side = sharp_.sides[choices_[i].side];
      if (side.places.empty() && creases_.isOnSurface(samples[i])) side.places = FacePlaces(choices_[i].place);
    }
  }

  /// For loop sides that have no position yet, replaces their candidates by new ones. All candidates of such a side are
  /// off the surface, because a third plane cuts off the crease between the tangent planes at the side's ends.
  void chooseCutOff() {
    const std::pmr::vector<Choice> tried = std::move(choices_);
    choices_.clear();
    for (size_t i = 0; i < tried.size(); ++i) {
      SharpSide& side = sharp_.sides[tried[i].side];
      const bool is_last = i + 1 == tried.size() || tried[i + 1].side != tried[i].side;
      if (!side.places.empty() || !is_last) continue;
      const Tangent &a = creases_.tangent(side.from), &b = creases_.tangent(side.to);
      const Tangent& third = side.third.emplace(tangentAt(tried[i].point, tried[i].sample));
      // First tries the end of the side that is farther from the third plane. An end in the third plane lies on a
      // crease between this plane and another one, so its normal may belong to either of them.
      std::array<const Tangent*, 2> ends{&a, &b};
      if (offPlane(third, a) < offPlane(third, b)) std::swap(ends[0], ends[1]);
      for (const Tangent* end : ends) choose(tried[i].side, *end, third, nearestOnCrease(*end, third, side));
    }
  }

  const Creases& creases_;
  const FieldSampler& field_;
  SharpLoops& sharp_;
  std::pmr::vector<Vector3> ideals_;  ///< ideal position for each loop side, in units from the side's corner
  std::pmr::vector<Choice> choices_;  ///< candidate positions, grouped by loop side; best first within a side
  std::pmr::memory_resource* memory_;
};

}  // namespace

void placeInnerVertices(const Creases& creases, const FieldSampler& field, SharpLoops& sharp,
                        std::pmr::memory_resource* memory) {
  InnerVertices(creases, field, sharp, memory).place();
}

}  // namespace sgm
