#pragma once
// Interval pruning (Keeter 2020): reduces a program to the part that matters in a box of positions. Every sample and
// every attribute in the box keeps its bits, because an operand is dropped only if it provably changes none of them.

#include "field/interval.h"

namespace sgm {

/// The result of pruning. Its `params` refer to the words of the program that was pruned, so that program must outlive
/// it. Can be reused for several boxes, to save allocations.
struct PrunedProgram {
  std::pmr::vector<Instr> instrs;
  std::pmr::vector<ProgramGroup> groups;
  std::span<const uint32_t> params;
  float initial = kFar;
  uint32_t initial_label = 0;
  float q_scale = 1;
  FloatInterval field;  ///< bounds of the field over the box, units

  explicit PrunedProgram(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : instrs(memory), groups(memory) {}

  ProgramView view() const { return {instrs, params, groups, initial, initial_label, q_scale}; }
  /// solid(): true if the bounds prove that all samples of the box are quantised to solid values; empty(): true if they
  /// prove the same for void values.
  bool solid() const { return field.hi * static_cast<double>(q_scale) < -0.51; }
  bool empty() const { return field.lo * static_cast<double>(q_scale) > -0.49; }
};

/// Scratch memory of one thread.
class PruneScratch {
 public:
  explicit PruneScratch(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : marks(memory), bounds(memory), reversed(memory) {}
  struct GroupBounds {
    FloatInterval value;
    bool met, whole, live;
  };
  /// one per instruction: intermediate bounds, by which prune_kernel.inl decides whether to keep the instruction
  std::pmr::vector<FloatInterval> marks;
  std::pmr::vector<GroupBounds> bounds;
  std::pmr::vector<Instr> reversed;
};

/// How to treat a program that is proven to be solid, or proven to be void, everywhere in the box: drop all
/// instructions, or keep those that affect the exact values.
enum class Uniform { drop, keep };

/// Prunes `program` to a closed box, which must contain all positions that will be sampled. `program` must not be a
/// view of `out`.
void prune(const ProgramView& program, const IntBox& box, PruneScratch& scratch, PrunedProgram& out,
           Uniform uniform = Uniform::drop);

}  // namespace sgm
