#include "field/shape_compiler.h"

#include <algorithm>
#include <vector>

#include "derive/expr_range.h"
#include "field/voxels.h"

namespace sgm {

namespace {

constexpr int kMaxShapeDepth = 256;

// Returns the magnitude of the compact kernel's slope at the surface of a single ball of radius 1 (shape.h, `sum`).
double kernelSlope() {
  const double x = 1.0 / (double{kSumSupport} * double{kSumSupport});
  return 3 * (1 - x) * (1 - x) * 2 * x;
}

float kernelThreshold() {
  const double x = 1.0 / (double{kSumSupport} * double{kSumSupport});
  return static_cast<float>((1 - x) * (1 - x) * (1 - x));
}

}  // namespace

bool ShapeCompiler::dropped(const Shape& s) const {
  if (s.kind == ShapeKind::voxels && !voxelsShow(chunk_.blocks[s.block], cell_)) return true;
  return (s.detail != 0 && cell_ > s.detail) || (s.coarsest != 0 && cell_ < s.coarsest);
}

uint32_t ShapeCompiler::labelOf(uint32_t index) {
  const Shape& s = chunk_.shapes[index];
  if (shapes_ == nullptr) return makeLabel(s.material, s.tag);
  return sweep_ ? *sweep_ : shapes_->add({cell_number_, index});
}

ShapeCompiler::Emitted ShapeCompiler::emit(uint32_t index, int depth) {
  const Shape& s = chunk_.shapes[index];
  if (dropped(s)) return std::optional<Value>();
  if (depth > kMaxShapeDepth) {
    return Error{Code::limit, "shapes are nested more than 256 deep; split the rule into shallower ones"};
  }
  const uint32_t label = s.child_count == 0 ? labelOf(index) : 0;
  const auto& z = s.size;
  switch (s.kind) {
    case ShapeKind::sphere:
      return some(builder_.sphere(s.frame.origin, z[0], label));
    case ShapeKind::box:
      return some(builder_.box(s.frame, z[0], z[1], z[2], label));
    case ShapeKind::cylinder:
      return some(builder_.cylinder(s.frame, z[0], z[1], label));
    case ShapeKind::truncone:
      return some(builder_.truncone(s.frame, z[0], z[1], z[2], label));
    case ShapeKind::capsule:
      return some(builder_.capsule(s.frame.origin, z[1], z[2], z[3], z[0], label));
    case ShapeKind::torus:
      return some(builder_.torus(s.frame, z[0], z[1], label));
    case ShapeKind::ellipsoid:
      return some(builder_.ellipsoid(s.frame, z[0], z[1], z[2], label));
    case ShapeKind::superquadric:
      return some(builder_.superquadric(s.frame, z[0], z[1], z[2], z[3], label));
    case ShapeKind::halfspace:
      return some(builder_.halfspace(s.frame, label));
    case ShapeKind::prism:
      return some(builder_.prism(s.frame, z[0], std::span(chunk_.points).subspan(s.first_point, s.point_count), label));
    case ShapeKind::morph_power: {
      const Value t = s.expr == kNone ? builder_.constant(s.amount) : exprs_.emit(s.expr);
      return some(builder_.powerMorph(s.frame, z, t, label));
    }
    case ShapeKind::unite: {
      const std::optional<uint32_t> outer = sweep_;
      if (s.point_count > 0 && shapes_ != nullptr) sweep_ = labelOf(index);
      Emitted pieces = chain(s, Op::minimum, depth, false);
      sweep_ = outer;
      return pieces;
    }
    case ShapeKind::meet:
      return chain(s, Op::maximum, depth, true);
    case ShapeKind::subtract:
      return subtract(s, depth);
    case ShapeKind::unite_smooth:
      return round(s, depth, false, false);
    case ShapeKind::meet_smooth:
      return round(s, depth, true, false);
    case ShapeKind::subtract_smooth:
      return round(s, depth, true, true);
    case ShapeKind::sum:
      return sum(s, depth);
    case ShapeKind::morph:
      return morph(s, depth);
    case ShapeKind::displace: {
      Emitted child = emit(children(s)[0], depth + 1);
      if (!child || !*child) return child;
      return some(builder_.binary(Op::displace, **child, exprs_.emit(s.expr)));
    }
    case ShapeKind::warp:
      return warp(s, depth);
    case ShapeKind::voxels:
      return some(voxels(s, label));
  }
  return std::optional<Value>();
}

ShapeCompiler::Emitted ShapeCompiler::chain(const Shape& s, Op op, int depth, bool all) {
  std::optional<Value> result;
  for (uint32_t child : children(s)) {
    Emitted v = emit(child, depth + 1);
    if (!v) return v;
    if (!*v) {
      if (all) return std::optional<Value>();
      continue;
    }
    result = result ? builder_.binary(op, *result, **v) : **v;
  }
  return result;
}

ShapeCompiler::Emitted ShapeCompiler::subtract(const Shape& s, int depth) {
  Emitted result = emit(children(s)[0], depth + 1);
  if (!result || !*result) return result;
  for (uint32_t child : children(s).subspan(1)) {
    Emitted v = emit(child, depth + 1);
    if (!v) return v;
    if (*v) *result = builder_.binary(Op::cut, **result, **v);
  }
  return result;
}

ShapeCompiler::Emitted ShapeCompiler::round(const Shape& s, int depth, bool negated, bool only_first) {
  std::optional<RoundUnion> acc;
  const auto list = children(s);
  for (size_t i = 0; i < list.size(); ++i) {
    Emitted v = emit(list[i], depth + 1);
    if (!v) return v;
    if (!*v) {
      if (i == 0 && only_first) return std::optional<Value>();
      if (negated && !only_first) return std::optional<Value>();
      continue;
    }
    if (!acc) acc.emplace(builder_, s.amount);
    const bool flip = negated && (i == 0 || !only_first);
    acc->add(flip ? builder_.unary(Op::negate, **v) : **v);
  }
  if (!acc) return std::optional<Value>();
  const Value end = acc->end();
  return some(negated ? builder_.unary(Op::negate, end) : end);
}

ShapeCompiler::Emitted ShapeCompiler::sum(const Shape& s, int depth) {
  std::optional<KernelSum> acc;
  float largest = 0;
  // The scale of the sum must be the same at every level, so it also depends on operands that this level drops.
  for (uint32_t child : children(s)) largest = std::max(largest, chunk_.shapes[child].inner_radius);
  for (uint32_t child : children(s)) {
    const Shape& c = chunk_.shapes[child];
    std::optional<Value> weight;
    if (c.kind == ShapeKind::sphere && !dropped(c)) {
      if (!acc) acc.emplace(builder_);
      if (weighsNothing(c)) continue;
      weight = builder_.blobWeight(c.frame.origin, c.size[0], labelOf(child));
    } else {
      Emitted v = emit(child, depth + 1);
      if (!v) return v;
      if (*v) weight = builder_.kernelWeight(**v, c.inner_radius);
    }
    if (!weight) continue;
    if (!acc) acc.emplace(builder_);
    acc->add(*weight);
  }
  if (!acc) return std::optional<Value>();
  return some(acc->end(kernelThreshold(), static_cast<float>(double{largest} / kernelSlope())));
}

bool ShapeCompiler::weighsNothing(const Shape& ball) const {
  if (warps_ > 0) return false;
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = ball.frame.origin[axis];
    const double away = std::max({read_.lo[axis] - at, at - read_.hi[axis], 0.0});
    squared += away * away;
  }
  // The rounding error of the ball's distance in float is far below this safety factor.
  constexpr double kSafely = 1 + 1e-4;
  const double support = double{ball.size[0]} * double{kSumSupport} * kSafely;
  return squared > support * support;
}

