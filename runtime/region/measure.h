#pragma once
// The paper's measures of a meshed region (its section 7).

#include <cstdint>

#include "mesh/weld.h"

namespace sgm {

struct Measures {
  double area = 0;       ///< m2, equation 7: half the length of each triangle's cross product, summed in triangle order
  uint64_t objects = 0;  ///< section 7.3: groups of triangles that share vertices, directly or through others
  double flux = 0;       ///< m3: a third of the flux of x relative to `about`; of a closed mesh the volume inside
};

/// Vertices are equal if their keys are equal, without any tolerance. about: units.
Measures measuresOf(const WorldMesh& mesh, Int3 about = {});

/// m3, equation 8: N_C * C_E^3. A cube of edge C_E (the cell's) is centred on each sample, and counts if its sample is
/// inside. A region has the samples on its low faces and between, so that adjacent regions add up.
double cubeVolume(uint64_t samples_inside, int32_t cell_units);

}  // namespace sgm
