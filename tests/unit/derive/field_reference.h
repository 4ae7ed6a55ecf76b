#pragma once
// Evaluates the shapes of shape.h in double precision, as a reference for bounds. Noise may be any function with values
// in -1..1.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "derive/shape.h"

namespace sgm::reference {

inline double wide(float v) { return static_cast<double>(v); }

inline double noiseAt(uint32_t seed, Int3 p) {
  PathKey key{seed};
  for (int i = 0; i < 3; ++i) key = {hashCombine(key.value, static_cast<uint32_t>(p[i] >> 6))};
  return 2 * key.unit(0) - 1;
}

inline double exprAt(const GrammarChunk& chunk, uint32_t index, Int3 p) {
  const Expr& e = chunk.exprs[index];
  const auto at = [&](uint32_t i) { return exprAt(chunk, i, p); };
  switch (e.op) {
    case ExprOp::constant:
      return wide(e.value);
    case ExprOp::coordinate: {
      double sum = 0;
      for (int i = 0; i < 3; ++i)
        sum += wide(e.row[static_cast<size_t>(i)]) * (static_cast<double>(p[i]) - e.anchor[i]);
      return sum / kUnitsPerMetre;
    }
    case ExprOp::noise:
      return noiseAt(chunk.noises[e.noise].seed, p);
    case ExprOp::sweep:
      return 0.5;
    case ExprOp::negate:
      return -at(e.a);
    case ExprOp::absolute:
      return std::fabs(at(e.a));
    case ExprOp::floor:
      return std::floor(at(e.a));
    case ExprOp::square_root:
      return std::sqrt(std::max(0.0, at(e.a)));
    case ExprOp::add:
      return at(e.a) + at(e.b);
    case ExprOp::subtract:
      return at(e.a) - at(e.b);
    case ExprOp::multiply:
      return at(e.a) * at(e.b);
    case ExprOp::divide:
      return at(e.a) / at(e.b);
    case ExprOp::minimum:
      return std::min(at(e.a), at(e.b));
    case ExprOp::maximum:
      return std::max(at(e.a), at(e.b));
    case ExprOp::less:
      return at(e.a) < at(e.b) ? 1 : 0;
    case ExprOp::smoothstep: {
      const double t = std::clamp((at(e.a) - at(e.b)) / (at(e.c) - at(e.b)), 0.0, 1.0);
      return t * t * (3 - 2 * t);
    }
    case ExprOp::mix:
      return at(e.a) + (at(e.b) - at(e.a)) * at(e.c);
  }
  return 0;
}

struct Local {
  double x, y, z;
};

inline Local localOf(const Frame& f, Int3 p) {
  const double d[3] = {static_cast<double>(p.x) - f.origin.x, static_cast<double>(p.y) - f.origin.y,
                       static_cast<double>(p.z) - f.origin.z};
  double q[3] = {0, 0, 0};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) q[i] += wide(f.rows[3 * i + j]) * d[j];
  }
  return {q[0], q[1], q[2]};
}

inline double boxDistance(double x, double y, double z) {
  const double outside = std::sqrt(std::max(x, 0.0) * std::max(x, 0.0) + std::max(y, 0.0) * std::max(y, 0.0) +
                                   std::max(z, 0.0) * std::max(z, 0.0));
  return outside + std::min(0.0, std::max({x, y, z}));
}

