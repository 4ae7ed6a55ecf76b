#pragma once
// The paper's measures of a meshed region (its section 7).

#include <cstdint>

#include "mesh/weld.h"

namespace sgm {

struct Measures {
  /// m2, equation 7: the sum of half the lengths of the triangles' cross products, in the order of triangles
  double area = 0;
  uint64_t objects = 0;  ///< section 7.3: number of groups of triangles connected through common vertices
  /// m3: a third of the flux of the position vector relative to `about`; for a closed mesh, the volume inside
  double flux = 0;
};

/// Measures a region's mesh. Two vertices are the same if their keys are equal, without any tolerance. about: the
/// origin of the flux, in units.
Measures measuresOf(const WorldMesh& mesh, Int3 about = {});

/// Returns the volume in m3 by equation 8: N_C * C_E^3. A cube with the cell's edge C_E is centred on each sample, and
/// counts if the sample is inside. A region has the samples on its low faces, but not those on its high faces, so that
/// the volumes of adjacent regions add up.
double cubeVolume(uint64_t samples_inside, int32_t cell_units);

}  // namespace sgm