ShapeCompiler::Emitted ShapeCompiler::morph(const Shape& s, int depth) {
  Emitted a = emit(children(s)[0], depth + 1);
  if (!a || !*a) return a;
  Emitted b = emit(children(s)[1], depth + 1);
  if (!b || !*b) return b;
  const Value t = s.expr == kNone ? builder_.constant(s.amount) : exprs_.emit(s.expr);
  return some(builder_.ternary(Op::morph, **a, **b, t));
}

Value ShapeCompiler::voxels(const Shape& s, uint32_t label) {
  const Value own = builder_.box(s.frame, s.size[0], s.size[1], s.size[2], label);
  std::pmr::vector<float> samples(memory_);
  const std::optional<SampleLattice> at = sampleVoxels(chunk_, s, read_, cell_, samples);
  if (!at) return own;
  return builder_.binary(Op::maximum, builder_.lattice(*at, samples, kFarSample, label), own);
}

ShapeCompiler::Emitted ShapeCompiler::warp(const Shape& s, int depth) {
  const Value x = exprs_.emit(s.expr), y = exprs_.emit(s.expr + 1), z = exprs_.emit(s.expr + 2);
  builder_.pushWarp(x, y, z);
  // Expressions that were emitted at the outer place must be emitted again at the warped place.
  const uint64_t outer = exprs_.beginPlace();
  const IntBox outer_read = read_;
  if (!chunk_.blocks.empty()) read_ = warpedBox(chunk_.exprs, s.expr, read_);
  ++warps_;
  Emitted child = emit(children(s)[0], depth + 1);
  --warps_;
  read_ = outer_read;
  exprs_.returnTo(outer);
  builder_.popWarp();
  return child;
}

}  // namespace sgm
