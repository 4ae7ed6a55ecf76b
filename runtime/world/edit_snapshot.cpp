#include "world/edit_snapshot.h"

#include <algorithm>
#include <array>

namespace sgm {

namespace {

// Octree levels of the root and of the leaves: the edge of a node is 2^level units.
constexpr int kWorldLevel = 32, kLeafLevel = 12;

// Returns the deepest octree level whose nodes are not shorter than the box. A brush is stored in the node of this
// level that contains the middle of the brush. So the brush extends at most half of the node's edge beyond the node.
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
  std::pmr::vector<Entry> entries;  ///< brushes of this node, sorted by EditOrder
  IntBox bounds;                    ///< bounds of all brushes in this node and below
  size_t count = 0;                 ///< number of brushes in this node and below
  uint64_t batch = 0;               ///< number of the batch of changes that created the node; 0: none

  explicit Node(std::pmr::memory_resource* memory) : entries(memory) {}
  Node(const Node& other, std::pmr::memory_resource* memory)
      : children(other.children), entries(other.entries, memory) {}

  void sum() {
    count = entries.size();
    bounds = {};
    for (const Entry& e : entries) bounds = bounds.joined(e.bounds);
    for (const NodePtr& child : children) {
      if (!child) continue;
      count += child->count;
      bounds = bounds.joined(child->bounds);
    }
  }
};

struct EditSnapshot::Change {
  Entry entry;
  bool add;
  uint64_t batch;
  int home = homeLevel(entry.bounds);
};

EditSnapshot::NodePtr EditSnapshot::changed(const NodePtr& node, int level, const Change& change) const {
  const std::pmr::polymorphic_allocator<Node> allocator(memory_);
  // A node that was created by this batch is not part of any other snapshot in use, so it may be changed.
  const bool ours = node && change.batch != 0 && node->batch == change.batch;
  const std::shared_ptr<Node> own = ours   ? std::const_pointer_cast<Node>(node)
                                    : node ? std::allocate_shared<Node>(allocator, *node, memory_)
                                           : std::allocate_shared<Node>(allocator, memory_);
  if (level > change.home) {
    NodePtr& child = own->children[childOfMiddle(change.entry.bounds, level)];
    child = changed(child, level - 1, change);
  } else {
    const auto at = std::lower_bound(own->entries.begin(), own->entries.end(), change.entry,
                                     [](const Entry& a, const Entry& b) { return a.order < b.order; });
    if (change.add) {
      own->entries.insert(at, change.entry);
    } else {
      own->entries.erase(at);
    }
  }
  own->batch = change.batch;
  own->sum();
  return own->count > 0 ? own : nullptr;
}

EditSnapshot EditSnapshot::changed(const Change& change) const {
  EditSnapshot result(memory_);
  result.root_ = changed(root_, kWorldLevel, change);
  return result;
}

EditSnapshot EditSnapshot::with(const EditOrder& order, const Brush& brush, uint64_t batch) const {
  return changed(Change{{order, brushBounds(brush), brush}, true, batch});
}

EditSnapshot EditSnapshot::without(const EditOrder& order, const Brush& brush, uint64_t batch) const {
  return changed(Change{{order, brushBounds(brush), brush}, false, batch});
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
