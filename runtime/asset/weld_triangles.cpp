#include "asset/weld_triangles.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <utility>

namespace sgm::asset {

namespace {

using Triangle = std::array<uint32_t, 3>;
using DirectedEdge = std::pair<uint32_t, uint32_t>;

/// Returns, for each point, the index of the point with which it is merged (possibly itself).
std::vector<uint32_t> merged(const std::vector<Point>& points, double tolerance) {
  std::vector<uint32_t> order(points.size()), into(points.size(), static_cast<uint32_t>(points.size()));
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const Point &p = points[a], &q = points[b];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
  });
  for (size_t i = 0; i < order.size(); ++i) {
    if (into[order[i]] != points.size()) continue;
    into[order[i]] = order[i];
    const Point p = points[order[i]];
    for (size_t k = i + 1; k < order.size() && points[order[k]].x - p.x <= tolerance; ++k) {
      const Point d = points[order[k]] - p;
      if (into[order[k]] == points.size() && std::fabs(d.y) <= tolerance && std::fabs(d.z) <= tolerance)
        into[order[k]] = order[i];
    }
  }
  return into;
}

class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance) {}

  Result<WeldedTriangles> run(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
    const std::vector<uint32_t> into = merged(points, tolerance_);
    std::vector<uint32_t> number(points.size(), static_cast<uint32_t>(points.size()));
    for (uint32_t t = 0; t < triangles.size(); ++t) {
      Triangle corners{};
      for (size_t k = 0; k < 3; ++k) {
        uint32_t& at = number[into[triangles[t][k]]];
        if (at == points.size()) {
          at = static_cast<uint32_t>(out_.points.size());
          out_.points.push_back(points[into[triangles[t][k]]]);
        }
        corners[k] = at;
      }
      add(corners, t);
    }
    constexpr int kMaxRounds = 16;
    for (int round = 0; round < kMaxRounds && splitEdges(); ++round) {
    }
    if (const std::optional<std::string> open = complaint()) return Error{Code::bad_input, *open, 0, 0};
    return std::move(out_);
  }

 private:
  bool isSliver(const Triangle& t) const {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
    const Point a = out_.points[t[0]], b = out_.points[t[1]], c = out_.points[t[2]];
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    return length(cross(b - a, c - a)) <= tolerance_ * longest;
  }

  void add(const Triangle& corners, uint32_t source) {
    if (isSliver(corners)) return;
    out_.triangles.push_back(corners);
    out_.source.push_back(source);
  }

  void sortEdges() {
    edges_.clear();
    for (const Triangle& t : out_.triangles)
      for (size_t k = 0; k < 3; ++k) edges_.emplace_back(t[k], t[(k + 1) % 3]);
    std::sort(edges_.begin(), edges_.end());
  }
  size_t countOf(uint32_t a, uint32_t b) const {
    const auto [first, end] = std::equal_range(edges_.begin(), edges_.end(), DirectedEdge{a, b});
    return static_cast<size_t>(end - first);
  }
  bool isOpen(uint32_t a, uint32_t b) const { return countOf(a, b) != countOf(b, a); }

  /// Splits open edges of triangles where corners of other open edges lie on them. Returns true if any edge was split.
  bool splitEdges() {
    sortEdges();
    std::vector<uint32_t> corners;
    for (const auto& [a, b] : edges_) {
      if (!isOpen(a, b)) continue;
      corners.push_back(a);
      corners.push_back(b);
    }
    const auto before_x = [&](uint32_t a, uint32_t b) {
      const double x = out_.points[a].x, y = out_.points[b].x;
      return x != y ? x < y : a < b;
    };
    std::sort(corners.begin(), corners.end(), before_x);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.empty()) return false;
    const WeldedTriangles before = std::exchange(out_, {});
    out_.points = before.points;
    bool any = false;
    for (size_t t = 0; t < before.triangles.size(); ++t) {
      const Triangle& whole = before.triangles[t];
      std::optional<Triangle> low, high;
      for (size_t k = 0; k < 3 && !low; ++k) {
        const uint32_t a = whole[k], b = whole[(k + 1) % 3], c = whole[(k + 2) % 3];
        if (!isOpen(a, b)) continue;
        const std::optional<uint32_t> between = cornerBetween(a, b, corners);
        if (!between || *between == c) continue;
        low = {a, *between, c};
        high = {*between, b, c};
      }
      any = any || low;
      add(low.value_or(whole), before.source[t]);
      if (high) add(*high, before.source[t]);
    }
    return any;
  }

  /// Of the corners that lie on the edge strictly between a and b, returns the one nearest to a; nullopt if there is
  /// none. corners: sorted by x.
  std::optional<uint32_t> cornerBetween(uint32_t a, uint32_t b, const std::vector<uint32_t>& corners) const {
    const Point from = out_.points[a], along = out_.points[b] - from;
    const double size = length(along);
    std::optional<uint32_t> nearest;
    double least = size - tolerance_;
    const double low = std::min(from.x, from.x + along.x) - tolerance_, high = std::max(from.x, from.x + along.x);
    auto next = std::lower_bound(corners.begin(), corners.end(), low,
                                 [&](uint32_t c, double x) { return out_.points[c].x < x; });
    for (; next != corners.end() && out_.points[*next].x <= high + tolerance_; ++next) {
      const uint32_t corner = *next;
      if (corner == a || corner == b) continue;
      const Point to = out_.points[corner] - from;
      const double at = dot(to, along) / size;
      if (at <= tolerance_ || at >= least || length(to - (at / size) * along) > tolerance_) continue;
      least = at;
      nearest = corner;
    }
    return nearest;
  }

  std::optional<std::string> complaint() {
    sortEdges();
    for (const auto& [a, b] : edges_) {
      if (!isOpen(a, b)) continue;
      const std::string edge = "the edge from " + placeText(out_.points[a]) + " to " + placeText(out_.points[b]);
      if (countOf(a, b) > 1 && countOf(b, a) == 0)
        return "two triangles go the same way along " + edge + ": one of them is turned inside out";
      return "it is open at " + edge + ", which has no triangle on its other side";
    }
    return std::nullopt;
  }

  double tolerance_;
  WeldedTriangles out_;
  std::vector<DirectedEdge> edges_;
};

}  // namespace

std::string metresText(double metres) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, metres, std::chars_format::fixed, 3);
  std::string text(buffer, end.ptr);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string placeText(Point p) { return "(" + metresText(p.x) + ", " + metresText(p.y) + ", " + metresText(p.z) + ")"; }

Result<WeldedTriangles> weldTriangles(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                                      double tolerance) {
  return Welder(tolerance).run(points, triangles);
}

}  // namespace sgm::asset
