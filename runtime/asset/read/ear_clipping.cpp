#include "asset/read/ear_clipping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asset/exact_sign.h"
#include "asset/read/polygon_crossing.h"

namespace sgm::asset {

namespace {

constexpr uint32_t kNone = 0xFFFFFFFFu;
constexpr double kFar = std::numeric_limits<double>::infinity();
/// If all corners are closer to the plane than this value times the polygon's size, the polygon counts as planar.
constexpr double kFlatness = 1e-6;

}  // namespace

/// Projects the corners to a plane. A planar polygon is projected by dropping one of the three coordinates, which is
/// exact; any other polygon is projected along its normal. Returns false if the polygon has no normal.
bool EarClipping::project(std::span<const Point> corners) {
  Point normal, low = corners[0], high = corners[0];
  for (size_t i = 0; i < corners.size(); ++i) {
    const Point& p = corners[i];
    if (i > 1) normal = normal + cross(corners[i - 1] - corners[0], p - corners[0]);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const double size = length(high - low);
  const Point n = normalised(normal);
  if (n == Point{} || !(length(normal) > 1e-14 * size * size)) return false;
  double thickness = 0;
  for (const Point& p : corners) thickness = std::max(thickness, std::fabs(dot(n, p - corners[0])));
  points_.assign(corners.begin(), corners.end());
  if (thickness <= kFlatness * size) {
    drop_ = std::fabs(n.x) > std::fabs(n.y) ? 0 : 1;
    if (std::fabs(n.z) >= std::fabs(n[drop_])) drop_ = 2;
    sign_ = n[drop_] > 0 ? 1 : -1;
  } else {
    // Choose two directions perpendicular to the normal. The first one is also perpendicular to the axis along which
    // the normal is smallest.
    int least = std::fabs(n.x) < std::fabs(n.y) ? 0 : 1;
    if (std::fabs(n.z) < std::fabs(n[least])) least = 2;
    Point axis;
    axis[least] = 1;
    const Point right = normalised(cross(axis, n)), up = cross(n, right);
    for (Point& p : points_) {
      const Point from = p - corners[0];
      p = {dot(right, from), dot(up, from), 0};
    }
    drop_ = 2;
    sign_ = 1;
  }
  u_ = (drop_ + 1) % 3;
  v_ = (drop_ + 2) % 3;
  return true;
}

int EarClipping::side(uint32_t a, uint32_t b, uint32_t c) const {
  return sign_ * orientationAlong(drop_, points_[a], points_[b], points_[c]);
}

/// True if the triangle fan around corner 0 is a correct triangulation: its triangles turn around the corner at most
/// once, and none of them is degenerate.
bool EarClipping::fanHolds() const {
  bool half = false;  // true once the triangles of the fan have turned by at least half a turn from the fan's first
                      // edge
  for (uint32_t i = 2; i < points_.size(); ++i) {
    if (side(0, i - 1, i) <= 0) return false;
    const int turned = side(0, 1, i);
    if (half && turned >= 0) return false;
    half = half || turned <= 0;
  }
  return true;
}

void EarClipping::makeRing() {
  const auto count = static_cast<uint32_t>(points_.size());
  left_ = count;
  next_.resize(count);
  previous_.resize(count);
  for (uint32_t i = 0; i < count; ++i) {
    next_[i] = i + 1 == count ? 0 : i + 1;
    previous_[i] = i == 0 ? count - 1 : i - 1;
  }
  gone_.assign(count, false);
  queued_.assign(count, false);
  waiting_first_.assign(count, kNone);
  waiting_.clear();
  queue_.clear();
  leaves_ = 1;
  while (leaves_ < count) leaves_ *= 2;
  order_.resize(count);
  place_.resize(count);
  corner_in_.resize(leaves_);
  for (uint32_t i = 0; i < count; ++i) order_[i] = i;
  boxes_.assign(2 * leaves_, {{kFar, kFar}, {-kFar, -kFar}});
  buildTree(order_.data(), order_.data() + count, 1, leaves_, 0);
}

/// Builds the k-d tree of the corners as an implicit tree: node 1 is the root; nodes 2 n and 2 n + 1 are the children
/// of n.
void EarClipping::buildTree(uint32_t* first, uint32_t* last, size_t node, size_t leaves, int axis) {
  if (first == last) return;
  if (leaves == 1) {
    const double at[2] = {points_[*first][u_], points_[*first][v_]};
    place_[*first] = static_cast<uint32_t>(node);
    corner_in_[node - leaves_] = *first;
    boxes_[node] = {{at[0], at[1]}, {at[0], at[1]}};
    return;
  }
  uint32_t* const middle = first + std::min<size_t>(leaves / 2, static_cast<size_t>(last - first));
  const int by = axis == 0 ? u_ : v_;
  std::nth_element(first, middle, last,
                   [&](uint32_t a, uint32_t b) { return std::pair(points_[a][by], a) < std::pair(points_[b][by], b); });
  buildTree(first, middle, 2 * node, leaves / 2, 1 - axis);
  buildTree(middle, last, 2 * node + 1, leaves / 2, 1 - axis);
  mergeBoxes(node);
}

void EarClipping::mergeBoxes(size_t node) {
  const Box &one = boxes_[2 * node], &other = boxes_[2 * node + 1];
  for (int k = 0; k < 2; ++k) {
    boxes_[node].low[k] = std::min(one.low[k], other.low[k]);
    boxes_[node].high[k] = std::max(one.high[k], other.high[k]);
  }
}

void EarClipping::removeFromTree(uint32_t corner) {
  size_t node = place_[corner];
  boxes_[node] = {{kFar, kFar}, {-kFar, -kFar}};
  while ((node /= 2) > 0) mergeBoxes(node);
}

/// True if the box and the ear are certainly disjoint. May be false for a disjoint box that is close to the ear.
bool EarClipping::isApart(const Box& box, const std::array<uint32_t, 3>& ear) const {
  const Point* const p[3] = {&points_[ear[0]], &points_[ear[1]], &points_[ear[2]]};
  const int axes[2] = {u_, v_};
  for (int k = 0; k < 2; ++k) {
    const int axis = axes[k];
    if (std::min({(*p[0])[axis], (*p[1])[axis], (*p[2])[axis]}) > box.high[k]) return true;
    if (std::max({(*p[0])[axis], (*p[1])[axis], (*p[2])[axis]}) < box.low[k]) return true;
  }
  for (int k = 0; k < 3; ++k) {
    const Point &a = *p[k], &b = *p[(k + 1) % 3];
    const double across_u = -sign_ * (b[v_] - a[v_]), across_v = sign_ * (b[u_] - a[u_]);
    // Of the corners of the box, take the one farthest towards the inner side of this edge. If even that corner is
    // outside of the edge, so is the whole box.
    const double u = (across_u > 0 ? box.high[0] : box.low[0]) - a[u_];
    const double v = (across_v > 0 ? box.high[1] : box.low[1]) - a[v_];
    const double inward = across_u * u + across_v * v;
    if (inward < -1e-12 * (std::fabs(across_u * u) + std::fabs(across_v * v))) return true;
  }
  return false;
}

/// True if a corner prevents the ear from being clipped: it lies inside the ear or, by the strict rule, on its diagonal
/// c-a, where later triangles would be degenerate.
bool EarClipping::blocks(uint32_t corner, const std::array<uint32_t, 3>& ear, Rule rule) const {
  const auto [a, b, c] = ear;
  const int across = side(c, a, corner);
  return (across > 0 || (across == 0 && rule == Rule::strict)) && side(a, b, corner) > 0 && side(b, c, corner) > 0;
}

uint32_t EarClipping::blocker(uint32_t a, uint32_t b, uint32_t c, Rule rule) {
  const std::array<uint32_t, 3> ear{a, b, c};
  stack_.assign(1, 1);
  while (!stack_.empty()) {
    const uint32_t node = stack_.back();
    stack_.pop_back();
    ++steps_;
    if (isApart(boxes_[node], ear)) continue;
    if (node < leaves_) {
      stack_.push_back(2 * node + 1);
      stack_.push_back(2 * node);
      continue;
    }
    const uint32_t corner = corner_in_[node - leaves_];
    if (corner != a && corner != b && corner != c && blocks(corner, ear, rule)) return corner;
  }
  return kNone;
}

void EarClipping::enqueue(uint32_t corner) {
  if (queued_[corner] || gone_[corner]) return;
  queued_[corner] = true;
  queue_.push_back(corner);
}

void EarClipping::wake(uint32_t corner) {
  for (uint32_t w = std::exchange(waiting_first_[corner], kNone); w != kNone; w = waiting_[w].next)
    enqueue(waiting_[w].corner);
}

/// Clips ears until none is left, or the rest of the polygon is one triangle. Returns false if that takes too many
/// steps.
bool EarClipping::clip(Rule rule, std::vector<std::array<uint32_t, 3>>& out) {
  for (uint32_t i = 0; i < points_.size(); ++i) enqueue(i);
  for (size_t head = 0; head < queue_.size() && left_ > 3; ++head) {
    if (++steps_ > max_steps_) return false;
    const uint32_t b = queue_[head];
    queued_[b] = false;
    if (gone_[b]) continue;
    const uint32_t a = previous_[b], c = next_[b];
    const int area = side(a, b, c);
    if (area < 0 || (area == 0 && rule != Rule::flat)) continue;
    if (area > 0) {
      if (const uint32_t in_it = blocker(a, b, c, rule); in_it != kNone) {
        waiting_.push_back({b, std::exchange(waiting_first_[in_it], static_cast<uint32_t>(waiting_.size()))});
        continue;
      }
    }
    out.push_back({a, b, c});
    gone_[b] = true;
    --left_;
    next_[a] = c;
    previous_[c] = a;
    removeFromTree(b);
    wake(b);
    enqueue(a);
    enqueue(c);
  }
  queue_.clear();
  std::fill(queued_.begin(), queued_.end(), false);
  return true;
}

Clipped EarClipping::run(std::span<const Point> corners, std::vector<std::array<uint32_t, 3>>& out) {
  out.clear();
  if (!project(corners)) return Clipped::crossed;
  if (fanHolds()) {
    for (uint32_t i = 2; i < points_.size(); ++i) out.push_back({0, i - 1, i});
    return Clipped::done;
  }
  if (crossesItself(points_, drop_)) return Clipped::crossed;
  makeRing();
  for (Rule rule = Rule::strict; left_ > 3;) {
    const size_t before = left_;
    if (!clip(rule, out)) return Clipped::over_limit;
    if (left_ < before && rule != Rule::strict)
      rule = Rule::strict;
    else if (rule == Rule::flat)
      return Clipped::crossed;
    else
      rule = rule == Rule::strict ? Rule::touching : Rule::flat;
  }
  const auto last = static_cast<uint32_t>(std::find(gone_.begin(), gone_.end(), false) - gone_.begin());
  const std::array<uint32_t, 3> rest{last, next_[last], next_[next_[last]]};
  if (side(rest[0], rest[1], rest[2]) < 0) return Clipped::crossed;
  out.push_back(rest);
  return Clipped::done;
}

}  // namespace sgm::asset
