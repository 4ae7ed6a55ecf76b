#include "derive/chunk_ops.h"

#include "derive/hasher.h"

namespace sgm {
namespace {

void addShape(Hasher& h, const Shape& s) {
  h.add(uint64_t{static_cast<uint8_t>(s.kind)} | uint64_t{s.material} << 8 | uint64_t{s.tag} << 24);
  h.add(uint64_t{s.first_child} | uint64_t{s.child_count} << 32);
  h.add(uint64_t{s.first_point} | uint64_t{s.point_count} << 32);
  h.add(s.expr);
  h.add(s.detail);
  h.add(s.coarsest);
  h.add(s.amount);
  h.add(s.inner_radius);
  for (float v : s.size) h.add(v);
  h.add(s.frame);
  if (s.block != kNone) h.add(s.block);
}

void addExpr(Hasher& h, const Expr& e) {
  h.add(uint64_t{static_cast<uint8_t>(e.op)});
  h.add(e.a);
  h.add(e.b);
  h.add(e.c);
  h.add(e.value);
  h.add(e.anchor);
  for (float v : e.row) h.add(v);
  h.add(e.noise);
  h.add(uint64_t{e.first_point} | uint64_t{e.point_count} << 32);
}

}  // namespace

void translate(GrammarChunk& chunk, Int3 offset) {
  const auto move = [&](Int3& p) { p = saturatingAdd(p, offset); };
  for (Shape& s : chunk.shapes) {
    // Combiners have no position of their own.
    if (s.kind < ShapeKind::unite || s.kind == ShapeKind::morph_power || s.kind == ShapeKind::voxels) {
      move(s.frame.origin);
    }
    // A prism's points are local; a sweep's are in the world, both here and in expressions.
    for (uint32_t i = 0; s.kind != ShapeKind::prism && i < s.point_count; ++i) move(chunk.points[s.first_point + i]);
  }
  for (VoxelBlock& b : chunk.blocks) move(b.anchor);
  for (Expr& e : chunk.exprs) {
    if (e.op == ExprOp::coordinate) move(e.anchor);
    for (uint32_t i = 0; i < e.point_count; ++i) move(chunk.points[e.first_point + i]);
  }
  for (NoiseSpec& n : chunk.noises) move(n.origin);
  for (Group& g : chunk.groups) {
    if (g.bounds.empty()) continue;
    move(g.bounds.lo);
    move(g.bounds.hi);
  }
  for (Anchor& a : chunk.anchors) move(a.frame.origin);
}

uint64_t hashChunk(const GrammarChunk& chunk) {
  Hasher h;
  h.add(chunk.layer);
  h.add(chunk.cell);
  h.add(uint64_t{chunk.shapes.size()});
  for (const Shape& s : chunk.shapes) addShape(h, s);
  for (uint32_t c : chunk.children) h.add(c);
  h.add(uint64_t{chunk.exprs.size()});
  for (const Expr& e : chunk.exprs) addExpr(h, e);
  for (const NoiseSpec& n : chunk.noises) {
    h.add(n.origin);
    h.add(n.period);
    h.add(uint64_t{n.octaves} | uint64_t{n.seed} << 32);
  }
  for (const Int3& p : chunk.points) h.add(p);
  for (const VoxelBlock& b : chunk.blocks) {
    h.add(b.anchor);
    h.add(b.edge);
    h.add(b.first);
    h.add(b.count);
  }
  for (const uint64_t word : chunk.voxels) h.add(word);
  h.add(uint64_t{chunk.groups.size()});
  for (const Group& g : chunk.groups) {
    h.add(uint64_t{g.root} | uint64_t{g.cut ? 1u : 0u} << 32);
    h.add(g.bounds.lo);
    h.add(g.bounds.hi);
    h.add(g.key.value);
  }
  for (const Anchor& a : chunk.anchors) {
    h.add(a.frame);
    h.add(uint64_t{a.kind} | uint64_t{a.name} << 16 | uint64_t{a.tag} << 32);
    h.add(a.key.value);
  }
  return h.value();
}

}  // namespace sgm
