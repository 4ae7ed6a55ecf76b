#pragma once
// Handles overrides in the proof of reach, which bounds how far shapes may extend beyond their cell: finds where they
// may apply, and evaluates their blocks.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/range/range_value.h"

namespace sgm::reach {

struct ReachContext;

/// Tracks the overrides that may apply to the current use, and the content for which `inner` stands.
class OverrideExtents {
 public:
  explicit OverrideExtents(const Program& program) : program_(program) {}

  /// The overrides that may apply at the current place of the derivation.
  struct State {
    /// overrides by path that may still apply further inside: the first `depth` steps of their paths lead to the
    /// current use, and the paths have further steps
    std::vector<uint32_t> begun;
    /// number of path steps that lead from the layer's start to the current use; 0 if `begun` is empty
    uint32_t depth = 0;
    /// overrides by tag that do not apply at the current place, because it lies within their own block
    std::vector<uint32_t> within;
  };

  /// Resets the state for the start of a layer.
  void start(uint32_t layer);
  const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }
  /// Advances the state by a use of `rule`. Returns the overrides whose path ends at this use, in the order of
  /// Program::overrides; paths with further steps stay in the state.
  std::vector<uint32_t> enter(uint32_t rule);
  /// Returns the part of RuleExtents::Key that depends on overrides. replacing: the result of enter().
  std::vector<uint32_t> key(const std::vector<uint32_t>& replacing) const;

  /// Returns the extent of a use of a rule. It encloses the rule's alternatives, and the blocks of the overrides that
  /// may replace the use.
  Extent boundUse(uint32_t rule, const std::vector<RangeValue>& args, const std::vector<uint32_t>& replacing,
                  RangeFrame& frame, ReachContext& context);
  /// Returns the extent of a block, a meet or an extrusion. It encloses the blocks of the overrides of the statement's
  /// tag, too.
  Extent boundTagged(const StmtNode& s, uint16_t tag, RangeFrame& frame, ReachContext& context);
  /// Returns the extent of `inner`, the replaced content, in an override's block.
  Extent boundInner(const StmtNode& s, const RangeFrame& frame, ReachContext& context);

 private:
  /// The content that overrides replace: a use of a rule, or a block with a tag.
  struct Target {
    uint32_t rule = 0;
    const std::vector<RangeValue>& args;
    /// the overrides that may apply to this content, in the order of Program::overrides
    const std::vector<uint32_t>& overrides;
    const StmtNode* block = nullptr;    ///< the tagged block; null: the target is a use of a rule
    const RangeFrame* frame = nullptr;  ///< the frame in which `block` is evaluated
    size_t at = 0;                      ///< index in `overrides` of the override whose block is currently evaluated
    State state;                        ///< the state in which `inner` is evaluated
    const Target* outer = nullptr;      ///< the enclosing target, if the blocks of overrides are nested; null: none
  };

  /// Returns the extent of the target as if only the first `below` of its overrides existed. above: the override by
  /// path whose block contains the `inner` that stands for the target; overrides that cannot apply together with
  /// `above` are left out. Null: no `inner` stands for the target, or the override around that `inner` is by tag.
  Extent boundTarget(const Target& target, size_t below, RangeFrame& frame, const Override* above,
                     ReachContext& context);
  /// Returns the extent of the block of target.overrides[at], which replaces the target.
  Extent boundReplacement(const Target& target, size_t at, const RangeFrame& place, ReachContext& context);

  const Program& program_;
  State state_;
  /// while an override's block is evaluated: the content that it replaces; otherwise null
  const Target* target_ = nullptr;
};

}  // namespace sgm::reach
