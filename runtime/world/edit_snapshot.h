#pragma once
// The set of brushes that are visible at one moment, searchable by position. Snapshots share their unchanged parts.

#include <memory>
#include <memory_resource>
#include <vector>

#include "world/edit_operation.h"

namespace sgm {

/// Immutable, cheap to copy, and usable by any thread. with() and without() copy only the path from the root of an
/// octree to one node, about twenty nodes, regardless of the number of brushes. The memory resource must be thread-safe
/// and outlive all snapshots derived from this one.
class EditSnapshot {
 public:
  explicit EditSnapshot(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : memory_(memory) {}

  /// Appends, in the order of EditOrder, the brushes whose bounds meet the box and that are large enough to show at
  /// cells with the edge `cell`, in units (brushShows).
  void query(const IntBox& box, int32_t cell, std::pmr::vector<Brush>& brushes) const;

  size_t brushes() const;
  /// Returns the bounding box of everything that the brushes change.
  IntBox bounds() const;

  /// with() returns a snapshot with one additional brush; without() returns a snapshot from which a brush is removed.
  /// Precondition: the brush was checked, and is absent (with) or present (without).
  ///
  /// A series of changes is cheap if all of them use the same batch number, other than 0. The snapshots of a series may
  /// then share even changed nodes: only the last snapshot is valid, and earlier ones must not be used elsewhere. Use
  /// each number for one series only.
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
