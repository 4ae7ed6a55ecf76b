#pragma once
// The brushes that show at one moment, found by place. Snapshots share what did not change between them.

#include <memory>
#include <memory_resource>
#include <vector>

#include "world/edit_operation.h"

namespace sgm {

/// Immutable and cheap to copy; any thread. with() and without() copy the way from the root of an octree to one node,
/// some twenty nodes, whatever the number of brushes. The memory must be thread-safe, and outlive all snapshots made
/// from this one.
class EditSnapshot {
 public:
  explicit EditSnapshot(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : memory_(memory) {}

  /// Appends, in order, the brushes that show where cells have this edge (brushShows) and whose bounds meet the box.
  void query(const IntBox& box, int32_t cell, std::pmr::vector<Brush>& brushes) const;

  size_t brushes() const;
  /// Holds what every brush changes.
  IntBox bounds() const;

  /// Precondition: the brush was checked; it is not there, or it is. Snapshots made under one batch, any number but 0,
  /// may share even what changes, which makes many changes cheap: only the last of them is right, and no other may have
  /// been handed out. A number serves one batch.
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
