#pragma once
// Measures of a meshed region, as section 7 of the paper defines them.

#include <cstdint>

#include "mesh/weld.h"

namespace sgm {

struct Measures {
  /// m2, by equation 7: half the sum of the lengths of the triangles' cross products, in the order of triangles
  double area = 0;
  uint64_t objects = 0;  ///< number of groups of triangles that are connected through common vertices (section 7.3)
  /// m3: a third of the flux of the position vector relative to `about`; for a closed mesh, the enclosed volume
  double flux = 0;
};

/// Measures a region's mesh. Two corners of triangles share a vertex only if their indices, and thus their keys, are
/// equal; positions are not compared. about: the origin of the position vectors, in units.
Measures measuresOf(const WorldMesh& mesh, Int3 about = {});

/// Returns the volume in m3 by equation 8 of the paper: N_C * C_E^3. A cube with the cell's edge C_E is centred on each
/// sample, and counts if the sample is inside the solid. A region includes the samples on its low faces, but not those
/// on its high faces, so that the volumes of adjacent regions add up.
double cubeVolume(uint64_t samples_inside, int32_t cell_units);

}  // namespace sgm
