#pragma once
// A spatial index of viewers. It finds a chunk's urgency and distance without a test of all viewers.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/plan/viewer.h"

namespace sgm {

/// Immutable: a hierarchy of boxes around the viewers' paths during kLookAhead.
class ViewerIndex {
 public:
  ViewerIndex(std::span<const Viewer> viewers, const LodSettings& settings, double all_around = 0);

  bool empty() const { return seen_.empty(); }
  /// Returns the smallest urgencyFor() of all viewers; infinite without viewers.
  double urgency(const ChunkKey& key) const;
  /// Returns the distance in units from the chunk's box to the nearest viewer; infinite without viewers.
  double distance(const ChunkKey& key) const;

 private:
  struct Node {
    std::array<double, 3> low, high;  ///< bounds of the viewers' paths
    double reach;                     ///< the largest reach of the node's viewers
    uint32_t first, count;            ///< range of the node's viewers
    uint32_t second_child;            ///< index; the first child follows its parent; 0: the node is a leaf
  };
  uint32_t build(uint32_t first, uint32_t count);
  /// Returns the smallest `value` of any viewer. bound(node): returns a lower bound for the viewers in the node.
  template <class Bound, class Value>
  double least(const Bound& bound, const Value& value) const;

  LodSettings settings_;
  double all_around_;
  std::vector<SeenBy> seen_;
  std::vector<Node> nodes_;
};

}  // namespace sgm
