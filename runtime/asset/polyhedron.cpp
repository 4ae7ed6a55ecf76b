#include "asset/polyhedron.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "asset/weld_triangles.h"

namespace sgm::asset {

namespace {

constexpr double kThinnest = 1e-3;  ///< minimum size of an asset along each axis, in metres
/// Minimum cosine between the normals of two triangles of one face. This is a coarse test; the distances of corners
/// from the plane decide.
constexpr double kAlike = 0.99;

/// Sets to 0 the components of a unit normal that are as small as the rounding errors of a file's floats. Faces that
/// are nearly perpendicular or parallel to an axis thus become exactly so.
Point straightened(Point normal) {
  constexpr double kRounding = 4e-6;
  for (int axis = 0; axis < 3; ++axis)
    if (std::fabs(normal[axis]) < kRounding) normal[axis] = 0;
  return normalised(normal);
}

class FaceFinder {
 public:
  FaceFinder(Polyhedron& solid, const std::vector<uint32_t>& materials) : solid_(solid), materials_(materials) {}

  void run() {
    const size_t count = solid_.triangles.size();
    for (size_t t = 0; t < count; ++t) crosses_.push_back(crossOf(t));
    for (uint32_t t = 0; t < count; ++t)
      for (size_t k = 0; k < 3; ++k) edges_.push_back({{solid_.triangles[t][k], solid_.triangles[t][(k + 1) % 3]}, t});
    std::sort(edges_.begin(), edges_.end());
    // Start each face with its largest triangle, which determines the plane most precisely.
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return dot(crosses_[a], crosses_[a]) > dot(crosses_[b], crosses_[b]);
    });
    solid_.face_of.assign(count, kNone);
    for (const uint32_t t : order)
      if (solid_.face_of[t] == kNone) grow(t);
  }

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;
  struct EdgeOf {
    std::pair<uint32_t, uint32_t> ends;
    uint32_t triangle;
    friend auto operator<=>(const EdgeOf&, const EdgeOf&) = default;
  };

  Point corner(size_t t, size_t k) const { return solid_.points[solid_.triangles[t][k]]; }
  Point crossOf(size_t t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }

  bool liesIn(uint32_t t, const Plane& plane) const {
    if (dot(normalised(crosses_[t]), plane.normal) < kAlike) return false;
    for (size_t k = 0; k < 3; ++k)
      if (std::fabs(plane.distance(corner(t, k))) > 2 * solid_.tolerance()) return false;
    return true;
  }

  void grow(uint32_t seed) {
    const uint32_t face = static_cast<uint32_t>(solid_.faces.size());
    Plane plane{normalised(crosses_[seed]), 0};
    plane.offset = dot(plane.normal, corner(seed, 0));
    std::vector<uint32_t> members{seed};
    solid_.face_of[seed] = face;
    for (size_t next = 0; next < members.size(); ++next)
      for (size_t k = 0; k < 3; ++k) {
        const auto& corners = solid_.triangles[members[next]];
        const std::pair back{corners[(k + 1) % 3], corners[k]};
        for (auto e = std::lower_bound(edges_.begin(), edges_.end(), EdgeOf{back, 0});
             e != edges_.end() && e->ends == back; ++e) {
          const uint32_t t = e->triangle;
          if (solid_.face_of[t] != kNone || materials_[t] != materials_[seed] || !liesIn(t, plane)) continue;
          solid_.face_of[t] = face;
          members.push_back(t);
        }
      }
    Point sum;
    for (const uint32_t t : members) sum = sum + crosses_[t];
    plane.normal = straightened(normalised(sum));
    double offset = 0;
    for (const uint32_t t : members)
      for (size_t k = 0; k < 3; ++k) offset += dot(plane.normal, corner(t, k));
    plane.offset = offset / (3 * static_cast<double>(members.size()));
    solid_.faces.push_back({plane, materials_[seed]});
  }

  Polyhedron& solid_;
  const std::vector<uint32_t>& materials_;
  std::vector<Point> crosses_;  ///< for each triangle: the cross product of two sides, whose length is twice the area
  std::vector<EdgeOf> edges_;
};

double longest(Point edges) { return std::max({edges.x, edges.y, edges.z}); }

}  // namespace

double Polyhedron::longestEdge() const { return longest(high - low); }

void Polyhedron::findBox() {
  low = high = points.empty() ? Point{} : points.front();
  for (const Point& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
}

double Polyhedron::volume() const {
  double sum = 0;
  for (const auto& t : triangles) sum += dot(points[t[0]] - low, cross(points[t[1]] - low, points[t[2]] - low)) / 6;
  return sum;
}

Result<Polyhedron> makePolyhedron(const TriangleMesh& mesh) {
  if (mesh.triangles.size() > kMaxTriangles)
    return Error{Code::limit,
                 "it has " + std::to_string(mesh.triangles.size()) + " triangles, and `fit` takes at most " +
                     std::to_string(kMaxTriangles),
                 0, 0};
  Polyhedron solid;
  // Points that no triangle uses do not count for the bounding box.
  for (const auto& t : mesh.triangles)
    for (const uint32_t corner : t) solid.points.push_back(mesh.points[corner]);
  solid.findBox();
  const Point edges = solid.high - solid.low;
  if (!(std::min({edges.x, edges.y, edges.z}) >= kThinnest))
    return Error{Code::bad_input, "it is flat: thinner than a millimetre", 0, 0};
  Result<WeldedTriangles> welded = weldTriangles(mesh.points, mesh.triangles, solid.tolerance());
  if (!welded) return welded.error();
  solid.points = std::move(welded->points);
  solid.triangles = std::move(welded->triangles);
  solid.findBox();
  if (!(solid.volume() > 0)) return Error{Code::bad_input, "it is turned inside out: its faces point inwards", 0, 0};
  std::vector<uint32_t> materials;
  for (const uint32_t source : welded->source) materials.push_back(mesh.materials[source]);
  FaceFinder(solid, materials).run();
  if (solid.faces.size() > kMaxFaces)
    return Error{Code::limit,
                 "it has " + std::to_string(solid.faces.size()) + " plane faces, and `fit` takes at most " +
                     std::to_string(kMaxFaces),
                 0, 0};
  return solid;
}

}  // namespace sgm::asset
