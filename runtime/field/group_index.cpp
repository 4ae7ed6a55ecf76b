#include "field/group_index.h"

#include <algorithm>
#include <numeric>

namespace sgm {

namespace {
constexpr uint32_t kLeafGroups = 8;
}

GroupIndex::GroupIndex(const GrammarChunk& chunk, std::pmr::memory_resource* memory)
    : nodes_(memory), order_(memory), bounds_(memory) {
  order_.resize(chunk.groups.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build(chunk, 0, static_cast<uint32_t>(order_.size()));
  bounds_.reserve(order_.size());
  for (uint32_t g : order_) bounds_.push_back(chunk.groups[g].bounds);
}

uint32_t GroupIndex::build(const GrammarChunk& chunk, uint32_t first, uint32_t count) {
  const uint32_t self = static_cast<uint32_t>(nodes_.size());
  IntBox bounds;
  for (uint32_t i = first; i < first + count; ++i) bounds = bounds.joined(chunk.groups[order_[i]].bounds);
  nodes_.push_back({bounds, first, count, 0});
  if (count <= kLeafGroups) return self;

  // Splits at the median along the longest axis of the bounds, so that the depth of the tree is below 32.
  int axis = 0;
  auto extent = [&](int a) { return int64_t{bounds.hi[a]} - bounds.lo[a]; };
  for (int a = 1; a < 3; ++a) axis = extent(a) > extent(axis) ? a : axis;
  auto middle = [&](uint32_t g) {
    const IntBox& b = chunk.groups[g].bounds;
    return int64_t{b.lo[axis]} + b.hi[axis];
  };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](uint32_t a, uint32_t b) { return middle(a) != middle(b) ? middle(a) < middle(b) : a < b; });
  nodes_[self].count = 0;
  build(chunk, first, count / 2);
  const uint32_t right = build(chunk, first + count / 2, count - count / 2);
  nodes_[self].right = right;
  return self;
}

void GroupIndex::query(const IntBox& box, std::pmr::vector<uint32_t>& groups) const {
  const size_t start = groups.size();
  uint32_t stack[64];
  size_t depth = 0;
  if (!nodes_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (!node.bounds.meets(box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.right;
      stack[depth++] = at + 1;
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (bounds_[i].meets(box)) groups.push_back(order_[i]);
    }
  }
  std::sort(groups.begin() + static_cast<std::ptrdiff_t>(start), groups.end());
}

}  // namespace sgm
