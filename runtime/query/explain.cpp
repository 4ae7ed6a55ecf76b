#include "query/explain.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "derive/draft.h"
#include "field/evaluate.h"

namespace sgm {
namespace {

/// Stands for the value of a shape that is not visible; larger than the value of any visible shape.
constexpr double kNothing = 1e20;

struct Sample {
  double value = kNothing;
  uint32_t label = 0;
};

Sample sampleAt(const FieldProgram& program, Int3 p) {
  EvalScratch scratch;
  float value = 0;
  Sample sample;
  Attributes wanted;
  wanted.value = &value;
  wanted.label = &sample.label;
  scalarKernels().attributes(program.view(), {&p.x, &p.y, &p.z, 1}, scratch, wanted);
  sample.value = static_cast<double>(value);
  return sample;
}

/// Evaluates single nodes of a cell's tree of shapes, and descends to the nodes that decide the field's value.
class NodeReader {
 public:
  NodeReader(const GrammarChunk& chunk, int32_t cell_edge) : chunk_(chunk), copier_(chunk), cell_edge_(cell_edge) {}

  /// Returns the value of the node's field at the place, in units; kNothing or more if level 0 does not show the node.
  double value(uint32_t shape, Int3 p) { return valueBy(copier_, shape, p); }

  /// Returns the nodes of a group. traced: this cell with the origins of its shapes. leaf: receives the index of the
  /// deciding shape in the result.
  Result<std::vector<ExplainedNode>> read(const TracedCell& traced, const Group& group, Int3 p, size_t& leaf) {
    traced_ = &traced;
    descend(group.root, p, 0, group.cut);
    leaf = leaf_;
    if (error_) return *error_;
    return nodes_;
  }

  const std::optional<Error>& error() const { return error_; }

 private:
  double valueBy(DraftCopier& copier, uint32_t shape, Int3 p) {
    const Group group{shape, false, IntBox::everything(), {}};
    GrammarChunk alone;
    copier.copy({&group, 1}, alone);
    const GroupIndex index(alone);
    const IndexedCell cell{&alone, &index};
    const Result<FieldProgram> program = compileField({&cell, 1}, {p, p}, {cell_edge_, cell_edge_, false, 0, nullptr});
    if (!program) {
      error_ = program.error();
      return kNothing;
    }
    return sampleAt(*program, p).value;
  }

  /// Returns the value of an expression at the place. Measures it: displaces the surface of a ball by the expression,
  /// and returns how far the surface moves.
  double number(uint32_t expr, Int3 p) {
    if (!ball_) ball_.emplace(chunk_);
    std::pmr::vector<Shape>& shapes = ball_->chunk.shapes;
    shapes[shapes.size() - 2].frame.origin = p;
    shapes.back().expr = expr;
    return (valueBy(ball_->copier, static_cast<uint32_t>(shapes.size()) - 1, p) + 1) / kUnitsPerMetre;
  }

  /// A copy of the cell with two additional shapes, a ball and its displacement. It is made once and used for all
  /// expressions.
  struct DisplacedBall {
    GrammarChunk chunk;
    DraftCopier copier;

    explicit DisplacedBall(const GrammarChunk& cell) : chunk(with(cell)), copier(chunk) {}

    static GrammarChunk with(const GrammarChunk& cell) {
      GrammarChunk chunk(cell);
      Shape ball, displaced;
      ball.size[0] = 1;
      displaced.kind = ShapeKind::displace;
      displaced.first_child = static_cast<uint32_t>(chunk.children.size());
      displaced.child_count = 1;
      chunk.children.push_back(static_cast<uint32_t>(chunk.shapes.size()));
      chunk.shapes.push_back(ball);
      chunk.shapes.push_back(displaced);
      return chunk;
    }
  };

  uint32_t child(const Shape& s, uint32_t i) const { return chunk_.children[s.first_child + i]; }

