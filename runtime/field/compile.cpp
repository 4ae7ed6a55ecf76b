#include "field/compile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <optional>

#include "derive/expr_range.h"
#include "field/voxels.h"

namespace sgm {

namespace {

constexpr int kMaxShapeDepth = 256;

// The ratio of the field's slope to that of the compact kernel, at the surface of a single ball of radius 1 (shape.h,
// `sum`).
double kernelSlope() {
  const double x = 1.0 / (double{kSumSupport} * double{kSumSupport});
  return 3 * (1 - x) * (1 - x) * 2 * x;
}

float kernelThreshold() {
  const double x = 1.0 / (double{kSumSupport} * double{kSumSupport});
  return static_cast<float>((1 - x) * (1 - x) * (1 - x));
}

// Emits one grammar chunk's shapes.
class ShapeCompiler {
 public:
  /// box: contains every position that will be sampled; cell_number: as in ShapeLabels::Source; shapes: null, or the
  /// table in which labels get numbers of shapes.
  ShapeCompiler(const GrammarChunk& chunk, uint32_t cell_number, const IntBox& box, int32_t cell, ShapeLabels* shapes,
                ProgramBuilder& builder, std::pmr::memory_resource* memory)
      : chunk_(chunk),
        cell_number_(cell_number),
        read_(box),
        cell_(cell),
        shapes_(shapes),
        builder_(builder),
        known_(chunk.exprs.size(), memory) {}

  /// Emits a shape; nullopt if the level drops the whole shape as too small.
  Result<std::optional<Value>> root(uint32_t shape) {
    epoch_ = ++epochs_;
    return emit(shape, 0);
  }

 private:
  using Emitted = Result<std::optional<Value>>;

  bool dropped(const Shape& s) const {
    if (s.kind == ShapeKind::voxels && !voxelsShow(chunk_.blocks[s.block], cell_)) return true;
    return (s.detail != 0 && cell_ > s.detail) || (s.coarsest != 0 && cell_ < s.coarsest);
  }

  /// Returns a shape's material and tag, or its number in the table of shapes; the pieces of one sweep share a number.
  uint32_t labelOf(uint32_t index) {
    const Shape& s = chunk_.shapes[index];
    if (shapes_ == nullptr) return makeLabel(s.material, s.tag);
    return sweep_ ? *sweep_ : shapes_->add({cell_number_, index});
  }

  std::span<const uint32_t> children(const Shape& s) const {
    return std::span(chunk_.children).subspan(s.first_child, s.child_count);
  }

  // Emits an expression. Each one is emitted once per group and place; further uses read its register.
  Value expr(uint32_t index) {
    Known& known = known_[index];
    if (known.epoch == epoch_) return known.value;
    const Expr& e = chunk_.exprs[index];
    auto operand = [&](uint32_t i) { return expr(i); };
    Value v;
    switch (e.op) {
      case ExprOp::constant:
        v = builder_.constant(e.value);
        break;
      case ExprOp::coordinate:
        v = builder_.coordinate(e.anchor, e.row[0], e.row[1], e.row[2]);
        break;
      case ExprOp::noise: {
        const NoiseSpec& n = chunk_.noises[e.noise];
        v = builder_.noise(n, octavesAt(n));
        break;
      }
      case ExprOp::sweep:
        v = builder_.sweep(std::span(chunk_.points).subspan(e.first_point, e.point_count));
        break;
      case ExprOp::negate:
        v = builder_.unary(Op::negate, operand(e.a));
        break;
      case ExprOp::absolute:
        v = builder_.unary(Op::absolute, operand(e.a));
        break;
      case ExprOp::floor:
        v = builder_.unary(Op::floor, operand(e.a));
        break;
      case ExprOp::square_root:
        v = builder_.unary(Op::square_root, operand(e.a));
        break;
      case ExprOp::smoothstep:
        v = builder_.smoothstep(operand(e.a), chunk_.exprs[e.b].value, chunk_.exprs[e.c].value);
        break;
      case ExprOp::mix: {
        const Value a = operand(e.a), b = operand(e.b);
        v = builder_.ternary(Op::mix, a, b, operand(e.c));
        break;
      }
      case ExprOp::add:
      case ExprOp::subtract:
      case ExprOp::multiply:
      case ExprOp::divide:
      case ExprOp::minimum:
      case ExprOp::maximum:
      case ExprOp::less: {
        const Value a = operand(e.a);
        v = builder_.binary(binaryOp(e.op), a, operand(e.b));
        break;
      }
    }
    known = {epoch_, v};
    return v;
  }

