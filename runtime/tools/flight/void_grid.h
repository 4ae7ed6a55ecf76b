#pragma once
// Where there is room to fly: a grid of places in the void of a field, sampled as it is asked for, and ways through it.

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

/// Solid or void at points, in units, at level 0. Errors: those of sgm_field_sample.
Result<std::vector<bool>> solidAt(sgm_field* field, std::span<const Int3> points);

/// Node (x, y, z) lies at that times the step, and five eighths of one farther: walls and floors like to lie on whole
/// metres, where a node would be in the void on both sides. A node is clear where it and its 26 neighbours are in the
/// void. The field must outlive the grid. After an error nothing is clear any more.
class VoidGrid {
 public:
  VoidGrid(sgm_field* field, int32_t step) : field_(field), step_(step) {}

  int32_t step() const { return step_; }
  Int3 placeOf(Int3 node) const;
  Int3 nodeAt(Int3 place) const;

  bool isClear(Int3 node);
  /// Something too thin for the grid is in the way: the node is not clear until unblock().
  void block(Int3 node) { blocked_.insert(node); }
  void unblock() { blocked_.clear(); }
  /// The clear node nearest to this one, at most `radius` steps away on each axis.
  std::optional<Int3> nearestClear(Int3 node, int radius);

  const std::optional<Error>& error() const { return error_; }

 private:
  static constexpr int kBlock = 16;  ///< nodes on each axis that are sampled together
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

/// The nodes reached from one, nearest first.
class VoidSearch {
 public:
  /// `guess` of a node is about what is left of its way, in tenths of a step; null: 0 everywhere, and all ways are the
  /// cheapest. Along walls ways cost twice their length. `visit` is called with each node as it is reached, and returns
  /// false to stop. The search ends after `most` nodes.
  VoidSearch(VoidGrid& grid, Int3 from, size_t most, const std::function<int64_t(Int3)>& guess,
             const std::function<bool(Int3 node, int64_t cost)>& visit);

  /// The way to a node that was visited, both ends included.
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
