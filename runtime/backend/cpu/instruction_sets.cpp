#include "backend/cpu/instruction_sets.h"

namespace sgm {

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> sets{{&scalarKernels(), true}};
#ifndef SGM_SCALAR
  const std::vector<InstructionSet> wide = wideInstructionSets();
  sets.insert(sets.end(), wide.begin(), wide.end());
#endif
  return sets;
}

const FieldKernels& bestKernels() {
  // The choice is made once and stored: the processor's instruction sets never change, and querying them takes longer
  // than a small evaluation.
  static const FieldKernels& best = []() -> const FieldKernels& {
    const FieldKernels* widest = &scalarKernels();
    for (const InstructionSet& set : instructionSets()) {
      if (set.runs_here) widest = set.kernels;
    }
    return *widest;
  }();
  return best;
}

const FieldKernels* findKernels(std::string_view name) {
  for (const InstructionSet& set : instructionSets()) {
    if (set.kernels->name == name) return set.runs_here ? set.kernels : nullptr;
  }
  return nullptr;
}

}  // namespace sgm
