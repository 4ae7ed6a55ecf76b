#include "backend/vulkan/tape_fuse.h"

#include <bit>

#include "backend/vulkan/tape_ops.h"

namespace sgm {

namespace {

using Node = TapeScratch::Node;
using Value = TapeScratch::Value;

class Fuser {
 public:
  Fuser(const ProgramView& program, TapeScratch& scratch)
      : program_(program), nodes_(scratch.nodes), values_(scratch.values) {}

  void run() {
    count();
    for (Node& n : nodes_) {
      takeConstant(n);
      if (n.is(Op::sum_add)) takeOperand(n);
    }
    uniteShapes();
  }

 private:
  void count() {
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      TapeScratch::forEachValue(n, [&](size_t v) { values_[v].uses += 1; });
      if (n.dst < 0) continue;
      Value& made = values_[static_cast<size_t>(n.dst)];
      made.maker = made.uses == 1 && n.second < 0 ? static_cast<int32_t>(i) : -1;
      made.kind = n.kind;
    }
  }

  /// Returns the only node that makes the value, if it has this op; otherwise null.
  Node* makerOf(int32_t v, Op op) {
    const int32_t maker = v < 0 ? -1 : values_[static_cast<size_t>(v)].maker;
    return maker >= 0 && nodes_[static_cast<size_t>(maker)].is(op) ? &nodes_[static_cast<size_t>(maker)] : nullptr;
  }
  // True if one node makes the value and one node reads it: `uses` counts both, so it is 2.
  bool readOnce(int32_t v) const { return values_[static_cast<size_t>(v)].uses == 2; }

  void takeConstant(Node& n) {
    if (!n.is(Op::mix) && !n.is(Op::morph)) return;
    Node* const constant = makerOf(n.c, Op::constant);
    if (constant == nullptr) return;
    n.by_constant = true;
    n.by = std::bit_cast<float>(program_.params[constant->params]);
    constant->gone = readOnce(n.c);
    values_[static_cast<size_t>(n.c)].uses -= 1;
    n.c = -1;
  }

  /// Merges up to two nodes into a sum: first the kernel that makes the sum's operand, then the morph that makes the
  /// kernel's operand. A sum usually adds the kernel weight of a distance; in grammars with morphs, this is the
  /// distance to a morph of two shapes.
  void takeOperand(Node& n) {
    Node* const kernel = makerOf(n.a, Op::kernel);
    if (kernel == nullptr || !readOnce(n.a)) return;
    n.weighs = true;
    n.params = kernel->params;
    n.a = kernel->a;
    kernel->gone = true;
    Node* const morph = makerOf(n.a, Op::morph);
    // Do not merge a morph whose parameter is the constant 0 or 1: pruning can then remove one of its two shapes, which
    // saves more.
    if (morph == nullptr || !readOnce(n.a) || !morph->by_constant || !(morph->by > 0 && morph->by < 1)) return;
    n.morphs = true;
    n.by = morph->by;
    n.a = morph->a;
    n.c = morph->b;
    morph->gone = true;
  }

  /// True if the op reads only a position and has a variant that takes the minimum with an operand.
  static bool isShape(uint32_t kind) {
    if (kind >= static_cast<uint32_t>(Op::count) || kind == static_cast<uint32_t>(Op::noise)) return false;
    const OpShape shape = shapeOf(static_cast<Op>(kind));
    return shape.position && shape.operands == 0;
  }

  /// Merges a minimum into the shape (primitive) just before it; the minimum's other operand becomes an operand of the
  /// shape. Does not merge them if other nodes read one of the two operands, or if the shape would have to wait for
  /// another sweep.
  void uniteShapes() {
    int32_t values = 0;
    size_t kept = 0;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      Node n = nodes_[i];
      if (n.gone) continue;
      if (n.is(Op::minimum) && kept > 0) {
        const Value &a = values_[static_cast<size_t>(n.a)], &b = values_[static_cast<size_t>(n.b)];
        Node& shape = nodes_[kept - 1];
        const bool alone = readOnce(n.a) && readOnce(n.b) && shape.dst == b.renamed && shape.a < 0;
        if (alone && isShape(shape.kind) && isShape(a.kind) && sweepRank(a.kind) <= sweepRank(shape.kind)) {
          shape.a = a.renamed;
          Value& made = values_[static_cast<size_t>(n.dst)];
          made.renamed = shape.dst;
          made.kind = shape.kind;
          continue;
        }
      }
      for (int32_t* v : {&n.a, &n.b, &n.c, &n.dst, &n.second}) {
        if (*v < 0) continue;
        Value& value = values_[static_cast<size_t>(*v)];
        if (value.renamed < 0) value.renamed = values++;
        *v = value.renamed;
      }
      n.order = static_cast<uint32_t>(kept);
      nodes_[kept++] = n;
    }
    nodes_.resize(kept);
    values_.assign(static_cast<size_t>(values), {});
  }

  const ProgramView& program_;
  std::pmr::vector<Node>& nodes_;
  std::pmr::vector<Value>& values_;
};

}  // namespace

void fuseNodes(const ProgramView& program, TapeScratch& scratch) { Fuser(program, scratch).run(); }

}  // namespace sgm