  static Op binaryOp(ExprOp op) {
    switch (op) {
      case ExprOp::add:
        return Op::add;
      case ExprOp::subtract:
        return Op::subtract;
      case ExprOp::multiply:
        return Op::multiply;
      case ExprOp::divide:
        return Op::divide;
      case ExprOp::minimum:
        return Op::minimum;
      case ExprOp::maximum:
        return Op::maximum;
      case ExprOp::less:
        return Op::less;
      case ExprOp::constant:
      case ExprOp::coordinate:
      case ExprOp::noise:
      case ExprOp::sweep:
      case ExprOp::negate:
      case ExprOp::absolute:
      case ExprOp::floor:
      case ExprOp::square_root:
      case ExprOp::smoothstep:
      case ExprOp::mix:
        break;
    }
    return Op::count;  // the other operators have one or three operands
  }

  // Returns the number of octaves to evaluate. Octaves with a period under two cells would only alias.
  uint32_t octavesAt(const NoiseSpec& n) const {
    uint32_t count = 0;
    while (count < n.octaves && (int64_t{n.period} >> count) >= 2 * int64_t{cell_}) ++count;
    return count;
  }

  Emitted emit(uint32_t index, int depth) {
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
        return some(
            builder_.prism(s.frame, z[0], std::span(chunk_.points).subspan(s.first_point, s.point_count), label));
      case ShapeKind::morph_power: {
        const Value t = s.expr == kNone ? builder_.constant(s.amount) : expr(s.expr);
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
        return some(builder_.binary(Op::displace, **child, expr(s.expr)));
      }
      case ShapeKind::warp:
        return warp(s, depth);
      case ShapeKind::voxels:
        return some(voxels(s, label));
    }
    return std::optional<Value>();
  }

  static Emitted some(Value v) { return std::optional<Value>(v); }

