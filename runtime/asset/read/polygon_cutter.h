#pragma once
// Corrects the triangulation of polygons from files: readers add each polygon as a triangle fan, which is wrong for
// some non-convex polygons.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asset/read/ear_clipping.h"
#include "asset/read/mesh_notes.h"
#include "asset/triangle_mesh.h"
#include "base/result.h"

namespace sgm::asset {

/// Merges consecutive equal corners of a polygon, but always leaves at least three corners.
template <class Corner, class Same>
void dropRepeatedCorners(std::vector<Corner>& corners, Same same) {
  size_t different = corners.empty() || same(corners.front(), corners.back()) ? 0 : 1;
  for (size_t k = 1; k < corners.size(); ++k) different += size_t{!same(corners[k], corners[k - 1])};
  if (different < 3 || different == corners.size()) return;
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  if (same(corners.front(), corners.back())) corners.pop_back();
}

/// Replaces wrong triangle fans in a mesh. The new triangles take the fan's positions in the mesh's list; the
/// per-corner indices of normals and texture coordinates are changed accordingly.
class PolygonCutter {
 public:
  /// unit: the unit of `place` in messages, such as "line".
  PolygonCutter(TriangleMesh& mesh, std::string_view unit, uint64_t max_steps = EarClipping::kMaxSteps)
      : mesh_(mesh), unit_(unit), clipping_(max_steps) {}

  /// Checks the polygon that was read last, and corrects it. The mesh's last triangles must be its fan. corners: number
  /// of its corners, at least four. A polygon with points that are not read yet is stored for finish(). Error: limit if
  /// the polygons are too intricate.
  Result<void> add(size_t corners, size_t place) {
    const size_t first = mesh_.triangles.size() - (corners - 2);
    if (corners == 4 && isPlainQuad(first)) return {};
    return addOther(first, corners, place);
  }
  /// Checks the stored polygons, and adds a note about self-intersecting polygons. Call once, after all points were
  /// read.
  Result<void> finish();

 private:
  struct Polygon {
    size_t first, corners, place;
  };

  /// True if the two triangles of a quadrilateral's fan face the same way. This cheap test suffices for most polygons.
  bool isPlainQuad(size_t first) const {
    const auto& [a, b, c] = mesh_.triangles[first];
    const uint32_t d = mesh_.triangles[first + 1][2];
    const std::vector<Point>& points = mesh_.points;
    const size_t there = points.size();
    if (a >= there || b >= there || c >= there || d >= there) return false;
    const Point ac = points[c] - points[a];
    const Point one = cross(points[b] - points[a], ac), other = cross(ac, points[d] - points[a]);
    const double both = dot(one, other);
    return both > 0 && both > 1e-24 * (dot(one, one) + dot(other, other));
  }
  Result<void> addOther(size_t first, size_t corners, size_t place);
  bool isPlainFan(const Polygon& polygon) const;
  Result<void> cut(const Polygon& polygon);

  TriangleMesh& mesh_;
  std::string unit_;
  EarClipping clipping_;
  std::vector<Polygon> later_;
  std::vector<Point> corners_;
  std::vector<std::array<uint32_t, 3>> cut_;
  NotedPlaces crossed_;
};

}  // namespace sgm::asset
