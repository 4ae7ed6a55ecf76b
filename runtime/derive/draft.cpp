#include "derive/draft.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/math.h"

namespace sgm {
namespace {

uint64_t pack(uint32_t a, uint32_t b) { return uint64_t{a} | uint64_t{b} << 32; }
uint32_t bitsOf(int32_t v) { return static_cast<uint32_t>(v); }
uint32_t bitsOf(float v) { return std::bit_cast<uint32_t>(v); }

double folded(ExprOp op, double a, double b) {
  switch (op) {
    case ExprOp::negate:
      return -a;
    case ExprOp::absolute:
      return std::fabs(a);
    case ExprOp::floor:
      return detFloor(a);
    case ExprOp::square_root:
      return std::sqrt(std::max(a, 0.0));
    case ExprOp::add:
      return a + b;
    case ExprOp::subtract:
      return a - b;
    case ExprOp::multiply:
      return a * b;
    case ExprOp::divide:
      return a / b;
    case ExprOp::minimum:
      return std::min(a, b);
    case ExprOp::maximum:
      return std::max(a, b);
    case ExprOp::less:
      return a < b ? 1.0 : 0.0;
    default:
      return 0.0;
  }
}

bool isConstant(Num n, double value) { return n.constant() && n.value == value; }

}  // namespace

Draft::Draft(std::pmr::memory_resource* memory)
    : chunk_(memory),
      origins_(memory),
      sweeps_(memory),
      polyline_first_(memory),
      polyline_count_(memory),
      interned_(memory),
      noises_(memory) {}

Num Draft::intern(const Expr& e) {
  const ExprKey key{pack(static_cast<uint32_t>(e.op), e.a),
                    pack(e.b, e.c),
                    pack(bitsOf(e.value), e.noise),
                    pack(bitsOf(e.anchor.x), bitsOf(e.anchor.y)),
                    pack(bitsOf(e.anchor.z), bitsOf(e.row[0])) ^ (uint64_t{e.first_point} << 16),
                    pack(bitsOf(e.row[1]), bitsOf(e.row[2]))};
  const auto [place, fresh] = interned_.try_emplace(key, static_cast<uint32_t>(chunk_.exprs.size()));
  if (fresh) chunk_.exprs.push_back(e);
  return {0, place->second};
}

Num Draft::unary(ExprOp op, Num a) {
  if (a.constant()) return {folded(op, a.value, 0)};
  Expr e;
  e.op = op;
  e.a = a.node;
  return intern(e);
}

Num Draft::binary(ExprOp op, Num a, Num b) {
  if (a.constant() && b.constant()) return {folded(op, a.value, b.value)};
  if (op == ExprOp::divide && b.constant()) {
    op = ExprOp::multiply;
    b.value = 1.0 / b.value;
  }
  if (op == ExprOp::multiply) {
    if (isConstant(a, 0) || isConstant(b, 0)) return {0};
    if (isConstant(a, 1)) return b;
    if (isConstant(b, 1)) return a;
  }
  if (op == ExprOp::add && isConstant(a, 0)) return b;
  if ((op == ExprOp::add || op == ExprOp::subtract) && isConstant(b, 0)) return a;
  Expr e;
  e.op = op;
  e.a = expression(a);
  e.b = expression(b);
  return intern(e);
}

Num Draft::mix(Num a, Num b, Num t) {
  if (t.constant() && t.value == 0) return a;
  if (t.constant() && t.value == 1) return b;
  if (a.constant() && b.constant() && t.constant()) return {a.value + (b.value - a.value) * t.value};
  Expr e;
  e.op = ExprOp::mix;
  e.a = expression(a);
  e.b = expression(b);
  e.c = expression(t);
  return intern(e);
}

Num Draft::smoothstep(double low, double high, Num x) {
  if (x.constant()) {
    if (low == high) return {x.value < low ? 0.0 : 1.0};
    const double t = std::clamp((x.value - low) / (high - low), 0.0, 1.0);
    return {t * t * (3.0 - 2.0 * t)};
  }
  if (low == high) {
    return binary(ExprOp::subtract, {1}, binary(ExprOp::less, x, {low}));
  }
  Expr e;
  e.op = ExprOp::smoothstep;
  e.a = x.node;
  e.b = expression({low});
  e.c = expression({high});
  return intern(e);
}

Num Draft::coordinate(Int3 anchor, std::array<double, 3> row) {
  Expr e;
  e.op = ExprOp::coordinate;
  e.anchor = anchor;
  for (size_t i = 0; i < 3; ++i) e.row[i] = static_cast<float>(row[i] + 0.0);
  return intern(e);
}

Num Draft::noise(const NoiseSpec& spec) {
  const std::array<uint64_t, 2> key{pack(bitsOf(spec.period), spec.octaves), spec.seed};
  const auto [place, fresh] = noises_.try_emplace(key, static_cast<uint32_t>(chunk_.noises.size()));
  if (fresh) chunk_.noises.push_back(spec);
  Expr e;
  e.op = ExprOp::noise;
  e.noise = place->second;
  return intern(e);
}

Num Draft::sweep(uint32_t polyline) {
  Expr e;
  e.op = ExprOp::sweep;
  e.first_point = polyline_first_[polyline];
  e.point_count = polyline_count_[polyline];
  return intern(e);
}

uint32_t Draft::expression(Num n) {
  if (!n.constant()) return n.node;
  Expr e;
  e.value = static_cast<float>(n.value + 0.0);
  return intern(e).node;
}

uint32_t Draft::triple(const std::array<Num, 3>& n) {
  std::array<uint32_t, 3> source{};
  for (size_t i = 0; i < 3; ++i) source[i] = expression(n[i]);
  const uint32_t first = static_cast<uint32_t>(chunk_.exprs.size());
  for (uint32_t node : source) {
    Expr e;
    // Copy the expression, so that the three copies are consecutive: max(x, x) has the same value as x.
    e.op = ExprOp::maximum;
    e.a = e.b = node;
    chunk_.exprs.push_back(e);
  }
  return first;
}

uint32_t Draft::addPolyline(std::vector<Int3> points) {
  polyline_first_.push_back(static_cast<uint32_t>(chunk_.points.size()));
  polyline_count_.push_back(static_cast<uint32_t>(points.size()));
  chunk_.points.insert(chunk_.points.end(), points.begin(), points.end());
  return static_cast<uint32_t>(polyline_first_.size()) - 1;
}

void Draft::setLine(uint32_t shape, uint32_t polyline) {
  chunk_.shapes[shape].first_point = polyline_first_[polyline];
  chunk_.shapes[shape].point_count = polyline_count_[polyline];
}

uint32_t Draft::addPrismPoints(std::span<const Int3> points) {
  const auto first = static_cast<uint32_t>(chunk_.points.size());
  double twice_area = 0;  // positive if the corners run from x towards z, which is clockwise seen from +y
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const auto from_first = [&](int32_t at, int32_t first_at) { return static_cast<double>(int64_t{at} - first_at); };
    const Int3 &o = points[0], &a = points[i], &b = points[i + 1];
    twice_area += from_first(a.x, o.x) * from_first(b.z, o.z) - from_first(b.x, o.x) * from_first(a.z, o.z);
  }
  chunk_.points.insert(chunk_.points.end(), points.begin(), points.end());
  // Reverses the order of the corners, but keeps the first corner first.
  if (twice_area > 0) std::reverse(chunk_.points.begin() + first + 1, chunk_.points.end());
  return first;
}

