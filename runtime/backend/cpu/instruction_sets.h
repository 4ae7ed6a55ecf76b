#pragma once
// The instruction sets with evaluators in this build, and those that this processor supports.

#include <string_view>
#include <vector>

#include "field/evaluate.h"

namespace sgm {

struct InstructionSet {
  const FieldKernels* kernels;  ///< meshes are made by findMeshKernels(kernels->name) (extract/mesh_kernels.h)
  bool runs_here;
};

/// Scalar first, then the vector sets from narrow to wide.
std::vector<InstructionSet> instructionSets();

/// The widest that this processor supports; all give the same bits.
const FieldKernels& bestKernels();

/// By name ("scalar", "sse4.2", "avx2", "avx512", "avx512-vbmi2"); null if it is not built or not supported here.
const FieldKernels* findKernels(std::string_view name);

/// Without scalar; empty in a scalar build.
std::vector<InstructionSet> wideInstructionSets();

}  // namespace sgm
