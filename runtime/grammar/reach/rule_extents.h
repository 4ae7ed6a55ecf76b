#pragma once
// Caches the extents of uses of rules: a use is evaluated once for each combination of the conditions on which its
// extent depends.

#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/range/reach_values.h"

namespace sgm::reach {

/// The cache of extents, and the path. The path is the stack of the uses of rules that enclose the current statement.
class RuleExtents {
 public:
  explicit RuleExtents(const Program& program);

  /// The conditions on which the extent of a use may depend.
  struct Key {
    uint32_t rule = 0;
    bool top = false;  ///< the use is the layer's start, where a cut applies to the domain
    /// bounds of the arguments and the scope; then, for a scaled key, the scale; then, for a placed key, the place
    std::vector<double> ranges;
    /// rules on the path that have a `depth` limit, each with its number of activations
    std::vector<std::pair<uint32_t, uint32_t>> counts;
    std::vector<uint32_t> overrides;  ///< OverrideExtents::key

    friend auto operator<=>(const Key&, const Key&) = default;
  };

  /// The keys of one use: plain, for an extent that depends neither on scale nor place; scaled, if it depends on the
  /// scale; placed, if it depends on the place.
  struct Use {
    Key plain, scaled, placed;
  };

  /// caller: the frame of the call. The rule starts with the scope and the place of this frame.
  Use describe(uint32_t rule, bool top, std::span<const RangeValue> args, const RangeFrame& caller,
               std::vector<uint32_t> overrides) const;

  /// Clears the cache, but not the path.
  void clear();
  /// Returns the cached extent, or nullptr if the use is not evaluated yet. Adds the conditions on which the cached
  /// extent depends to `dependence`.
  const Extent* find(const Use& use, Dependence& dependence) const;

  /// Pushes a use onto the path. Returns false, without effect, if an equal use is already on the path: a recursion
  /// with the same ranges has no bound. Uses that differ only in their place are equal, since a move alone does not
  /// bring a recursion closer to its end.
  bool begin(const Use& use);
  /// Pops a use from the path, and caches the extent of the use. The key for the cache (plain, scaled or placed) is
  /// chosen by `dependence`.
  void end(const Use& use, Dependence dependence, const Extent& extent);

  /// The number of uses of the rule on the path.
  uint32_t activations(uint32_t rule) const { return active_[rule]; }
  /// Whether the path contains only the layer's start rule.
  bool isInOwnRule() const { return path_length_ == 1; }

 private:
  /// extents that depend on neither scale nor place (plain_), on the scale (scaled_), or on the place (placed_)
  std::map<Key, Extent> plain_, scaled_, placed_;
  std::set<Key> open_;  ///< the keys Use::scaled of the uses on the path
  uint32_t path_length_ = 0;
  std::vector<uint32_t> active_;  ///< for each rule: number of uses of the rule on the path
  /// for each rule: true if the rule has a `depth` limit; then its number of uses on the path is a part of the key
  std::vector<bool> counted_;
  std::map<uint32_t, uint32_t> counts_;  ///< number of uses on the path, for each rule with a `depth` limit
};

}  // namespace sgm::reach
