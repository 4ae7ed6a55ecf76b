#include "asset/bsp.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace sgm::asset {

namespace {

constexpr double kSamePlane = 1e-12;  ///< two planes count as parallel if the cosine of their normals is at least 1
                                      ///< minus this value
constexpr size_t kMaxCandidates = 24;

/// The part of a polyhedron's face that lies within a cell that is still to be split.
struct Fragment {
  Loop loop;
  uint32_t plane = 0;
  double area = 0;
};

struct OpenCell {
  ConvexCell body;
  std::vector<Side> sides;
  std::vector<Fragment> fragments;
};

/// Intersects a ray with a triangle. Returns 1 if the ray leaves the solid there, -1 if it enters, 0 if it misses;
/// nullopt if it passes too close to an edge to decide.
std::optional<int> crossing(Point from, Point along, Point a, Point b, Point c) {
  const Point e1 = b - a, e2 = c - a, normal = cross(e1, e2), to = a - from;
  const double facing = dot(along, normal), size = length(normal);
  if (std::fabs(facing) <= 1e-9 * size) return std::nullopt;
  const double ahead = dot(to, normal) / facing;
  if (ahead <= 0) return 0;
  const Point hit = ahead * along - to;
  const double v = dot(cross(hit, e2), normal) / (size * size), w = dot(cross(e1, hit), normal) / (size * size);
  const double least = std::min({v, w, 1 - v - w});
  if (least < -1e-7) return 0;
  if (least < 1e-7) return std::nullopt;
  return facing > 0 ? 1 : -1;
}

/// Returns the winding number of the surface around a point off the surface; nullopt if every test ray passes too close
/// to an edge.
std::optional<int> windingAt(const Polyhedron& solid, Point p) {
  // Ray directions that are unlikely to be parallel to edges or faces; models often have edges parallel to the axes.
  constexpr Point kRays[] = {{0.3713906763541037, 0.7427813527082074, 0.5570860145311556},
                             {-0.6123724356957945, 0.3535533905932738, 0.7071067811865475},
                             {0.8137334712067349, -0.4650, 0.34874291623145787},
                             {-0.2217, -0.6731, 0.7055},
                             {0.1231, 0.2239, -0.9668},
                             {0.7071, 0.1013, 0.6998},
                             {-0.9113, 0.3123, -0.2683},
                             {0.0917, -0.9871, 0.1313}};
  for (const Point& ray : kRays) {
    int sum = 0;
    bool clear = true;
    for (const auto& t : solid.triangles) {
      const auto met = crossing(p, ray, solid.points[t[0]], solid.points[t[1]], solid.points[t[2]]);
      clear = met.has_value();
      if (!clear) break;
      sum += *met;
    }
    if (clear) return sum;
  }
  return std::nullopt;
}

class CellCutter {
 public:
  CellCutter(const Polyhedron& solid, size_t most) : solid_(solid), most_(most) { out_.tolerance = solid.tolerance(); }

  Result<BspCells> run() {
    findPlanes();
    open_.push_back(whole());
    while (!open_.empty()) {
      OpenCell cell = std::move(open_.back());
      open_.pop_back();
      if (cell.fragments.empty())
        close(std::move(cell));
      else
        split(cell);
      if (out_.cells.size() + open_.size() > most_)
        return Error{Code::limit, "it falls into more than " + std::to_string(most_) + " convex parts", 0, 0};
    }
    return std::move(out_);
  }

 private:
  void findPlanes() {
    for (const Face& face : solid_.faces) {
      uint32_t found = 0;
      bool turned = false;
      for (; found < out_.planes.size(); ++found) {
        const Plane& known = out_.planes[found];
        const double facing = dot(known.normal, face.plane.normal);
        turned = facing < 0;
        if (std::fabs(facing) < 1 - kSamePlane) continue;
        if (std::fabs(known.offset - (turned ? -face.plane.offset : face.plane.offset)) <= out_.tolerance) break;
      }
      if (found == out_.planes.size()) {
        out_.planes.push_back(face.plane);
        turned = false;
      }
      out_.plane_of.push_back(found);
      out_.turned.push_back(turned);
    }
  }

