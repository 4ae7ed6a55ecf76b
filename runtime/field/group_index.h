#pragma once
// A bounding volume hierarchy over a grammar chunk's groups: finds the groups near a mesh chunk without a scan of all
// shapes of the cell.

#include <memory_resource>
#include <vector>

#include "derive/shape.h"

namespace sgm {

class GroupIndex {
 public:
  explicit GroupIndex(const GrammarChunk& chunk, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  /// Appends the indices of all groups whose bounds meet the box, in ascending order.
  void query(const IntBox& box, std::pmr::vector<uint32_t>& groups) const;

 private:
  struct Node {
    IntBox bounds;
    uint32_t first = 0, count = 0;  ///< for a leaf of the hierarchy: its range of indices in order_
    uint32_t right = 0;             ///< index of the right child; the left child follows its parent
  };
  uint32_t build(const GrammarChunk& chunk, uint32_t first, uint32_t count);

  std::pmr::vector<Node> nodes_;
  std::pmr::vector<uint32_t> order_;
  std::pmr::vector<IntBox> bounds_;  ///< bounds of the groups, in the order of order_
};

}  // namespace sgm
