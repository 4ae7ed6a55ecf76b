#include "asset/constrained_fit.h"

#include <algorithm>
#include <utility>

#include "asset/least_squares_solver.h"

namespace sgm::asset {

namespace {

constexpr double kShortest = 0.01;  ///< minimum length of a fitted edge, relative to its original length
constexpr double kParallel = 1e-4;  ///< minimum determinant of three face normals that determine a corner
/// Weight of the corners' target positions, relative to the weight of the edge lengths. It is small, so it decides only
/// where no other constraint does.
constexpr double kPlaceWeight = 1e-4;

/// A vertex of the polyhedron, whose displacement is a linear function of its faces' displacements along their normals.
struct Corner {
  std::vector<uint32_t> faces;   ///< indices of all faces that meet in the corner
  std::array<uint32_t, 3> by{};  ///< three of `faces`, whose planes determine the corner's position
  std::array<Point, 3> moves{};  ///< displacement of the corner per unit displacement of each face in `by`
  bool sharp = false;            ///< true if three of `faces` determine the position
};

class FaceMover {
 public:
  FaceMover(const Polyhedron& solid, const std::array<AxisMap, 3>& maps)
      : solid_(solid), maps_(maps), edge_(solid.longestEdge()), tolerance_(solid.tolerance()) {}

  std::optional<Polyhedron> run() {
    for (const AxisMap& map : maps_)
      if (!map.rises()) return std::nullopt;
    for (const Point& p : solid_.points) wanted_.push_back({maps_[0](p.x), maps_[1](p.y), maps_[2](p.z)});
    if (std::optional<Polyhedron> straight = byMaps()) return straight;
    findCorners();
    findEdges();
    return bySolving();
  }

 private:
  /// Applies the maps to every point, which keeps the normals of axis-aligned faces. Returns nullopt if the normal of
  /// another face would change.
  std::optional<Polyhedron> byMaps() const {
    Polyhedron out = solid_;
    out.points = wanted_;
    std::vector<bool> known(out.faces.size(), false);
    for (size_t t = 0; t < out.triangles.size(); ++t)
      for (const uint32_t corner : out.triangles[t]) {
        const uint32_t f = out.face_of[t];
        // In the file itself, a corner may lie off its face's plane by up to the tolerance. Subtract this original
        // distance, so that it does not count as a displacement by the maps.
        const double was = solid_.faces[f].plane.distance(solid_.points[corner]);
        const double offset = dot(out.faces[f].plane.normal, out.points[corner]) - was;
        if (known[f] && std::fabs(out.faces[f].plane.offset - offset) > 4 * tolerance_) return std::nullopt;
        if (!known[f]) out.faces[f].plane.offset = offset;
        known[f] = true;
      }
    out.findBox();
    return out;
  }

  void findCorners() {
    corners_.resize(solid_.points.size());
    for (size_t t = 0; t < solid_.triangles.size(); ++t)
      for (const uint32_t corner : solid_.triangles[t]) {
        std::vector<uint32_t>& faces = corners_[corner].faces;
        if (std::find(faces.begin(), faces.end(), solid_.face_of[t]) == faces.end()) faces.push_back(solid_.face_of[t]);
      }
    for (Corner& corner : corners_) {
      std::sort(corner.faces.begin(), corner.faces.end());
      findBasis(corner);
    }
  }

  Point normalOf(uint32_t face) const { return solid_.faces[face].plane.normal; }

  void findBasis(Corner& corner) const {
    double most = kParallel;
    const auto& f = corner.faces;
    for (size_t i = 0; i < f.size(); ++i)
      for (size_t j = i + 1; j < f.size(); ++j)
        for (size_t k = j + 1; k < f.size(); ++k) {
          const double volume = dot(normalOf(f[i]), cross(normalOf(f[j]), normalOf(f[k])));
          if (std::fabs(volume) <= most) continue;
          most = std::fabs(volume);
          corner.sharp = true;
          corner.by = {f[i], f[j], f[k]};
          const double inverse = 1 / volume;
          corner.moves = {inverse * cross(normalOf(f[j]), normalOf(f[k])),
                          inverse * cross(normalOf(f[k]), normalOf(f[i])),
                          inverse * cross(normalOf(f[i]), normalOf(f[j]))};
        }
  }

