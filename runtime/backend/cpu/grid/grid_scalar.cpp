#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "backend/cpu/grid/grid_kernels.h"
#include "backend/cpu/instruction_sets.h"
#include "base/kernel.h"
#include "mesh/chunk.h"
#include "mesh/tables.h"
#include "mesh/triangulate.h"

namespace sgm {

namespace scalar_grid {

using std::memcpy;

#include "common/portable.h"
#include "common/real.h"

inline constexpr size_t kLanes = 1;
FN Real loadValues(const float* p) { return *p; }
FN Int loadLanes(const uint32_t* p) { return static_cast<Int>(*p); }
FN Real loadAt(const float* p, Int i) { return p[i]; }
FN void storeLanes(Int i, int32_t* p) { *p = i; }
FN void storeLanes(Real r, float* p) { *p = r; }
FN Real squareRoot(Real r) { return std::sqrt(r); }
FN Real quotient(Real a, Real b) { return a / b; }
FN uint64_t maskOf(Bool b) { return b ? 1 : 0; }
FN bool all(Bool b) { return b; }

#include "backend/cpu/grid/grid_kernels.inl"

}  // namespace scalar_grid

const GridKernels& scalarGridKernels() {
  static constexpr GridKernels kernels{"scalar", scalar_grid::signsOfRow, scalar_grid::countPlane,
                                       scalar_grid::meshSlab};
  return kernels;
}

const GridKernels* findGridKernels(const char* name) {
  if (std::strcmp(name, scalarGridKernels().name) == 0) return &scalarGridKernels();
#ifdef SGM_SCALAR
  return nullptr;
#else
  return findWideGridKernels(name);
#endif
}

const GridKernels& bestGridKernels() {
  static const GridKernels& best = []() -> const GridKernels& {
    const GridKernels* found = findGridKernels(bestKernels().name);
    return found != nullptr ? *found : scalarGridKernels();
  }();
  return best;
}

}  // namespace sgm
