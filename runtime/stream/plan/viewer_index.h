#pragma once
// Viewers by place: how urgent a chunk is, and how far from a viewer, without a look at all of them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/plan/viewer.h"

namespace sgm {

/// Immutable: boxes within boxes around the ways that viewers will have gone in kLookAhead.
class ViewerIndex {
 public:
  ViewerIndex(std::span<const Viewer> viewers, const LodSettings& settings, double all_around = 0);

  bool empty() const { return seen_.empty(); }
  /// That of the viewer to whom the chunk is most urgent: the least of all urgencyFor(). Infinite without viewers.
  double urgency(const ChunkKey& key) const;
  /// Units from the chunk's box to the nearest viewer; infinite without viewers.
  double distance(const ChunkKey& key) const;

 private:
  struct Node {
    std::array<double, 3> low, high;  ///< of the ways
    double reach;                     ///< the largest
    uint32_t first, count;            ///< viewers
    uint32_t second_child;            ///< the first one follows the node; 0: none
  };
  uint32_t build(uint32_t first, uint32_t count);
  /// The least of what `value` gives for a viewer. bound(node): no more than that for any viewer in the node.
  template <class Bound, class Value>
  double least(const Bound& bound, const Value& value) const;

  LodSettings settings_;
  double all_around_;
  std::vector<SeenBy> seen_;
  std::vector<Node> nodes_;
};

}  // namespace sgm
