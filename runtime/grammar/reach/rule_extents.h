#pragma once
// The extents of rules: each use is evaluated once for all that its extent depends on.

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

/// Owns the extents of all uses of rules that were evaluated, and the uses on the path to the current statement.
class RuleExtents {
 public:
  explicit RuleExtents(const Program& program);

  /// The conditions on which the extent of a use depends.
  struct Key {
    uint32_t rule = 0;
    bool top = false;            ///< a cut in it applies to the domain
    std::vector<double> ranges;  ///< of arguments and scope; then of the scale; then of the place
    std::vector<std::pair<uint32_t, uint32_t>> counts;  ///< the active rules with a `depth`, and their activations
    std::vector<uint32_t> overrides;                    ///< OverrideExtents::key

    friend auto operator<=>(const Key&, const Key&) = default;
  };

  /// A use of a rule by three keys: if its extent depends neither on scale nor place, on the scale, and on the place.
  struct Use {
    Key plain, scaled, placed;
  };

  /// caller: the frame of the call, whose scope and place the rule gets.
  Use describe(uint32_t rule, bool top, std::span<const RangeValue> args, const RangeFrame& caller,
               std::vector<uint32_t> overrides) const;

  /// Forgets all extents. The path stays.
  void clear();
  /// nullptr if the use was not evaluated yet. Adds the dependence of a known extent to `dependence`.
  const Extent* find(const Use& use, Dependence& dependence) const;

  /// Adds a use to the path. Returns false, without effect, if the same one is on it: a recursion with the same ranges
  /// has no bound. The place does not count, since it makes no progress towards an end.
  bool begin(const Use& use);
  /// Removes a use from the path, and keeps its extent for uses that agree in all that it depends on.
  void end(const Use& use, Dependence dependence, const Extent& extent);

  /// The activations of a rule on the path.
  uint32_t activations(uint32_t rule) const { return active_[rule]; }
  /// Whether the path consists of the layer's own rule alone.
  bool isInOwnRule() const { return path_length_ == 1; }

 private:
  std::map<Key, Extent> plain_, scaled_, placed_;  ///< by what the evaluations depend on
  std::set<Key> open_;                             ///< the path, by scaled keys
  uint32_t path_length_ = 0;
  std::vector<uint32_t> active_;         ///< by rule: number of activations on the path
  std::vector<bool> counted_;            ///< by rule: whether the number of activations matters
  std::map<uint32_t, uint32_t> counts_;  ///< active ones of these
};

}  // namespace sgm::reach
