#pragma once
// Lists the instruction sets for which this build has evaluators, and states which of them this processor supports.

#include <string_view>
#include <vector>

#include "field/evaluate.h"

namespace sgm {

struct InstructionSet {
  /// the evaluator; findMeshKernels(kernels->name) returns the kernels for meshing (extract/mesh_kernels.h)
  const FieldKernels* kernels;
  bool runs_here;
};

/// Returns all instruction sets of this build: scalar first, then the vector sets from narrow to wide.
std::vector<InstructionSet> instructionSets();

/// Returns the evaluator of the widest instruction set that this processor supports; all evaluators give the same bits.
const FieldKernels& bestKernels();

/// Returns an evaluator by name ("scalar", "sse4.2", "avx2", "avx512", "avx512-vbmi2"); null if this build does not
/// contain it, or this processor does not support it.
const FieldKernels* findKernels(std::string_view name);

/// Returns the vector instruction sets of this build, that is, all except scalar; empty in a scalar build.
std::vector<InstructionSet> wideInstructionSets();

}  // namespace sgm
