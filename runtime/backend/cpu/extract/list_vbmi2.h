#pragma once
// MeshKernels::list for processors that compress bytes within a register (AVX-512 VBMI2) and transpose bits (GFNI): since
// Ice Lake and Zen 4.

#include "backend/cpu/extract/mesh_kernels.h"

namespace sgm {

/// Whether this processor can. Thread-safe.
bool vbmi2RunsHere();

/// Only where vbmi2RunsHere(). Never built for processors of another kind than x86-64, and never to be called there.
ListCounts listRowsVbmi2(const SignLattice& lattice, size_t z, size_t first, size_t last, uint32_t* edges,
                         uint64_t* cells);

}  // namespace sgm