  OpenCell whole() const {
    const Point margin = 0.25 * (solid_.high - solid_.low);
    OpenCell cell{ConvexCell::box(solid_.low - margin, solid_.high + margin), {}, {}};
    for (size_t t = 0; t < solid_.triangles.size(); ++t) {
      const auto& corners = solid_.triangles[t];
      Fragment f{{solid_.points[corners[0]], solid_.points[corners[1]], solid_.points[corners[2]]},
                 out_.plane_of[solid_.face_of[t]],
                 0};
      f.area = areaOf(f.loop);
      cell.fragments.push_back(std::move(f));
    }
    return cell;
  }

  void close(OpenCell cell) {
    BspCell leaf{std::move(cell.body), std::move(cell.sides), {}, 0, false};
    leaf.middle = leaf.body.middle();
    // If every test ray is ambiguous, the cell is as thin as the tolerance and counts as void.
    leaf.winding = windingAt(solid_, leaf.middle).value_or(0);
    leaf.solid = leaf.winding > 0;
    out_.cells.push_back(std::move(leaf));
  }

  /// Returns the plane that cuts the fewest face fragments of the cell; among equals, the plane with the largest area
  /// of fragments.
  uint32_t splitter(const OpenCell& cell) const {
    // (negated area, plane), so that sorting puts the largest area first
    std::vector<std::pair<double, uint32_t>> candidates;
    for (const Fragment& f : cell.fragments) {
      const auto known =
          std::find_if(candidates.begin(), candidates.end(), [&](const auto& c) { return c.second == f.plane; });
      if (known == candidates.end())
        candidates.emplace_back(-f.area, f.plane);
      else
        known->first -= f.area;
    }
    std::sort(candidates.begin(), candidates.end());
    if (candidates.size() > kMaxCandidates) candidates.resize(kMaxCandidates);
    uint32_t best = candidates.front().second;
    size_t fewest = cell.fragments.size() + 1;
    for (const auto& candidate : candidates) {
      const Plane& plane = out_.planes[candidate.second];
      size_t cuts = 0;
      for (const Fragment& f : cell.fragments) {
        bool behind = false, before = false;
        for (const Point& p : f.loop) {
          behind = behind || plane.distance(p) < -out_.tolerance;
          before = before || plane.distance(p) > out_.tolerance;
        }
        cuts += behind && before ? 1 : 0;
      }
      if (cuts >= fewest) continue;
      fewest = cuts;
      best = candidate.second;
    }
    return best;
  }

  void split(OpenCell& cell) {
    const uint32_t number = splitter(cell);
    const Plane plane = out_.planes[number];
    SplitCell parts = splitCell(cell.body, plane, out_.tolerance);
    for (const bool before : {true, false}) {
      std::optional<ConvexCell>& body = before ? parts.before : parts.behind;
      if (!body || body->facets.size() < 4) continue;
      OpenCell part{std::move(*body), cell.sides, {}};
      part.sides.push_back({number, before});
      const Plane side = before ? plane.turned() : plane;
      for (const Fragment& f : cell.fragments) {
        if (f.plane == number) continue;
        Fragment rest{clippedLoop(f.loop, side, out_.tolerance), f.plane, 0};
        // A fragment that touches the plane only along an edge does not count as lying in the plane.
        bool inside = false;
        for (const Point& p : rest.loop) inside = inside || side.distance(p) < -out_.tolerance;
        if (rest.loop.size() < 3 || !inside) continue;
        rest.area = areaOf(rest.loop);
        part.fragments.push_back(std::move(rest));
      }
      open_.push_back(std::move(part));
    }
  }

  const Polyhedron& solid_;
  size_t most_;
  BspCells out_;
  std::vector<OpenCell> open_;
};

}  // namespace

Result<BspCells> cutIntoCells(const Polyhedron& solid, size_t most) { return CellCutter(solid, most).run(); }

}  // namespace sgm::asset
