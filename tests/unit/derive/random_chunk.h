#pragma once
// Random trees of shapes of every kind, for tests of properties that all trees must have.

#include <algorithm>
#include <cmath>
#include <random>

#include "derive/shape.h"

namespace sgm {

class RandomChunk {
 public:
  explicit RandomChunk(uint32_t seed) : random_(seed) {
    Expr noise;
    noise.op = ExprOp::noise;
    noise.noise = 0;
    NoiseSpec spec;
    spec.seed = seed;
    chunk.noises.push_back(spec);
    chunk.exprs.push_back(noise);
  }

  GrammarChunk chunk;

  uint32_t tree(int depth) { return depth == 0 ? leaf() : combine(depth); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int32_t whole(int32_t low, int32_t high) { return std::uniform_int_distribution<int32_t>(low, high)(random_); }

 private:
  float size() { return static_cast<float>(real(50, 2000)); }

  Frame frame() {
    Frame f;
    f.origin = {whole(-4000, 4000), whole(-4000, 4000), whole(-4000, 4000)};
    if (whole(0, 2) == 0) return f;
    double q[4];
    double square = 0;
    for (double& v : q) v = real(-1, 1), square += v * v;
    if (square < 0.01) return f;
    for (double& v : q) v /= std::sqrt(square);
    const double w = q[0], x = q[1], y = q[2], z = q[3], m = whole(0, 1) == 0 ? 1 : -1;
    const double rows[9] = {m * (1 - 2 * (y * y + z * z)), m * 2 * (x * y - w * z), m * 2 * (x * z + w * y),
                            2 * (x * y + w * z),           1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                            2 * (x * z - w * y),           2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    for (size_t i = 0; i < 9; ++i) f.rows[i] = static_cast<float>(rows[i]);
    return f;
  }

  /// Adds the expression amplitude * noise, in metres; returns its index.
  uint32_t noise(double amplitude) {
    Expr c;
    c.value = static_cast<float>(amplitude);
    chunk.exprs.push_back(c);
    Expr e;
    e.op = ExprOp::multiply;
    e.a = 0;
    e.b = static_cast<uint32_t>(chunk.exprs.size()) - 1;
    chunk.exprs.push_back(e);
    return static_cast<uint32_t>(chunk.exprs.size()) - 1;
  }

  uint32_t parameter() {
    const uint32_t n = noise(0.5);
    Expr c;
    c.value = 0.5f;
    chunk.exprs.push_back(c);
    Expr e;
    e.op = ExprOp::add;
    e.a = n;
    e.b = static_cast<uint32_t>(chunk.exprs.size()) - 1;
    chunk.exprs.push_back(e);
    return static_cast<uint32_t>(chunk.exprs.size()) - 1;
  }

  uint32_t add(Shape s, const std::vector<uint32_t>& children) {
    s.first_child = static_cast<uint32_t>(chunk.children.size());
    s.child_count = static_cast<uint32_t>(children.size());
    chunk.children.insert(chunk.children.end(), children.begin(), children.end());
    chunk.shapes.push_back(s);
    return static_cast<uint32_t>(chunk.shapes.size()) - 1;
  }

  uint32_t leaf() {
    Shape s;
    s.kind = static_cast<ShapeKind>(whole(0, 11));
    if (s.kind == ShapeKind::meet) s.kind = ShapeKind::voxels;
    if (s.kind == ShapeKind::halfspace) s.kind = ShapeKind::sphere;
    if (s.kind == ShapeKind::unite) s.kind = ShapeKind::morph_power;
    s.frame = frame();
    if (s.kind == ShapeKind::voxels) s.frame.rows = Frame{}.rows;
    for (float& v : s.size) v = size();
    s.inner_radius = *std::min_element(s.size.begin(), s.size.end());
    if (s.kind == ShapeKind::superquadric) s.size[3] = static_cast<float>(real(2, 20));
    if (s.kind == ShapeKind::capsule) {
      for (size_t i = 1; i < 4; ++i) s.size[i] = static_cast<float>(whole(-3000, 3000));
    }
    if (s.kind == ShapeKind::torus) s.size[1] = std::min(s.size[1], s.size[0]);
    if (s.kind == ShapeKind::morph_power) s.expr = parameter();
    if (s.kind == ShapeKind::prism) {
      s.first_point = static_cast<uint32_t>(chunk.points.size());
      s.point_count = 5;
      for (int i = 0; i < 5; ++i) {
        const double r = real(200, 2000), a = i * 1.2566;
        chunk.points.push_back({static_cast<int32_t>(r * std::cos(a)), 0, static_cast<int32_t>(r * std::sin(a))});
      }
    }
    return add(s, {});
  }

  uint32_t combine(int depth) {
    Shape s;
    s.kind = static_cast<ShapeKind>(whole(static_cast<int>(ShapeKind::unite), static_cast<int>(ShapeKind::warp)));
    if (s.kind == ShapeKind::morph_power) s.kind = ShapeKind::unite_smooth;
    s.amount = static_cast<float>(real(50, 800));
    std::vector<uint32_t> children;
    int count = whole(1, 4);
    if (s.kind == ShapeKind::morph) {
      count = 2;
      if (whole(0, 1) == 0) {
        s.amount = static_cast<float>(real(0, 1));
      } else {
        s.expr = parameter();
      }
    }
    if (s.kind == ShapeKind::displace || s.kind == ShapeKind::warp) {
      count = 1;
      s.expr = noise(real(0, 0.4));
      if (s.kind == ShapeKind::warp) {
        for (int i = 0; i < 2; ++i) {
          const Expr copy = chunk.exprs.back();
          chunk.exprs.push_back(copy);
        }
      }
    }
    for (int i = 0; i < count; ++i) children.push_back(s.kind == ShapeKind::sum ? leaf() : tree(depth - 1));
    for (uint32_t c : children) s.inner_radius = std::max(s.inner_radius, chunk.shapes[c].inner_radius);
    return add(s, children);
  }

  std::mt19937 random_;
};

}  // namespace sgm