  void descend(uint32_t index, Int3 p, int depth, bool cuts) {
    const Shape s = chunk_.shapes[index];
    ExplainedNode node;
    node.kind = s.kind;
    node.depth = depth;
    node.cuts = cuts;
    node.value = value(index, p);
    const ShapeOrigin& origin = traced_->origins[index];
    node.path = traced_->uses[origin.use];
    node.span = origin.span;
    const size_t at = nodes_.size();
    nodes_.push_back(node);
    leaf_ = at;
    if (s.child_count == 0 || error_) return;
    // A tube or a beam counts as one shape, although it consists of pieces.
    if (s.kind == ShapeKind::unite && s.point_count > 0) return;
    switch (s.kind) {
      case ShapeKind::unite:
      case ShapeKind::unite_smooth:
      case ShapeKind::sum:
        nodes_[at].measure = static_cast<double>(s.amount);
        return nearest(s, false, p, at);
      case ShapeKind::meet:
      case ShapeKind::meet_smooth:
        nodes_[at].measure = static_cast<double>(s.amount);
        return nearest(s, true, p, at);
      case ShapeKind::subtract:
      case ShapeKind::subtract_smooth: {
        nodes_[at].measure = static_cast<double>(s.amount);
        const double whole = value(child(s, 0), p);
        double cut = kNothing;
        uint32_t by = 0;
        for (uint32_t i = 1; i < s.child_count; ++i) {
          const double one = value(child(s, i), p);
          if (one < cut) cut = one, by = i;
        }
        nodes_[at].others = s.child_count - 1;
        if (cut < kNothing && -cut > whole) return descend(child(s, by), p, nodes_[at].depth + 1, true);
        return descend(child(s, 0), p, nodes_[at].depth + 1, false);
      }
      case ShapeKind::morph: {
        const double t = s.expr == kNone ? static_cast<double>(s.amount) : std::clamp(number(s.expr, p), 0.0, 1.0);
        nodes_[at].measure = t;
        descend(child(s, 0), p, nodes_[at].depth + 1, false);
        const size_t first = leaf_;
        descend(child(s, 1), p, nodes_[at].depth + 1, false);
        if (t < 0.5) leaf_ = first;
        return;
      }
      case ShapeKind::displace:
        nodes_[at].measure = nodes_[at].value - value(child(s, 0), p);
        return descend(child(s, 0), p, nodes_[at].depth + 1, false);
      case ShapeKind::warp: {
        Int3 there = p;
        double square = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double by = std::round(kUnitsPerMetre * number(s.expr + static_cast<uint32_t>(axis), p));
          there[axis] = saturate(p[axis] + static_cast<int64_t>(by));
          square += by * by;
        }
        nodes_[at].measure = std::sqrt(square);
        return descend(child(s, 0), there, nodes_[at].depth + 1, false);
      }
      default:
        return;
    }
  }

  /// Descends into the child with the smallest value, or with the largest value if `largest` is true.
  void nearest(const Shape& s, bool largest, Int3 p, size_t at) {
    uint32_t found = 0;
    double best = largest ? -kNothing : kNothing;
    size_t shown = 0;
    for (uint32_t i = 0; i < s.child_count; ++i) {
      const double one = value(child(s, i), p);
      shown += one < kNothing;
      if (largest ? one > best : one < best) best = one, found = i;
    }
    nodes_[at].others = shown > 0 ? shown - 1 : 0;
    descend(child(s, found), p, nodes_[at].depth + 1, false);
  }

  const GrammarChunk& chunk_;
  DraftCopier copier_;
  int32_t cell_edge_;
  const TracedCell* traced_ = nullptr;
  std::optional<DisplacedBall> ball_;
  std::vector<ExplainedNode> nodes_;
  size_t leaf_ = 0;
  std::optional<Error> error_;
};

/// Of the groups examined so far, the group that decides the field's value.
struct Decision {
  bool any = false;
  uint32_t layer = 0;
  Int3 cell;
  uint32_t group = 0;
};

}  // namespace

Result<Explanation> explain(const WorldField& world, Int3 place) {
  const WorldFieldSettings& settings = world.settings();
  const Program& program = *settings.program;
  const IntBox box{place, place};
  const Result<std::shared_ptr<const FieldProgram>> whole = world.compile(box, 0);
  if (!whole) return whole.error();
  const Sample sample = sampleAt(**whole, place);
  Explanation out;
  out.solid = sample.value < 0;
  out.value = sample.value;
  out.material = static_cast<uint16_t>(sample.label);
  out.tag = static_cast<uint16_t>(sample.label >> 16);

  const int32_t margin = influenceMargin(settings.finest_cell);
  double value = program.domain.solid ? -kNothing : kNothing;
  Decision decision;
  for (uint32_t layer = 0; layer < program.layers.size(); ++layer) {
    std::vector<std::pair<Int3, std::shared_ptr<const DerivedCell>>> cells;
    const Result<void> gathered = world.cellsAround(layer, box.grown(margin), [&](Int3 at) -> Result<void> {
      Result<std::shared_ptr<const DerivedCell>> cell = world.cell(layer, at);
      if (!cell) return cell.error();
      cells.emplace_back(at, std::move(*cell));
      return {};
    });
    if (!gathered) return gathered.error();
    for (const bool cut : {false, true}) {
      for (const auto& [at, cell] : cells) {
        NodeReader reader(cell->chunk, settings.finest_cell);
        for (uint32_t g = 0; g < cell->chunk.groups.size(); ++g) {
          const Group& group = cell->chunk.groups[g];
          if (group.cut != cut || !group.bounds.grown(margin).meets(box)) continue;
          const double own = reader.value(group.root, place);
          if (own >= kNothing || (cut ? -own <= value : own >= value)) continue;
          value = cut ? -own : own;
          decision = {true, layer, at, g};
        }
        if (reader.error()) return *reader.error();
      }
    }
  }
  if (!decision.any) return out;
  const Result<TracedCell> traced = world.trace(decision.layer, decision.cell);
  if (!traced) return traced.error();
  NodeReader reader(traced->chunk, settings.finest_cell);
  Result<std::vector<ExplainedNode>> nodes =
      reader.read(*traced, traced->chunk.groups[decision.group], place, out.leaf);
  if (!nodes) return nodes.error();
  out.nodes = std::move(*nodes);
  out.layer = decision.layer;
  out.cell = decision.cell;
  return out;
}

}  // namespace sgm