uint32_t Draft::addVoxels(VoxelBlock block, std::span<const uint8_t> solid) {
  block.first_word = static_cast<uint32_t>(chunk_.voxels.size());
  chunk_.voxels.resize(block.first_word + block.words());
  for (size_t i = 0; i < solid.size(); ++i) {
    chunk_.voxels[block.first_word + i / 64] |= uint64_t{solid[i] != 0} << (i % 64);
  }
  chunk_.blocks.push_back(block);
  return static_cast<uint32_t>(chunk_.blocks.size()) - 1;
}

uint32_t Draft::addShape(Shape s, const Origin& origin, std::span<const uint32_t> children) {
  s.first_child = children.empty() ? 0 : static_cast<uint32_t>(chunk_.children.size());
  s.child_count = static_cast<uint32_t>(children.size());
  chunk_.children.insert(chunk_.children.end(), children.begin(), children.end());
  uint32_t sweep = kNone;
  for (uint32_t child : children) {
    if (sweep == kNone) sweep = sweeps_[child];
  }
  chunk_.shapes.push_back(s);
  origins_.push_back(origin);
  sweeps_.push_back(sweep);
  return static_cast<uint32_t>(chunk_.shapes.size()) - 1;
}

void Draft::keepChildren(uint32_t shape, std::span<const uint32_t> children) {
  Shape& s = chunk_.shapes[shape];
  std::copy(children.begin(), children.end(), chunk_.children.begin() + static_cast<std::ptrdiff_t>(s.first_child));
  s.child_count = static_cast<uint32_t>(children.size());
}

size_t Draft::bytes() const {
  return chunk_.shapes.size() * (sizeof(Shape) + sizeof(Origin) + sizeof(uint32_t)) +
         chunk_.children.size() * sizeof(uint32_t) + chunk_.exprs.size() * (sizeof(Expr) + 2 * sizeof(ExprKey)) +
         chunk_.noises.size() * (sizeof(NoiseSpec) + 64) + chunk_.points.size() * sizeof(Int3) +
         chunk_.blocks.size() * sizeof(VoxelBlock) + chunk_.voxels.size() * sizeof(uint64_t);
}