  // Emits a hard union or intersection, operand by operand. If an operand of an intersection is dropped, the whole
  // intersection is.
  Emitted chain(const Shape& s, Op op, int depth, bool all) {
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

  Emitted subtract(const Shape& s, int depth) {
    Emitted result = emit(children(s)[0], depth + 1);
    if (!result || !*result) return result;
    for (uint32_t child : children(s).subspan(1)) {
      Emitted v = emit(child, depth + 1);
      if (!v) return v;
      if (*v) *result = builder_.binary(Op::cut, **result, **v);
    }
    return result;
  }

  // Emits the round union of the children. Intersection and subtraction use it by negation: an intersection negates all
  // operands, a subtraction only the first: -(round union of -a, b, c, ...).
  Emitted round(const Shape& s, int depth, bool negated, bool only_first) {
    std::optional<ProgramBuilder::Accumulator> acc;
    const auto list = children(s);
    for (size_t i = 0; i < list.size(); ++i) {
      Emitted v = emit(list[i], depth + 1);
      if (!v) return v;
      if (!*v) {
        if (i == 0 && only_first) return std::optional<Value>();
        if (negated && !only_first) return std::optional<Value>();
        continue;
      }
      if (!acc) acc = builder_.beginRound(s.amount);
      const bool flip = negated && (i == 0 || !only_first);
      builder_.addRound(*acc, flip ? builder_.unary(Op::negate, **v) : **v);
    }
    if (!acc) return std::optional<Value>();
    const Value end = builder_.endRound(*acc);
    return some(negated ? builder_.unary(Op::negate, end) : end);
  }

  Emitted sum(const Shape& s, int depth) {
    std::optional<ProgramBuilder::Accumulator> acc;
    float largest = 0;
    // The scale belongs to the group at every level, so operands that this level drops count as well.
    for (uint32_t child : children(s)) largest = std::max(largest, chunk_.shapes[child].inner_radius);
    for (uint32_t child : children(s)) {
      const Shape& c = chunk_.shapes[child];
      std::optional<Value> weight;
      if (c.kind == ShapeKind::sphere && !dropped(c)) {
        if (!acc) acc = builder_.beginSum();
        if (weighsNothing(c)) continue;
        weight = builder_.blobWeight(c.frame.origin, c.size[0], labelOf(child));
      } else {
        Emitted v = emit(child, depth + 1);
        if (!v) return v;
        if (*v) weight = builder_.kernelWeight(**v, c.inner_radius);
      }
      if (!weight) continue;
      if (!acc) acc = builder_.beginSum();
      builder_.addSum(*acc, *weight);
    }
    if (!acc) return std::optional<Value>();
    return some(builder_.endSum(*acc, kernelThreshold(), static_cast<float>(double{largest} / kernelSlope())));
  }

  /// True if a ball's weight is 0 at every position that will be sampled, so that leaving it out changes no bit. Always
  /// false under a warp, where positions differ.
  bool weighsNothing(const Shape& ball) const {
    if (warps_ > 0) return false;
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = ball.frame.origin[axis];
      const double away = std::max({read_.lo[axis] - at, at - read_.hi[axis], 0.0});
      squared += away * away;
    }
    // The rounding error of the ball's distance in floats is far below this factor.
    constexpr double kSafely = 1 + 1e-4;
    const double support = double{ball.size[0]} * double{kSumSupport} * kSafely;
    return squared > support * support;
  }

  Emitted morph(const Shape& s, int depth) {
    Emitted a = emit(children(s)[0], depth + 1);
    if (!a || !*a) return a;
    Emitted b = emit(children(s)[1], depth + 1);
    if (!b || !*b) return b;
    const Value t = s.expr == kNone ? builder_.constant(s.amount) : expr(s.expr);
    return some(builder_.ternary(Op::morph, **a, **b, t));
  }

  Value voxels(const Shape& s, uint32_t label) {
    const Value own = builder_.box(s.frame, s.size[0], s.size[1], s.size[2], label);
    std::pmr::vector<float> samples(known_.get_allocator());
    const std::optional<SampleLattice> at = sampleVoxels(chunk_, s, read_, cell_, samples);
    if (!at) return own;
    return builder_.binary(Op::maximum, builder_.lattice(*at, samples, kFarSample, label), own);
  }

  Emitted warp(const Shape& s, int depth) {
    const Value x = expr(s.expr), y = expr(s.expr + 1), z = expr(s.expr + 2);
    builder_.pushWarp(x, y, z);
    // Values that were read at the outer place must be read again at the warped place.
    const uint64_t outer = epoch_;
    const IntBox outer_read = read_;
    epoch_ = ++epochs_;
    if (!chunk_.blocks.empty()) read_ = warpedBox(chunk_.exprs, s.expr, read_);
    ++warps_;
    Emitted child = emit(children(s)[0], depth + 1);
    --warps_;
    read_ = outer_read;
    epoch_ = outer;
    builder_.popWarp();
    return child;
  }

  struct Known {
    uint64_t epoch = 0;
    Value value;
  };