  /// Returns how far a corner moves along a direction, as a linear function of the displacements of the faces.
  LinearForm moveOf(uint32_t corner, Point direction, double times = 1) const {
    LinearForm form;
    for (size_t m = 0; m < 3; ++m)
      form.emplace_back(corners_[corner].by[m], times * dot(corners_[corner].moves[m], direction));
    return form;
  }

  /// Finds the straight edges between two faces; each edge joins two sharp corners and may pass through other vertices.
  void findEdges() {
    using Half = std::pair<std::pair<uint32_t, uint32_t>, uint32_t>;
    std::vector<Half> halves;
    for (size_t t = 0; t < solid_.triangles.size(); ++t)
      for (size_t k = 0; k < 3; ++k)
        halves.push_back({{solid_.triangles[t][k], solid_.triangles[t][(k + 1) % 3]}, solid_.face_of[t]});
    std::sort(halves.begin(), halves.end());
    // The half-edges at the borders between faces. Key: start corner and face; value: end corner. Sorted by key.
    std::vector<std::pair<std::pair<uint32_t, uint32_t>, uint32_t>> next;
    for (const Half& half : halves) {
      const auto& [ends, face] = half;
      const std::pair back{ends.second, ends.first};
      bool border = false;
      for (auto other = std::lower_bound(halves.begin(), halves.end(), Half{back, 0});
           other != halves.end() && other->first == back; ++other)
        border = border || other->second != face;
      if (border) next.push_back({{ends.first, face}, ends.second});
    }
    std::sort(next.begin(), next.end());
    for (const auto& [from, to] : next) {
      const auto& [a, face] = from;
      if (!corners_[a].sharp) continue;
      const Point along = normalised(solid_.points[to] - solid_.points[a]);
      uint32_t b = to;
      for (size_t steps = 0; !corners_[b].sharp && steps < next.size(); ++steps) {
        const auto on = std::lower_bound(next.begin(), next.end(), std::pair{std::pair{b, face}, 0u});
        if (on == next.end() || on->first != std::pair{b, face}) break;
        b = on->second;
      }
      // The edge is in the lists of both adjacent faces, in opposite directions. Add it only once, in the direction
      // with a < b.
      if (corners_[b].sharp && a < b && dot(normalised(solid_.points[b] - solid_.points[a]), along) > 0.999)
        edges_.emplace_back(a, b);
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }

  std::optional<Polyhedron> bySolving() const {
    LeastSquares system(solid_.faces.size());
    for (uint32_t c = 0; c < corners_.size(); ++c) {
      const Corner& corner = corners_[c];
      if (!corner.sharp) continue;
      for (const uint32_t f : corner.faces) {
        if (std::find(corner.by.begin(), corner.by.end(), f) != corner.by.end()) continue;
        LinearForm stays = moveOf(c, normalOf(f));
        stays.emplace_back(f, -1);
        if (!system.addHardConstraint(stays, 0, tolerance_)) return std::nullopt;
      }
    }
    for (uint32_t c = 0; c < corners_.size(); ++c)
      for (int axis = 0; axis < 3 && corners_[c].sharp; ++axis) {
        Point along;
        along[axis] = 1;
        const double moved = wanted_[c][axis] - solid_.points[c][axis];
        if (maps_[static_cast<size_t>(axis)].isStiff(solid_.points[c][axis], tolerance_)) {
          if (!system.addHardConstraint(moveOf(c, along), moved, 8 * tolerance_)) return std::nullopt;
        } else {
          system.addSoftConstraint(moveOf(c, along), moved, kPlaceWeight / (edge_ * edge_));
        }
      }
    for (const auto& [a, b] : edges_) {
      const Point way = solid_.points[b] - solid_.points[a];
      const double size = length(way);
      LinearForm longer = moveOf(b, (1 / size) * way);
      for (const auto& [face, times] : moveOf(a, (1 / size) * way)) longer.emplace_back(face, -times);
      const double change = dot((1 / size) * way, wanted_[b] - wanted_[a]) - size;
      system.addSoftConstraint(longer, change, 1 / (size * size));
    }
    return moved(system.solve());
  }

  std::optional<Polyhedron> moved(const std::vector<double>& by) const {
    Polyhedron out = solid_;
    for (size_t f = 0; f < out.faces.size(); ++f) out.faces[f].plane.offset += by[f];
    for (size_t c = 0; c < corners_.size(); ++c) {
      Point& p = out.points[c];
      if (corners_[c].sharp)
        for (size_t m = 0; m < 3; ++m) p = p + by[corners_[c].by[m]] * corners_[c].moves[m];
      else
        p = onto(corners_[c].faces, out, wanted_[c]);
    }
    for (const auto& [a, b] : edges_) {
      const Point way = solid_.points[b] - solid_.points[a];
      if (dot(way, out.points[b] - out.points[a]) < kShortest * dot(way, way)) return std::nullopt;
    }
    for (int axis = 0; axis < 3; ++axis)
      for (size_t c = 0; c < corners_.size(); ++c)
        if (corners_[c].sharp &&
            !maps_[static_cast<size_t>(axis)].keeps(solid_.points[c][axis], out.points[c][axis], 16 * tolerance_))
          return std::nullopt;
    out.findBox();
    return out;
  }

  /// Projects a vertex that is not sharp (it lies within an edge or a face) into the planes of its faces, after these
  /// have moved.
  static Point onto(const std::vector<uint32_t>& faces, const Polyhedron& out, Point p) {
    Point first;
    for (const uint32_t f : faces) {
      const Plane& plane = out.faces[f].plane;
      Point way = plane.normal;
      if (f != faces.front()) way = way - dot(way, first) * first;
      const double along = dot(way, plane.normal);
      if (along < 1e-6) continue;
      p = p - (plane.distance(p) / along) * way;
      if (f != faces.front()) break;
      first = plane.normal;
    }
    return p;
  }

  const Polyhedron& solid_;
  const std::array<AxisMap, 3>& maps_;
  double edge_, tolerance_;
  std::vector<Point> wanted_;  ///< target position of each vertex: its mapped original position
  std::vector<Corner> corners_;
  std::vector<std::pair<uint32_t, uint32_t>> edges_;
};

}  // namespace

double AxisMap::operator()(double at) const {
  size_t i = 0;
  while (i + 2 < knots.size() && at > knots[i + 1].from) ++i;
  const Knot &a = knots[i], &b = knots[i + 1];
  return a.to + (at - a.from) * ((b.to - a.to) / (b.from - a.from));
}

bool AxisMap::isStiff(double at, double tolerance) const {
  if (at <= knots.front().from + tolerance || at >= knots.back().from - tolerance) return true;
  for (size_t i = 0; i + 1 < knots.size(); ++i)
    if (stiff[i] && at >= knots[i].from - tolerance && at <= knots[i + 1].from + tolerance) return true;
  return false;
}

bool AxisMap::keeps(double from, double to, double tolerance) const {
  size_t i = 0;
  while (i + 2 < knots.size() && from > knots[i + 1].from) ++i;
  return to >= knots[i].to - tolerance && to <= knots[i + 1].to + tolerance;
}

bool AxisMap::rises() const {
  for (size_t i = 0; i + 1 < knots.size(); ++i)
    if (!(knots[i + 1].to - knots[i].to >= kShortest * (knots[i + 1].from - knots[i].from))) return false;
  return true;
}

std::optional<Polyhedron> fitConstrained(const Polyhedron& solid, const std::array<AxisMap, 3>& maps) {
  return FaceMover(solid, maps).run();
}

}  // namespace sgm::asset
