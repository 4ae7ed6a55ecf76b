#include "asset/copies.h"

#include <limits>
#include <map>
#include <utility>

#include "asset/convex_cell.h"
#include "asset/weld_triangles.h"

namespace sgm::asset {

namespace {

class Repeater {
 public:
  Repeater(const Polyhedron& solid, int axis) : solid_(solid), axis_(axis) {}

  Result<Polyhedron> run(std::span<const Stretch> zones, size_t count) {
    constexpr double kEnd = std::numeric_limits<double>::max();
    double from = -kEnd, moved = 0;
    for (const Stretch& zone : zones) {
      part(from, zone.from, moved);
      // Triangles that lie exactly in the plane at the start or end of the zone are added once here; as a part of the
      // zone, they would be repeated.
      faceAt(zone.from, moved);
      for (size_t i = 0; i < count; ++i) {
        part(zone.from, zone.to, moved + static_cast<double>(i) * (zone.to - zone.from));
        if (triangles_.size() > kMaxCopiedTriangles)
          return Error{Code::limit, "its copies have more than " + std::to_string(kMaxCopiedTriangles) + " triangles",
                       0, 0};
      }
      moved += (static_cast<double>(count) - 1) * (zone.to - zone.from);
      faceAt(zone.to, moved);
      from = zone.to;
    }
    part(from, kEnd, moved);
    Result<WeldedTriangles> welded = weldTriangles(points_, triangles_, solid_.tolerance());
    if (!welded) return welded.error();
    for (const uint32_t source : welded->source) out_.face_of.push_back(faces_[source]);
    out_.points = std::move(welded->points);
    out_.triangles = std::move(welded->triangles);
    out_.findBox();
    return std::move(out_);
  }

 private:
  Loop loopOf(size_t triangle) const {
    const auto& t = solid_.triangles[triangle];
    return {solid_.points[t[0]], solid_.points[t[1]], solid_.points[t[2]]};
  }

  bool liesAt(const Loop& loop, double at) const {
    for (const Point& p : loop)
      if (std::fabs(p[axis_] - at) > solid_.tolerance()) return false;
    return true;
  }

  void faceAt(double at, double moved) {
    for (size_t t = 0; t < solid_.triangles.size(); ++t)
      if (const Loop loop = loopOf(t); liesAt(loop, at)) add(loop, t, moved);
  }

  void part(double from, double to, double moved) {
    Plane low, high;
    low.normal[axis_] = -1;
    low.offset = -from;
    high.normal[axis_] = 1;
    high.offset = to;
    for (size_t t = 0; t < solid_.triangles.size(); ++t) {
      Loop loop = loopOf(t);
      if (liesAt(loop, from) || liesAt(loop, to)) continue;
      loop = clippedLoop(clippedLoop(loop, low, solid_.tolerance()), high, solid_.tolerance());
      if (loop.size() >= 3) add(loop, t, moved);
    }
  }

  void add(const Loop& loop, size_t source, double moved) {
    const uint32_t first = static_cast<uint32_t>(points_.size());
    for (Point p : loop) {
      p[axis_] += moved;
      points_.push_back(p);
    }
    const uint32_t face = faceOf(solid_.face_of[source], moved);
    for (uint32_t i = 2; i < loop.size(); ++i) {
      triangles_.push_back({first, first + i - 1, first + i});
      faces_.push_back(face);
    }
  }

  uint32_t faceOf(uint32_t face, double moved) {
    Face copy = solid_.faces[face];
    const double by = copy.plane.normal[axis_] * moved;
    const auto [known, fresh] = copies_.try_emplace({face, by}, static_cast<uint32_t>(out_.faces.size()));
    copy.plane.offset += by;
    if (fresh) out_.faces.push_back(copy);
    return known->second;
  }

  const Polyhedron& solid_;
  int axis_;
  Polyhedron out_;
  std::vector<Point> points_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<uint32_t> faces_;  ///< for each triangle: index of its face in out_.faces
  std::map<std::pair<uint32_t, double>, uint32_t> copies_;
};

}  // namespace

Result<Polyhedron> repeatAlong(const Polyhedron& solid, int axis, std::span<const Stretch> zones, size_t count) {
  return Repeater(solid, axis).run(zones, count);
}

}  // namespace sgm::asset
