#pragma once
// A spatial index of viewers, which finds a chunk's urgency and distance without testing all viewers.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/plan/viewer.h"

namespace sgm {

/// A bounding-box hierarchy over the paths of viewers during kLookAhead. Immutable.
class ViewerIndex {
 public:
  ViewerIndex(std::span<const Viewer> viewers, const LodSettings& settings, double all_around = 0);

  bool empty() const { return seen_.empty(); }
  /// Returns the minimum of urgencyFor() over all viewers; infinite without viewers.
  double urgency(const ChunkKey& key) const;
  /// Returns the distance in units from the chunk's box to the nearest viewer; infinite without viewers.
  double distance(const ChunkKey& key) const;

 private:
  struct Node {
    std::array<double, 3> low, high;  ///< bounding box of the viewers' paths
    double reach;                     ///< largest LodViewer::reach (factor on distances) of the viewers in the node
    uint32_t first, count;            ///< range of the viewers in the node
    uint32_t second_child;            ///< index of the second child; the first child directly follows its parent. 0:
                                      ///< the node is a leaf
  };
  uint32_t build(uint32_t first, uint32_t count);
  /// Returns the minimum of value(viewer) over all viewers. bound(node): a lower bound of the values in a node; the
  /// node is skipped if the bound is above the minimum so far.
  template <class Bound, class Value>
  double least(const Bound& bound, const Value& value) const;

  LodSettings settings_;
  double all_around_;
  std::vector<SeenBy> seen_;
  std::vector<Node> nodes_;
};

}  // namespace sgm
