#pragma once
// An implementation of MeshKernels::list for processors that can compress bytes within a register (AVX-512 VBMI2) and
// transpose bit matrices (GFNI): Ice Lake, Zen 4 and later.

#include "backend/cpu/extract/mesh_kernels.h"

namespace sgm {

/// True if this processor supports both extensions. Thread-safe.
bool vbmi2RunsHere();

/// Same as listRows() of list.inl. Precondition: vbmi2RunsHere(). Built only for x86-64.
ListCounts listRowsVbmi2(const SignLattice& lattice, size_t z, size_t first, size_t last, uint32_t* edges,
                         uint64_t* cells);

}  // namespace sgm
