#pragma once
// The path of the viewer: it starts at an anchor of the grammar, and continues in directions with free space. All
// queries are answered by the field, so that no chunk need be meshed.

#include <sgm/sgm.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "../embed/handles.h"
#include "view_point.h"

class CavePath {
 public:
  /// Plans a path of `length` metres. Throws if the grammar has no anchor near the origin, or no way continues.
  CavePath(sgm_field* field, double length) : field_(field) {
    points_.push_back(firstPlace());
    Place heading{1, 0, 0};
    for (double planned = 0; planned < length + kAhead;) {
      const auto [way, free] = longestWay(points_.back(), heading);
      if (free < kStep) throw std::runtime_error("there is no way on through the void");
      points_.push_back(along(points_.back(), way, free));
      heading = way;
      planned += free;
    }
  }

  /// The view after s metres of the path, in the direction of the path ahead.
  ViewPoint at(double s) const {
    ViewPoint view{placeAt(s), {}};
    const Place ahead = placeAt(s + kAhead);
    double length = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      view.forward[axis] = ahead[axis] - view.at[axis];
      length += view.forward[axis] * view.forward[axis];
    }
    for (double& component : view.forward) component /= std::sqrt(length);
    return view;
  }

 private:
  // In metres: step of the search and minimum free length, space needed around the camera, length of rays, and distance
  // of the place ahead that the camera looks at.
  static constexpr double kStep = 1, kRoom = 1.1, kFarthest = 48, kAhead = 4;
  static constexpr int kHeadings = 24;

  static Place along(const Place& from, const Place& way, double distance) {
    Place place{};
    for (size_t axis = 0; axis < 3; ++axis) place[axis] = from[axis] + distance * way[axis];
    return place;
  }
  static double lengthOf(const Place& from, const Place& to) {
    return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }

  Place firstPlace() const {
    constexpr int32_t kAround = 400 * SGM_UNITS_PER_METRE;
    const int32_t low[3] = {-kAround, -kAround, -kAround}, high[3] = {kAround, kAround, kAround};
    sgm_anchor anchor{};
    size_t count = 1;
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_field_anchors(field_, low, high, &anchor, 0, &count, &error), error);
    if (count == 0) throw std::runtime_error("the grammar names no place near the origin to fly from");
    Place place{};
    for (size_t axis = 0; axis < 3; ++axis) place[axis] = anchor.position[axis] / double{SGM_UNITS_PER_METRE};
    return place;
  }

  /// Length in metres of the free space from a place in a direction, up to kFarthest.
  double freeWay(const Place& from, const Place& way) const {
    sgm_ray_desc ray = SGM_RAY_DESC_INIT;
    for (size_t axis = 0; axis < 3; ++axis) {
      ray.from[axis] = from[axis] * SGM_UNITS_PER_METRE;
      ray.direction[axis] = way[axis];
    }
    ray.length = kFarthest;
    sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_field_ray_cast(field_, &ray, &hit, &error), error);
    return hit.found != 0 ? hit.distance : kFarthest;
  }

  /// Whether a camera fits at a place: no surface may be nearer than its near plane.
  bool hasRoom(const Place& place) const {
    sgm_closest_desc closest = SGM_CLOSEST_DESC_INIT;
    for (size_t axis = 0; axis < 3; ++axis) closest.position[axis] = place[axis] * SGM_UNITS_PER_METRE;
    closest.max_distance = kRoom;
    sgm_surface_point point = SGM_SURFACE_POINT_INIT;
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_field_closest_point(field_, &closest, &point, &error), error);
    return point.found == 0 && point.inside == 0;
  }

  struct Way {
    Place direction{};
    double free = 0;
  };
  /// Returns the direction with the most free space, among those directions that do not turn back and along which the
  /// camera fits.
  Way longestWay(const Place& from, const Place& heading) const {
    std::vector<Way> ways;
    for (const double slope : {-0.4, 0.0, 0.4}) {
      for (int i = 0; i < kHeadings; ++i) {
        const double angle = 2 * 3.141592653589793 * i / kHeadings, level = std::sqrt(1 - slope * slope);
        const Place way{level * std::cos(angle), slope, level * std::sin(angle)};
        if (way[0] * heading[0] + way[1] * heading[1] + way[2] * heading[2] < -0.2) continue;
        ways.push_back({way, freeWay(from, way)});
      }
    }
    std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.free > b.free; });
    Way best;
    for (const Way& way : ways) {
      if (way.free <= best.free) break;
      double free = 0;
      while (free + kStep < way.free && hasRoom(along(from, way.direction, free + kStep))) free += kStep;
      if (free > best.free) best = {way.direction, free};
    }
    return best;
  }

  Place placeAt(double s) const {
    for (size_t i = 1; i < points_.size(); ++i) {
      const double length = lengthOf(points_[i - 1], points_[i]);
      if (s <= length) {
        const double part = s / length;
        Place place{};
        for (size_t axis = 0; axis < 3; ++axis) {
          place[axis] = points_[i - 1][axis] + part * (points_[i][axis] - points_[i - 1][axis]);
        }
        return place;
      }
      s -= length;
    }
    return points_.back();
  }

  sgm_field* field_;
  std::vector<Place> points_;
};
