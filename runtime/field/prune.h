#pragma once
// Interval pruning (Keeter 2020): reduces a program to the part that matters in a box of positions. Every sample and
// every attribute in the box keeps its bits, because an operand is dropped only if it provably changes none of them.

#include "field/interval.h"

namespace sgm {

/// A pruned program. Reads its parent's parameters, which must outlive it; reused as scratch for several boxes.
struct PrunedProgram {
  std::pmr::vector<Instr> instrs;
  std::pmr::vector<ProgramGroup> groups;
  std::span<const uint32_t> params;
  float initial = kFar;
  uint32_t initial_label = 0;
  float q_scale = 1;
  Interval field;  ///< bounds of the field over the box, units

  explicit PrunedProgram(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : instrs(memory), groups(memory) {}

  ProgramView view() const { return {instrs, params, groups, initial, initial_label, q_scale}; }
  /// All samples of the box are quantised to the same sign.
  bool solid() const { return field.hi * static_cast<double>(q_scale) < -0.51; }
  bool empty() const { return field.lo * static_cast<double>(q_scale) > -0.49; }
};

/// Scratch of one thread.
class PruneScratch {
 public:
  explicit PruneScratch(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : marks(memory), bounds(memory), reversed(memory) {}
  struct GroupBounds {
    Interval value;
    bool met, whole, live;
  };
  std::pmr::vector<Interval> marks;  ///< by instr: decides whether it stays (prune_kernel.inl)
  std::pmr::vector<GroupBounds> bounds;
  std::pmr::vector<Instr> reversed;
};

/// The result for a program proven to be uniformly solid or empty: drop everything, or keep what its values need.
enum class Uniform { drop, keep };

/// Prunes `program` to `box` (closed; contains all positions to be sampled). out must not be the storage of the view.
void prune(const ProgramView& program, const IntBox& box, PruneScratch& scratch, PrunedProgram& out,
           Uniform uniform = Uniform::drop);

}  // namespace sgm