inline double segmentDistance(double px, double py, double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((px - ax) * dx + (py - ay) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(px - ax - t * dx, py - ay - t * dy);
}

inline double superquadricAt(Local q, double rx, double ry, double rz, double n) {
  const double x = std::fabs(q.x) / rx, y = std::fabs(q.y) / ry, z = std::fabs(q.z) / rz, most = std::max({x, y, z});
  const double norm =
      most == 0 ? 0 : most * std::pow(std::pow(x / most, n) + std::pow(y / most, n) + std::pow(z / most, n), 1 / n);
  return (norm - 1) * std::min({rx, ry, rz});
}

inline double prismAt(const GrammarChunk& chunk, const Shape& s, Local q) {
  double distance = 1e300;
  bool inside = false;
  for (uint32_t i = 0, j = s.point_count - 1; i < s.point_count; j = i++) {
    const Int3 a = chunk.points[s.first_point + j], b = chunk.points[s.first_point + i];
    distance = std::min(distance, segmentDistance(q.x, q.z, a.x, a.z, b.x, b.z));
    if ((a.z > q.z) != (b.z > q.z) && q.x < (static_cast<double>(b.x) - a.x) * (q.z - a.z) / (b.z - a.z) + a.x) {
      inside = !inside;
    }
  }
  return boxDistance(inside ? -distance : distance, std::fabs(q.y) - wide(s.size[0]), -1e300);
}

inline double trunconeAt(const Shape& s, Local q) {
  const double bottom = wide(s.size[0]), top = wide(s.size[1]), h = wide(s.size[2]);
  const double ring = std::hypot(q.x, q.z);
  const double side = segmentDistance(ring, q.y, bottom, -h, top, h);
  const double cap_low = segmentDistance(ring, q.y, 0, -h, bottom, -h),
               cap_high = segmentDistance(ring, q.y, 0, h, top, h);
  const double distance = std::min({side, cap_low, cap_high});
  const double radius_here = bottom + (top - bottom) * (q.y + h) / (2 * h);
  return std::fabs(q.y) < h && ring < radius_here ? -distance : distance;
}

inline double fieldAt(const GrammarChunk& chunk, uint32_t index, Int3 p) {
  const Shape& s = chunk.shapes[index];
  const auto size = [&](size_t i) { return wide(s.size[i]); };
  const auto child = [&](uint32_t i) { return fieldAt(chunk, chunk.children[s.first_child + i], p); };
  const auto round = [&](double sign, uint32_t first_negated) {
    const double k = wide(s.amount);
    double least = 1e300, sum = 0;
    for (uint32_t i = 0; i < s.child_count; ++i) {
      const double d = (i >= first_negated ? -1 : 1) * sign * child(i);
      least = std::min(least, d);
      sum += std::max(k - d, 0.0) * std::max(k - d, 0.0);
    }
    return sign * (std::max(k, least) - std::sqrt(sum));
  };
  const Local q = localOf(s.frame, p);
  const double ring = std::hypot(q.x, q.z);
  switch (s.kind) {
    case ShapeKind::sphere:
      return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z) - size(0);
    case ShapeKind::box:
      return boxDistance(std::fabs(q.x) - size(0), std::fabs(q.y) - size(1), std::fabs(q.z) - size(2));
    case ShapeKind::voxels:  // a lower bound: the distance to the block's box
      return boxDistance(std::fabs(q.x) - size(0), std::fabs(q.y) - size(1), std::fabs(q.z) - size(2));
    case ShapeKind::cylinder:
      return boxDistance(ring - size(0), std::fabs(q.y) - size(1), -1e300);
    case ShapeKind::truncone:
      return trunconeAt(s, q);
    case ShapeKind::capsule: {
      const double d[3] = {static_cast<double>(p.x) - s.frame.origin.x, static_cast<double>(p.y) - s.frame.origin.y,
                           static_cast<double>(p.z) - s.frame.origin.z};
      double along = 0, square = 0;
      for (size_t i = 0; i < 3; ++i) along += d[i] * size(1 + i), square += size(1 + i) * size(1 + i);
      const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
      double rest = 0;
      for (size_t i = 0; i < 3; ++i) rest += (d[i] - t * size(1 + i)) * (d[i] - t * size(1 + i));
      return std::sqrt(rest) - size(0);
    }
    case ShapeKind::torus:
      return std::hypot(ring - size(0), q.y) - size(1);
    case ShapeKind::ellipsoid:
      return superquadricAt(q, size(0), size(1), size(2), 2);
    case ShapeKind::superquadric:
      return superquadricAt(q, size(0), size(1), size(2), size(3));
    case ShapeKind::halfspace:
      return q.y;
    case ShapeKind::prism:
      return prismAt(chunk, s, q);
    case ShapeKind::unite:
    case ShapeKind::meet:
    case ShapeKind::subtract: {
      double f = child(0);
      for (uint32_t i = 1; i < s.child_count; ++i) {
        f = s.kind == ShapeKind::unite  ? std::min(f, child(i))
            : s.kind == ShapeKind::meet ? std::max(f, child(i))
                                        : std::max(f, -child(i));
      }
      return f;
    }
    case ShapeKind::unite_smooth:
      return round(1, kNone);
    case ShapeKind::meet_smooth:
      return round(-1, kNone);
    case ShapeKind::subtract_smooth:
      return round(-1, 1);
    case ShapeKind::sum: {
      const double support = wide(kSumSupport) * wide(kSumSupport), base = 1 - 1 / support;
      double sum = 0, largest = 0;
      for (uint32_t i = 0; i < s.child_count; ++i) {
        const double r = wide(chunk.shapes[chunk.children[s.first_child + i]].inner_radius), x = 1 + child(i) / r;
        const double k = std::max(0.0, 1 - x * x / support);
        sum += k * k * k;
        largest = std::max(largest, r);
      }
      return (base * base * base - sum) * largest / (6 * base * base / support);
    }
    case ShapeKind::morph: {
      const double t = std::clamp(s.expr == kNone ? wide(s.amount) : exprAt(chunk, s.expr, p), 0.0, 1.0);
      return (1 - t) * child(0) + t * child(1);
    }
    case ShapeKind::morph_power: {
      const double t = std::clamp(exprAt(chunk, s.expr, p), 0.0, 1.0);
      const auto mixed = [&](size_t i) { return size(i) + (size(3 + i) - size(i)) * t; };
      return superquadricAt(q, mixed(0), mixed(1), mixed(2), 2 / (1 - t + t / wide(kMaxPower) * 2));
    }
    case ShapeKind::displace:
      return child(0) + 1024 * exprAt(chunk, s.expr, p);
    case ShapeKind::warp: {
      const auto moved = [&](int32_t at, uint32_t i) {
        return at + static_cast<int32_t>(std::floor(1024 * exprAt(chunk, s.expr + i, p) + 0.5));
      };
      return fieldAt(chunk, chunk.children[s.first_child], {moved(p.x, 0), moved(p.y, 1), moved(p.z, 2)});
    }
  }
  return 0;
}

}  // namespace sgm::reference
