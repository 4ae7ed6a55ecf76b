#include "stream/edit_snapshot.h"

#include <algorithm>
#include <array>

namespace sgm {

namespace {

// Levels of the octree: a node's edge is 2^level units.
constexpr int kWorldLevel = 32, kLeafLevel = 12;

// The deepest node that holds the box's middle and whose edge is no shorter than the box: so a brush stands in one
// node, and sticks out of it by half an edge at most.
int homeLevel(const IntBox& box) {
  int64_t longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, int64_t{box.hi[axis]} - box.lo[axis]);
  int level = kLeafLevel;
  while (int64_t{1} << level < longest) ++level;
  return level;
}

size_t childOfMiddle(const IntBox& box, int level) {
  size_t child = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t middle = (int64_t{box.lo[axis]} + box.hi[axis]) >> 1;
    child |= static_cast<size_t>((middle - INT32_MIN) >> (level - 1) & 1) << axis;
  }
  return child;
}

}  // namespace

struct EditSnapshot::Node {
  std::array<NodePtr, 8> children;
  std::pmr::vector<Entry> entries;  ///< by order
  IntBox bounds;                    ///< of all below
  size_t count = 0;                 ///< of all below

  explicit Node(std::pmr::memory_resource* memory) : entries(memory) {}
  Node(const Node& other, std::pmr::memory_resource* memory)
      : children(other.children), entries(other.entries, memory) {}

  void sum() {
    count = entries.size();
    for (const Entry& e : entries) bounds = bounds.joined(e.bounds);
    for (const NodePtr& child : children) {
      if (!child) continue;
      count += child->count;
      bounds = bounds.joined(child->bounds);
    }
  }
};

EditSnapshot::NodePtr EditSnapshot::changed(const NodePtr& node, int level, const Entry& entry, int home,
                                            bool add) const {
  const std::pmr::polymorphic_allocator<Node> allocator(memory_);
  const std::shared_ptr<Node> copy =
      node ? std::allocate_shared<Node>(allocator, *node, memory_) : std::allocate_shared<Node>(allocator, memory_);
  if (level > home) {
    NodePtr& child = copy->children[childOfMiddle(entry.bounds, level)];
    child = changed(child, level - 1, entry, home, add);
  } else {
    const auto at = std::lower_bound(copy->entries.begin(), copy->entries.end(), entry,
                                     [](const Entry& a, const Entry& b) { return a.order < b.order; });
    if (add) {
      copy->entries.insert(at, entry);
    } else {
      copy->entries.erase(at);
    }
  }
  copy->sum();
  return copy->count > 0 ? copy : nullptr;
}

EditSnapshot EditSnapshot::with(const EditOrder& order, const Brush& brush) const {
  const Entry entry{order, brushBounds(brush), brush};
  EditSnapshot result(memory_);
  result.root_ = changed(root_, kWorldLevel, entry, homeLevel(entry.bounds), true);
  return result;
}

EditSnapshot EditSnapshot::without(const EditOrder& order, const Brush& brush) const {
  const Entry entry{order, brushBounds(brush), brush};
  EditSnapshot result(memory_);
  result.root_ = changed(root_, kWorldLevel, entry, homeLevel(entry.bounds), false);
  return result;
}

void EditSnapshot::collect(const Node& node, const IntBox& box, int32_t cell, std::pmr::vector<const Entry*>& found) {
  if (!node.bounds.meets(box)) return;
  for (const Entry& e : node.entries) {
    if (e.bounds.meets(box) && brushShows(e.brush, cell)) found.push_back(&e);
  }
  for (const NodePtr& child : node.children) {
    if (child) collect(*child, box, cell, found);
  }
}

void EditSnapshot::query(const IntBox& box, int32_t cell, std::pmr::vector<Brush>& brushes) const {
  if (!root_) return;
  std::pmr::vector<const Entry*> found(memory_);
  collect(*root_, box, cell, found);
  std::sort(found.begin(), found.end(), [](const Entry* a, const Entry* b) { return a->order < b->order; });
  brushes.reserve(brushes.size() + found.size());
  for (const Entry* e : found) brushes.push_back(e->brush);
}

size_t EditSnapshot::brushes() const { return root_ ? root_->count : 0; }

IntBox EditSnapshot::bounds() const { return root_ ? root_->bounds : IntBox{}; }

}  // namespace sgm