  const GrammarChunk& chunk_;
  uint32_t cell_number_;
  IntBox read_;    ///< contains every position that will be sampled
  int warps_ = 0;  ///< number of warps around the current shape
  int32_t cell_;
  ShapeLabels* shapes_;
  std::optional<uint32_t> sweep_;  ///< label of the sweep whose piece is compiled now; nullopt outside of sweeps
  ProgramBuilder& builder_;
  std::pmr::vector<Known> known_;
  uint64_t epochs_ = 0;
  uint64_t epoch_ = 0;
};

struct Gathered {
  size_t cell;  ///< index in the cells passed to compileField
  uint32_t group;
  uint32_t layer;
  bool cut;
  PathKey key;
};

}  // namespace

Result<FieldProgram> compileField(std::span<const IndexedCell> cells, const IntBox& box, const FieldSettings& settings,
                                  std::pmr::memory_resource* memory, std::span<const HostField> hosts,
                                  std::span<const Brush> brushes) {
  // Growing arrays allocate from this buffer, because each request to `memory` is counted, which threads contend for.
  std::array<std::byte, 8192> room;
  std::pmr::monotonic_buffer_resource scratch(room.data(), room.size(), memory);
  // The samples of a host field can be large, and the scratch buffer never frees memory that an array has outgrown.
  std::pmr::memory_resource* large = hosts.empty() ? &scratch : memory;
  const int32_t margin = influenceMargin(settings.cell);
  std::pmr::vector<Gathered> gathered(&scratch);
  std::pmr::vector<uint32_t> found(&scratch);
  for (size_t i = 0; i < cells.size(); ++i) {
    found.clear();
    cells[i].index->query(box.grown(margin), found);
    for (uint32_t g : found) {
      const Group& group = cells[i].chunk->groups[g];
      gathered.push_back({i, g, cells[i].chunk->layer, group.cut, group.key});
    }
  }
  std::sort(gathered.begin(), gathered.end(), [&](const Gathered& a, const Gathered& b) {
    if (a.layer != b.layer) return a.layer < b.layer;
    if (a.cut != b.cut) return b.cut;
    if (a.key != b.key) return a.key < b.key;
    if (a.cell != b.cell) return cells[a.cell].chunk->cell < cells[b.cell].chunk->cell;
    return a.group < b.group;
  });

  const bool by_shape = settings.shapes != nullptr;
  ProgramBuilder builder(settings.finest_cell, settings.solid, by_shape ? kNoShape : settings.label, large);
  std::pmr::vector<std::optional<ShapeCompiler>> compilers(cells.size(), &scratch);
  for (const Gathered& g : gathered) {
    std::optional<ShapeCompiler>& compiler = compilers[g.cell];
    if (!compiler) {
      compiler.emplace(*cells[g.cell].chunk, static_cast<uint32_t>(g.cell), box, settings.cell, settings.shapes,
                       builder, &scratch);
    }
    const Group& group = cells[g.cell].chunk->groups[g.group];
    Result<std::optional<Value>> root = compiler->root(group.root);
    if (!root) return root.error();
    if (!*root) continue;
    if (Result<void> ended = builder.group(**root, group.bounds.grown(margin), g.layer, g.cut); !ended) {
      return ended.error();
    }
  }
  uint32_t layer = gathered.empty() ? 0 : gathered.back().layer;
  for (const HostField& host : hosts) {
    if (!host.bounds.grown(host.smooth).grown(margin).meets(box)) continue;
    const uint32_t label = by_shape ? kNoShape : host.label;
    if (Result<void> emitted = emitHostField(builder, host, box, settings.cell, ++layer, label, memory); !emitted) {
      return emitted.error();
    }
  }
  for (Brush brush : brushes) {
    if (!brushShows(brush, settings.cell) || !brushBounds(brush).grown(margin).meets(box)) continue;
    if (by_shape) brush.material = brush.tag = 0xFFFF;
    if (Result<void> emitted = emitBrush(builder, brush, settings.cell, ++layer); !emitted) return emitted.error();
  }
  return FieldProgram(builder.finish(), memory);
}

}  // namespace sgm