DraftCopier::DraftCopier(const GrammarChunk& from)
    : from_(from),
      shape_at_(from.shapes.size(), kNone),
      expr_at_(from.exprs.size(), kNone),
      noise_at_(from.noises.size(), kNone) {}

void DraftCopier::markExpr(uint32_t root) {
  const auto reach = [&](uint32_t i) {
    if (i == kNone || expr_at_[i] != kNone) return;
    expr_at_[i] = 0;
    exprs_.push_back(i);
    open_.push_back(i);
  };
  const size_t bottom = open_.size();
  reach(root);
  while (open_.size() > bottom) {
    const Expr& e = from_.exprs[open_.back()];
    open_.pop_back();
    for (uint32_t operand : {e.a, e.b, e.c}) reach(operand);
  }
}

void DraftCopier::mark(std::span<const Group> groups) {
  const auto reach = [&](uint32_t i) {
    if (shape_at_[i] != kNone) return;
    shape_at_[i] = 0;
    shapes_.push_back(i);
  };
  for (const Group& g : groups) reach(g.root);
  for (size_t next = 0; next < shapes_.size(); ++next) {
    const Shape& s = from_.shapes[shapes_[next]];
    for (uint32_t c = 0; c < s.child_count; ++c) reach(from_.children[s.first_child + c]);
    if (s.expr == kNone) continue;
    for (uint32_t k = 0; k < (s.kind == ShapeKind::warp ? 3u : 1u); ++k) markExpr(s.expr + k);
  }
  // Sorting keeps the original order, so that children still precede parents, and the three expressions of a warp stay
  // consecutive.
  std::sort(shapes_.begin(), shapes_.end());
  std::sort(exprs_.begin(), exprs_.end());
}

uint32_t DraftCopier::copyPoints(uint32_t first, uint32_t count, GrammarChunk& out) const {
  const uint32_t at = static_cast<uint32_t>(out.points.size());
  for (uint32_t i = 0; i < count; ++i) out.points.push_back(from_.points[first + i]);
  return count == 0 ? 0 : at;
}

uint32_t DraftCopier::copyBlock(uint32_t block, GrammarChunk& out) const {
  if (block == kNone) return kNone;
  VoxelBlock b = from_.blocks[block];
  const auto words = std::span(from_.voxels).subspan(b.first_word, b.words());
  b.first_word = static_cast<uint32_t>(out.voxels.size());
  out.voxels.insert(out.voxels.end(), words.begin(), words.end());
  out.blocks.push_back(b);
  return static_cast<uint32_t>(out.blocks.size()) - 1;
}

void DraftCopier::copyExprs(GrammarChunk& out) {
  const auto moved = [&](uint32_t i) { return i == kNone ? kNone : expr_at_[i]; };
  for (uint32_t i : exprs_) {
    Expr e = from_.exprs[i];
    e.a = moved(e.a);
    e.b = moved(e.b);
    e.c = moved(e.c);
    if (e.noise != kNone) {
      uint32_t& at = noise_at_[e.noise];
      if (at == kNone) {
        at = static_cast<uint32_t>(out.noises.size());
        noises_.push_back(e.noise);
        out.noises.push_back(from_.noises[e.noise]);
      }
      e.noise = at;
    }
    e.first_point = copyPoints(e.first_point, e.point_count, out);
    expr_at_[i] = static_cast<uint32_t>(out.exprs.size());
    out.exprs.push_back(e);
  }
}

void DraftCopier::copyShapes(GrammarChunk& out) {
  for (uint32_t i : shapes_) {
    Shape s = from_.shapes[i];
    const uint32_t first = s.child_count == 0 ? 0 : static_cast<uint32_t>(out.children.size());
    for (uint32_t c = 0; c < s.child_count; ++c) {
      out.children.push_back(shape_at_[from_.children[s.first_child + c]]);
    }
    s.first_child = first;
    s.expr = s.expr == kNone ? kNone : expr_at_[s.expr];
    s.first_point = copyPoints(s.first_point, s.point_count, out);
    s.block = copyBlock(s.block, out);
    shape_at_[i] = static_cast<uint32_t>(out.shapes.size());
    out.shapes.push_back(s);
  }
}

void DraftCopier::copy(std::span<const Group> groups, GrammarChunk& out) {
  const auto forget = [](std::vector<uint32_t>& used, std::vector<uint32_t>& at) {
    for (uint32_t i : used) at[i] = kNone;
    used.clear();
  };
  forget(shapes_, shape_at_);
  forget(exprs_, expr_at_);
  forget(noises_, noise_at_);
  mark(groups);
  copyExprs(out);
  copyShapes(out);
  for (Group g : groups) {
    g.root = shape_at_[g.root];
    out.groups.push_back(g);
  }
}

}  // namespace sgm
