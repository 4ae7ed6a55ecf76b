#pragma once
// Overrides in the proof of reach: the places where they may apply, and the content of their blocks.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/range/range_value.h"

namespace sgm::reach {

struct ReachContext;

/// Owns the overrides that may apply to what is derived now, and the content that `inner` stands for.
class OverrideExtents {
 public:
  explicit OverrideExtents(const Program& program) : program_(program) {}

  /// The state of derivation with respect to overrides.
  struct State {
    std::vector<uint32_t> begun;   ///< by path: those whose first steps lead here, and that continue
    uint32_t depth = 0;            ///< number of these steps
    std::vector<uint32_t> within;  ///< by tag: those whose own block this is in
  };

  /// Sets the state for the start of a layer.
  void start(uint32_t layer);
  const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }
  /// Updates the state for a use of the rule. Returns the overrides by path that replace this use, as in
  /// Program::overrides; other paths continue.
  std::vector<uint32_t> enter(uint32_t rule);
  /// The part of the key that separates uses with the same arguments. replacing: from enter().
  std::vector<uint32_t> key(const std::vector<uint32_t>& replacing) const;

  /// The extent of a use of a rule: of its alternatives, or of the overrides that may replace it.
  Extent boundUse(uint32_t rule, const std::vector<RangeValue>& args, const std::vector<uint32_t>& replacing,
                  RangeFrame& frame, ReachContext& context);
  /// The extent of a block, a meet or an extrusion with the overrides of its tag.
  Extent boundTagged(const StmtNode& s, uint16_t tag, RangeFrame& frame, ReachContext& context);
  /// The extent of `inner` in an override's block.
  Extent boundInner(const StmtNode& s, const RangeFrame& frame, ReachContext& context);

 private:
  /// The target of overrides: a use of a rule, or a block with a tag.
  struct Target {
    uint32_t rule = 0;
    const std::vector<RangeValue>& args;
    const std::vector<uint32_t>& overrides;  ///< those that may apply, as in Program::overrides
    const StmtNode* block = nullptr;         ///< the block with the tag; null: a use of a rule
    const RangeFrame* frame = nullptr;       ///< of that block
    size_t at = 0;                           ///< index in `overrides` of the one whose block asks for the target
    State state;                             ///< state of what `inner` derives
    const Target* outer = nullptr;
  };

  /// The extent after the first `below` overrides; above: the override by path whose `inner` asks, or null.
  Extent boundTarget(const Target& target, size_t below, RangeFrame& frame, const Override* above,
                     ReachContext& context);
  /// The extent of the block of target.overrides[at] in place of the target.
  Extent boundReplacement(const Target& target, size_t at, const RangeFrame& place, ReachContext& context);

  const Program& program_;
  State state_;
  const Target* target_ = nullptr;  ///< in an override's block: the original content
};

}  // namespace sgm::reach
