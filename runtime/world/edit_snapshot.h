#pragma once
// The brushes that are visible at one moment, searchable by place. Snapshots share their unchanged parts.

#include <memory>
#include <memory_resource>
#include <vector>

#include "world/edit_operation.h"

namespace sgm {

/// Immutable, cheap to copy and usable by any thread. with() and without() copy the path from the root of an octree to
/// one node, about twenty nodes, whatever the number of brushes. The memory must be thread-safe and outlive all
/// snapshots made from this one.
class EditSnapshot {
 public:
  explicit EditSnapshot(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : memory_(memory) {}

  /// Appends, in order, the brushes that are visible at cells of this edge (brushShows) and whose bounds meet the box.
  void query(const IntBox& box, int32_t cell, std::pmr::vector<Brush>& brushes) const;

  size_t brushes() const;
  /// A box around everything that the brushes change.
  IntBox bounds() const;

  /// Precondition: the brush was checked, and is absent (with) or present (without). Snapshots made under the same
  /// batch, a number other than 0, may share even changed nodes, which makes a series of changes cheap. Only the last
  /// of them is valid, and no earlier one may have been handed out. Use each number for one batch only.
  EditSnapshot with(const EditOrder& order, const Brush& brush, uint64_t batch = 0) const;
  EditSnapshot without(const EditOrder& order, const Brush& brush, uint64_t batch = 0) const;

 private:
  struct Entry {
    EditOrder order;
    IntBox bounds;
    Brush brush;
  };
  struct Node;
  using NodePtr = std::shared_ptr<const Node>;

  struct Change;

  NodePtr changed(const NodePtr& node, int level, const Change& change) const;
  EditSnapshot changed(const Change& change) const;
  static void collect(const Node& node, const IntBox& box, int32_t cell, std::pmr::vector<const Entry*>& found);

  NodePtr root_;
  std::pmr::memory_resource* memory_;
};

}  // namespace sgm
