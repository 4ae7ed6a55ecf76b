#include "asset/read/polygon_cutter.h"

#include <algorithm>

#include "asset/read/mesh_limits.h"

namespace sgm::asset {

namespace {

using Triples = std::vector<std::array<uint32_t, 3>>;

/// Returns corner k of a polygon that was added as a fan whose first triangle is `first`.
uint32_t cornerOf(const Triples& fan, size_t first, size_t k) { return k < 3 ? fan[first][k] : fan[first + k - 2][2]; }

}  // namespace

Result<void> PolygonCutter::addOther(size_t first, size_t corners, size_t place) {
  for (size_t k = 0; k < corners; ++k) {
    if (cornerOf(mesh_.triangles, first, k) < mesh_.points.size()) continue;
    later_.push_back({first, corners, place});
    return {};
  }
  return cut({first, corners, place});
}

/// Fast test: true if all triangles of the fan face the same way and turn around its first corner at most once, each by
/// a margin above the rounding error.
bool PolygonCutter::isPlainFan(const Polygon& polygon) const {
  const Point first = corners_[0];
  Point normal;
  for (size_t i = 2; i < polygon.corners; ++i) normal = normal + cross(corners_[i - 1] - first, corners_[i] - first);
  const double least = 1e-12 * dot(normal, normal);
  bool half = false;
  for (size_t i = 2; i < polygon.corners; ++i) {
    if (!(dot(cross(corners_[i - 1] - first, corners_[i] - first), normal) > least)) return false;
    const double turned = dot(cross(corners_[1] - first, corners_[i] - first), normal);
    if (half && turned >= -least) return false;
    half = half || turned <= 0;
  }
  return true;
}

Result<void> PolygonCutter::cut(const Polygon& polygon) {
  const auto& [first, corners, place] = polygon;
  corners_.clear();
  for (size_t k = 0; k < corners; ++k) corners_.push_back(mesh_.points[cornerOf(mesh_.triangles, first, k)]);
  if (isPlainFan(polygon)) return {};
  const std::string at = unit_ + " " + std::to_string(place);
  const Clipped clipped = clipping_.run(corners_, cut_);
  if (clipped == Clipped::over_limit)
    return Error{Code::limit, "it has polygons too intricate to be cut into triangles, such as one of " +
                                  std::to_string(corners) + " corners, at " + at};
  if (clipped == Clipped::crossed) {
    crossed_.add([&] { return at; });
    return {};
  }
  Triples was;
  for (Triples* list : {&mesh_.triangles, &mesh_.normals.corners, &mesh_.coordinates.corners}) {
    if (list->size() < first + corners - 2) continue;
    was.assign(list->begin() + static_cast<std::ptrdiff_t>(first),
               list->begin() + static_cast<std::ptrdiff_t>(first + corners - 2));
    for (size_t t = 0; t < cut_.size(); ++t)
      for (size_t k = 0; k < 3; ++k) (*list)[first + t][k] = cornerOf(was, 0, cut_[t][k]);
  }
  return {};
}

Result<void> PolygonCutter::finish() {
  for (const Polygon& polygon : later_)
    if (Result<void> done = cut(polygon); !done) return done;
  addNote(mesh_.notes, crossed_, "polygon crosses itself or has no area", "polygons cross themselves or have no area",
          ": triangles may overlap there");
  return {};
}

}  // namespace sgm::asset
