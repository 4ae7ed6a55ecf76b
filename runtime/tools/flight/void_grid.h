#pragma once
// Samples a field on a grid, on demand, and searches for paths of a flight through its void.

#include <sgm/sgm.h>

#include <array>
#include <bitset>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/fixed.h"
#include "base/result.h"

namespace sgm::cli {

struct PlaceHash {
  size_t operator()(const Int3& p) const;
};

/// Returns for each point, in units, whether it is solid at level 0. Errors: those of sgm_field_sample.
Result<std::vector<bool>> solidAt(sgm_field* field, std::span<const Int3> points);

/// A grid of nodes. Node (x, y, z) lies at (x, y, z) times the step, plus five eighths of a step on each axis. The
/// offset keeps nodes off the surfaces of walls and floors, which often lie on whole metres: a point exactly on a
/// surface counts as void. A node is clear if it and its 26 neighbours are in the void. The field must outlive the
/// grid. After an error no node is clear.
class VoidGrid {
 public:
  VoidGrid(sgm_field* field, int32_t step) : field_(field), step_(step) {}

  int32_t step() const { return step_; }
  Int3 placeOf(Int3 node) const;
  Int3 nodeAt(Int3 place) const;

  bool isClear(Int3 node);
  /// Marks a node as not clear until unblock() is called. Serves for obstacles near a node that are too thin for the
  /// grid to detect.
  void block(Int3 node) { blocked_.insert(node); }
  void unblock() { blocked_.clear(); }
  /// The clear node that is nearest to `node`, at most `radius` steps away on each axis; nullopt if there is none.
  std::optional<Int3> nearestClear(Int3 node, int radius);

  const std::optional<Error>& error() const { return error_; }

 private:
  /// Number of nodes along each axis of a block. All nodes of a block are sampled together.
  static constexpr int kBlock = 16;
  using Block = std::bitset<kBlock * kBlock * kBlock>;
  const Block& blockAt(Int3 at);

  sgm_field* field_;
  int32_t step_;
  std::unordered_map<Int3, Block, PlaceHash> blocks_;
  const Block* latest_ = nullptr;
  Int3 latest_at_;
  std::unordered_set<Int3, PlaceHash> blocked_;
  std::optional<Error> error_;
};

/// An A* search over clear nodes from a start node: it visits the nodes in the order of their path cost plus the
/// estimated remaining cost.
class VoidSearch {
 public:
  /// guess: estimates the remaining cost from a node, in tenths of a step; null: the estimate is 0 everywhere, so that
  /// all paths are optimal. A step beside a wall costs twice its length. visit: called with each node when it is
  /// reached; returns false to stop. The search ends after `most` nodes.
  VoidSearch(VoidGrid& grid, Int3 from, size_t most, const std::function<int64_t(Int3)>& guess,
             const std::function<bool(Int3 node, int64_t cost)>& visit);

  /// The path from the start to a visited node, including both ends.
  std::vector<Int3> wayTo(Int3 node) const;

 private:
  struct Reached {
    int64_t cost = 0;
    Int3 from;
    bool done = false;
  };
  std::unordered_map<Int3, Reached, PlaceHash> reached_;
};

}  // namespace sgm::cli
