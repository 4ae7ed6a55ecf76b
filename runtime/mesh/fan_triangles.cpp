#include "mesh/fan_triangles.h"

#include <algorithm>
#include <array>
#include <limits>

namespace sgm {
namespace {

/// The maximum number of points of a fan: the vertices and face vertices of a loop, and the centre.
constexpr size_t kMaxPoints = LoopTriangles::kMost + 1;

struct Area {
  int64_t x = 0, y = 0, z = 0;

  int64_t along(const Area& other) const { return x * other.x + y * other.y + z * other.z; }
};

/// Returns the cross product of two sides of a triangle: twice its area, along its normal.
Area areaOf(const Int3& a, const Int3& b, const Int3& c) {
  const int64_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int64_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

void add(const FanPoint& a, const FanPoint& b, const FanPoint& c, LoopTriangles& triangles) {
  triangles.add({a.at, b.at, c.at}, {a.name, b.name, c.name});
}

/// A patch of a fan or strip: an approximately planar polygon. Its first corner is the centre of the fan or, in a
/// strip, a face vertex.
class Patch {
 public:
  explicit Patch(const FanPoint& centre) : corners_{centre}, count_(1) {}

  void add(const FanPoint& point) { corners_[count_++] = point; }
  size_t count() const { return count_; }
  const FanPoint& corner(size_t i) const { return corners_[i]; }

  /// Triangulates the patch as a fan around its first corner. If that fan folds, and other free diagonals exist with
  /// which all triangles face one way, uses these diagonals instead. Returns false if the fan's diagonals are not free,
  /// and no other free diagonals give triangles that all face one way.
  bool triangulate(const IsFree& is_free, LoopTriangles& triangles) const {
    const bool may_be_fan = hasFreeSpokes(is_free);
    if ((may_be_fan && isFan(normal())) || !triangulateFlat(is_free, triangles)) {
      if (!may_be_fan) return false;
      for (size_t i = 1; i + 1 < count_; ++i) sgm::add(corners_[0], corners_[i], corners_[i + 1], triangles);
    }
    return true;
  }

  /// Triangulates the patch so that all triangles face one way. Returns false if no choice of free diagonals achieves
  /// that.
  bool triangulateFlat(const IsFree& is_free, LoopTriangles& triangles) const {
    std::array<std::array<uint8_t, kMaxPoints>, kMaxPoints> apexes;
    if (!findDiagonals(is_free, normal(), apexes)) return false;
    const auto write = [&](const auto& self, size_t i, size_t j) -> void {
      if (j - i < 2) return;
      const size_t k = apexes[i][j];
      sgm::add(corners_[i], corners_[k], corners_[j], triangles);
      self(self, i, k);
      self(self, k, j);
    };
    write(write, 0, count_ - 1);
    return true;
  }

 private:
  bool hasFreeSpokes(const IsFree& is_free) const {
    if (corners_[0].name >= kCellVertices) return true;
    for (size_t i = 2; i + 1 < count_; ++i)
      if (!is_free(corners_[0].name, corners_[i].name)) return false;
    return true;
  }

  Area normal() const {
    Area sum;
    for (size_t i = 1; i + 1 < count_; ++i) {
      const Area area = areaOf(corners_[0].at, corners_[i].at, corners_[i + 1].at);
      sum.x += area.x, sum.y += area.y, sum.z += area.z;
    }
    return sum;
  }

  bool isFan(const Area& out) const {
    for (size_t i = 1; i + 1 < count_; ++i)
      if (areaOf(corners_[0].at, corners_[i].at, corners_[i + 1].at).along(out) <= 0) return false;
    return true;
  }

  /// Finds the diagonals by dynamic programming. apexes[i][j] becomes the apex of the triangle over the chord from
  /// corner i to corner j. Returns false if every triangulation has a diagonal that is not free, or a triangle that
  /// does not face towards `out`.
  bool findDiagonals(const IsFree& is_free, const Area& out,
                     std::array<std::array<uint8_t, kMaxPoints>, kMaxPoints>& apexes) const {
    constexpr int64_t kNoTriangles = 0;
    std::array<std::array<int64_t, kMaxPoints>, kMaxPoints> smallest{};
    for (size_t i = 0; i + 1 < count_; ++i) smallest[i][i + 1] = std::numeric_limits<int64_t>::max();
    for (size_t span = 2; span < count_; ++span) {
      for (size_t i = 0; i + span < count_; ++i) {
        const size_t j = i + span;
        int64_t best = kNoTriangles;
        if (span == count_ - 1 || is_free(corners_[i].name, corners_[j].name)) {
          for (size_t k = i + 1; k < j; ++k) {
            const int64_t own = areaOf(corners_[i].at, corners_[k].at, corners_[j].at).along(out);
            const int64_t least = std::min({own, smallest[i][k], smallest[k][j]});
            if (least <= best) continue;
            best = least;
            apexes[i][j] = static_cast<uint8_t>(k);
          }
        }
        smallest[i][j] = best;
      }
    }
    return smallest[0][count_ - 1] != kNoTriangles;
  }

  std::array<FanPoint, kMaxPoints> corners_;
  size_t count_;
};

}  // namespace

LoopTriangles coneTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed) {
  LoopTriangles triangles;
  for (size_t i = 0; i + 1 < ring.size(); ++i) add(centre, ring[i], ring[i + 1], triangles);
  if (is_closed) add(centre, ring.back(), ring.front(), triangles);
  return triangles;
}

LoopTriangles stripTriangles(std::span<const FanPoint> ring, bool from_second, const IsFree& is_free) {
  const auto isFeature = [](const FanPoint& p) { return p.is_feature; };
  auto first = std::find_if(ring.begin(), ring.end(), isFeature);
  if (from_second && first != ring.end()) first = std::find_if(first + 1, ring.end(), isFeature);
  const auto features = std::count_if(ring.begin(), ring.end(), isFeature);
  if (features == 0 || features % 2 != 0) return {};
  LoopTriangles triangles;
  const auto start = static_cast<size_t>(first - ring.begin());
  Patch rest(*first), cut_off(*first);
  bool cuts_off = true, is_empty = true;
  for (size_t i = 1; i <= ring.size(); ++i) {
    const FanPoint& point = ring[(start + i) % ring.size()];
    if (cuts_off) cut_off.add(point);
    is_empty = is_empty && point.is_feature;
    // Adds the points of the remaining patch. The walk ends at the face vertex at which it began; `rest` already
    // contains this vertex.
    if ((!cuts_off || point.is_feature) && i < ring.size()) rest.add(point);
    if (!point.is_feature) continue;
    if (!cuts_off && is_empty) return {};
    if (cuts_off && cut_off.count() > 2 && !cut_off.triangulateFlat(is_free, triangles)) return {};
    cuts_off = !cuts_off;
    is_empty = true;
    cut_off = Patch(point);
  }
  if (!rest.triangulateFlat(is_free, triangles)) return {};
  return triangles;
}

LoopTriangles patchTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed,
                             const IsFree& is_free) {
  const auto features = std::count_if(ring.begin(), ring.end(), [](const FanPoint& p) { return p.is_feature; });
  if (is_closed && features < 2) return coneTriangles(centre, ring, is_closed);
  LoopTriangles triangles;
  // The walk around a closed ring starts and ends at its first face vertex.
  const auto first = std::find_if(ring.begin(), ring.end(), [](const FanPoint& p) { return p.is_feature; });
  const size_t start = is_closed ? static_cast<size_t>(first - ring.begin()) : 0;
  const size_t count = ring.size() + (is_closed ? 1 : 0);
  // If two patches have the same two face vertices, only one of the patches may have a diagonal between these vertices.
  std::array<uint32_t, 2> joined{centre.name, centre.name};
  const IsFree is_left = [&](uint32_t a, uint32_t b) { return !(a == joined[1] && b == joined[0]) && is_free(a, b); };
  Patch patch(centre);
  for (size_t i = 0; i < count; ++i) {
    const FanPoint& point = ring[(start + i) % ring.size()];
    patch.add(point);
    if (patch.count() < 3 || (i + 1 < count && !point.is_feature)) continue;
    const size_t begin = triangles.count();
    if (!patch.triangulate(is_left, triangles)) return {};
    const std::array<uint32_t, 3>& name = triangles.all()[begin].name;
    if (name[1] == patch.corner(1).name && name[2] == point.name) joined = {name[1], name[2]};
    patch = Patch(centre);
    patch.add(point);
  }
  return triangles;
}

}  // namespace sgm
