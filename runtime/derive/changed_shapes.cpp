#include "derive/changed_shapes.h"

#include <algorithm>

#include "derive/hasher.h"

namespace sgm {
namespace {

/// A shape's content, independent of the memory positions of its parts, and the levels that show it.
struct Signature {
  uint64_t hash = 0;
  int32_t finest_cell = 0, coarsest_cell = std::numeric_limits<int32_t>::max();
};

struct Entry {
  PathKey key;
  bool cut = false;
  uint64_t hash = 0;
  ChangedShape shape;

  bool before(const Entry& other) const {
    if (key.value != other.key.value) return key.value < other.key.value;
    if (shape.anchor != other.shape.anchor) return other.shape.anchor;
    if (cut != other.cut) return other.cut;
    return hash < other.hash;
  }
};

class Signer {
 public:
  explicit Signer(const CellContent& cell) : program_(cell.program), chunk_(*cell.chunk), exprs_(chunk_.exprs.size()) {
    // Operands precede the expressions that use them.
    for (size_t i = 0; i < exprs_.size(); ++i) exprs_[i] = hashOf(chunk_.exprs[i]);
  }

  Signature sign(const Shape& s) const {
    Hasher h;
    h.add(uint64_t{static_cast<uint8_t>(s.kind)} | uint64_t{s.material} << 8 | uint64_t{s.tag} << 24);
    h.add(hashText(program_.materials[s.material]));
    h.add(hashText(program_.tags[s.tag]));
    h.add(s.detail);
    h.add(s.coarsest);
    h.add(s.amount);
    h.add(s.inner_radius);
    for (float v : s.size) h.add(v);
    h.add(s.frame);
    addPoints(h, s.first_point, s.point_count);
    if (s.block != kNone) addVoxels(h, chunk_.blocks[s.block]);
    const uint32_t read = s.expr == kNone ? 0 : s.kind == ShapeKind::warp ? 3 : 1;
    for (uint32_t i = 0; i < read; ++i) h.add(exprs_[s.expr + i]);
    Signature signature;
    if (s.child_count > 0) {
      signature.finest_cell = std::numeric_limits<int32_t>::max();
      signature.coarsest_cell = 0;
    }
    for (uint32_t i = 0; i < s.child_count; ++i) {
      const Signature child = sign(chunk_.shapes[chunk_.children[s.first_child + i]]);
      h.add(child.hash);
      signature.finest_cell = std::min(signature.finest_cell, child.finest_cell);
      signature.coarsest_cell = std::max(signature.coarsest_cell, child.coarsest_cell);
    }
    if (s.detail != 0) signature.coarsest_cell = std::min(signature.coarsest_cell, s.detail);
    signature.finest_cell = std::max(signature.finest_cell, s.coarsest);
    signature.hash = h.value();
    return signature;
  }

  Entry entryOf(const Group& group) const {
    const Signature root = sign(chunk_.shapes[group.root]);
    return {group.key, group.cut, root.hash, {group.bounds, root.finest_cell, root.coarsest_cell, false}};
  }

  Entry entryOf(const Anchor& anchor) const {
    Hasher h;
    h.add(anchor.frame);
    h.add(uint64_t{anchor.kind} | uint64_t{anchor.name} << 16 | uint64_t{anchor.tag} << 32);
    h.add(hashText(program_.names[anchor.kind]));
    h.add(hashText(program_.names[anchor.name]));
    h.add(hashText(program_.tags[anchor.tag]));
    ChangedShape place{{anchor.frame.origin, anchor.frame.origin}};
    place.anchor = true;
    return {anchor.key, false, h.value(), place};
  }

 private:
  void addPoints(Hasher& h, uint32_t first, uint32_t count) const {
    h.add(count);
    for (uint32_t i = 0; i < count; ++i) h.add(chunk_.points[first + i]);
  }

  void addVoxels(Hasher& h, const VoxelBlock& block) const {
    h.add(block.anchor);
    h.add(block.edge);
    h.add(block.first);
    h.add(block.count);
    for (size_t i = 0; i < block.words(); ++i) h.add(chunk_.voxels[block.first_word + i]);
  }

  uint64_t hashOf(const Expr& e) const {
    Hasher h;
    h.add(uint64_t{static_cast<uint8_t>(e.op)});
    for (const uint32_t operand : {e.a, e.b, e.c}) h.add(operand == kNone ? 0 : exprs_[operand]);
    h.add(e.value);
    h.add(e.anchor);
    for (float v : e.row) h.add(v);
    if (e.noise != kNone) {
      const NoiseSpec& noise = chunk_.noises[e.noise];
      h.add(noise.origin);
      h.add(noise.period);
      h.add(uint64_t{noise.octaves} | uint64_t{noise.seed} << 32);
    }
    addPoints(h, e.first_point, e.point_count);
    return h.value();
  }

  const Program& program_;
  const GrammarChunk& chunk_;
  std::vector<uint64_t> exprs_;
};

std::vector<Entry> entriesOf(const CellContent& cell) {
  std::vector<Entry> entries;
  if (cell.chunk == nullptr) return entries;
  const Signer signer(cell);
  for (const Group& group : cell.chunk->groups) entries.push_back(signer.entryOf(group));
  for (const Anchor& anchor : cell.chunk->anchors) entries.push_back(signer.entryOf(anchor));
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.before(b); });
  return entries;
}

}  // namespace

std::vector<ChangedShape> changedShapes(const CellContent& before, const CellContent& after) {
  const std::vector<Entry> old = entriesOf(before), now = entriesOf(after);
  std::vector<ChangedShape> changed;
  auto a = old.begin(), b = now.begin();
  while (a != old.end() || b != now.end()) {
    const bool only_old = b == now.end() || (a != old.end() && a->before(*b));
    const bool only_now = a == old.end() || (b != now.end() && b->before(*a));
    if (only_old) changed.push_back(a->shape);
    if (only_now) changed.push_back(b->shape);
    if (!only_now) ++a;
    if (!only_old) ++b;
  }
  return changed;
}

}  // namespace sgm
