#include "derive/chunk_ops.h"

#include "derive/hasher.h"

namespace sgm {
namespace {

/// Hashes members in their order in memory. References to other elements are hashed as indices.
class PlaceHasher {
 public:
  template <class T>
  void value(const T& v) {
    hasher_.add(v);
  }
  void labels(ShapeKind kind, uint16_t material, uint16_t tag) {
    value(uint64_t{static_cast<uint8_t>(kind)} | uint64_t{material} << 8 | uint64_t{tag} << 24);
  }
  void names(uint16_t kind, uint16_t name, uint16_t tag) {
    value(uint64_t{kind} | uint64_t{name} << 16 | uint64_t{tag} << 32);
  }
  void key(PathKey key) { value(key.value); }
  void children(uint32_t first, uint32_t count) { value(uint64_t{first} | uint64_t{count} << 32); }
  void points(uint32_t first, uint32_t count) { value(uint64_t{first} | uint64_t{count} << 32); }
  void expr(uint32_t root) { value(root); }
  void operand(uint32_t operand) { value(operand); }
  void noise(uint32_t noise) { value(noise); }
  void block(uint32_t block) {
    if (block != kNone) value(block);
  }
  uint64_t hash() const { return hasher_.value(); }

 private:
  Hasher hasher_;
};

}  // namespace

void translate(GrammarChunk& chunk, Int3 offset) {
  const auto move = [&](Int3& p) { p = saturatingAdd(p, offset); };
  for (Shape& s : chunk.shapes) {
    // Shapes that combine other shapes have no position of their own. Their children have positions, and are moved by
    // themselves.
    if (s.kind < ShapeKind::unite || s.kind == ShapeKind::morph_power || s.kind == ShapeKind::voxels) {
      move(s.frame.origin);
    }
    // The points of a prism are relative to its frame, so they do not move. The points of a sweep are world
    // coordinates, in shapes as well as in expressions, so they move.
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
  PlaceHasher h;
  h.value(chunk.layer);
  h.value(chunk.cell);
  h.value(uint64_t{chunk.shapes.size()});
  for (const Shape& s : chunk.shapes) visitMembers(s, h);
  for (uint32_t c : chunk.children) h.value(c);
  h.value(uint64_t{chunk.exprs.size()});
  for (const Expr& e : chunk.exprs) visitMembers(e, h);
  for (const NoiseSpec& n : chunk.noises) visitMembers(n, h);
  for (const Int3& p : chunk.points) h.value(p);
  for (const VoxelBlock& b : chunk.blocks) visitMembers(b, h);
  for (const uint64_t word : chunk.voxels) h.value(word);
  h.value(uint64_t{chunk.groups.size()});
  for (const Group& g : chunk.groups) {
    h.value(uint64_t{g.root} | uint64_t{g.cut ? 1u : 0u} << 32);
    h.value(g.bounds.lo);
    h.value(g.bounds.hi);
    h.key(g.key);
  }
  for (const Anchor& a : chunk.anchors) visitMembers(a, h);
  return h.hash();
}

}  // namespace sgm
