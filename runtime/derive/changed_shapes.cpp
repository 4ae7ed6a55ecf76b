#include "derive/changed_shapes.h"

#include <algorithm>

#include "derive/hasher.h"

namespace sgm {
namespace {

/// A hash of a shape's content, which does not depend on the memory layout, and the range of cell edges (units) of the
/// levels of detail that show the shape.
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

/// Hashes shapes, expressions and anchors. A reference contributes the hash of the content that it refers to, not an
/// index. A shape contributes its own numbers first, then its points, voxels, expressions and children.
class Signer {
 public:
  explicit Signer(const CellContent& cell) : program_(cell.program), chunk_(*cell.chunk), exprs_(chunk_.exprs.size()) {
    // Operands precede the expressions that use them, so their hashes are computed first.
    for (size_t i = 0; i < exprs_.size(); ++i) {
      Content content(*this);
      visitMembers(chunk_.exprs[i], content);
      exprs_[i] = content.hash();
    }
  }

  Signature sign(const Shape& s) const {
    ShapeContent content(*this);
    visitMembers(s, content);
    content.addReferences(s.kind);
    Signature signature;
    if (s.child_count > 0) {
      signature.finest_cell = std::numeric_limits<int32_t>::max();
      signature.coarsest_cell = 0;
    }
    for (uint32_t i = 0; i < s.child_count; ++i) {
      const Signature child = sign(chunk_.shapes[chunk_.children[s.first_child + i]]);
      content.value(child.hash);
      signature.finest_cell = std::min(signature.finest_cell, child.finest_cell);
      signature.coarsest_cell = std::max(signature.coarsest_cell, child.coarsest_cell);
    }
    if (s.detail != 0) signature.coarsest_cell = std::min(signature.coarsest_cell, s.detail);
    signature.finest_cell = std::max(signature.finest_cell, s.coarsest);
    signature.hash = content.hash();
    return signature;
  }

  Entry entryOf(const Group& group) const {
    const Signature root = sign(chunk_.shapes[group.root]);
    return {group.key, group.cut, root.hash, {group.bounds, root.finest_cell, root.coarsest_cell, false}};
  }

  Entry entryOf(const Anchor& anchor) const {
    Content content(*this);
    visitMembers(anchor, content);
    ChangedShape place{{anchor.frame.origin, anchor.frame.origin}};
    place.anchor = true;
    return {anchor.key, false, content.hash(), place};
  }

 private:
  class Content {
   public:
    explicit Content(const Signer& signer) : signer_(signer) {}

    template <class T>
    void value(const T& v) {
      hasher_.add(v);
    }
    void names(uint16_t kind, uint16_t name, uint16_t tag) {
      value(uint64_t{kind} | uint64_t{name} << 16 | uint64_t{tag} << 32);
      text(signer_.program_.names[kind]);
      text(signer_.program_.names[name]);
      text(signer_.program_.tags[tag]);
    }
    void key(PathKey) {}  // not hashed, since Entry::key is compared separately
    void operand(uint32_t operand) { value(operand == kNone ? 0 : signer_.exprs_[operand]); }
    void noise(uint32_t noise) {
      if (noise != kNone) visitMembers(signer_.chunk_.noises[noise], *this);
    }
    void points(uint32_t first, uint32_t count) {
      value(count);
      for (uint32_t i = 0; i < count; ++i) value(signer_.chunk_.points[first + i]);
    }
    uint64_t hash() const { return hasher_.value(); }

   protected:
    void text(std::string_view text) { value(hashText(text)); }

    const Signer& signer_;

   private:
    Hasher hasher_;
  };

  class ShapeContent : public Content {
   public:
    using Content::Content;

    void labels(ShapeKind kind, uint16_t material, uint16_t tag) {
      value(uint64_t{static_cast<uint8_t>(kind)} | uint64_t{material} << 8 | uint64_t{tag} << 24);
      text(signer_.program_.materials[material]);
      text(signer_.program_.tags[tag]);
    }
    void children(uint32_t, uint32_t) {}  // does nothing: sign() adds the children's hashes
    void points(uint32_t first, uint32_t count) { first_point_ = first, point_count_ = count; }
    void expr(uint32_t root) { expr_ = root; }
    void block(uint32_t block) { block_ = block; }

    void addReferences(ShapeKind kind) {
      Content::points(first_point_, point_count_);
      if (block_ != kNone) {
        const VoxelBlock& block = signer_.chunk_.blocks[block_];
        visitMembers(block, *this);
        for (size_t i = 0; i < block.words(); ++i) value(signer_.chunk_.voxels[block.first_word + i]);
      }
      const uint32_t read = expr_ == kNone ? 0 : kind == ShapeKind::warp ? 3 : 1;
      for (uint32_t i = 0; i < read; ++i) value(signer_.exprs_[expr_ + i]);
    }

   private:
    uint32_t first_point_ = 0, point_count_ = 0, expr_ = kNone, block_ = kNone;
  };

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
