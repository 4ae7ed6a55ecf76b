#pragma once
// Measures of the drawn meshes of an SgmWorld3D, and copies of these meshes for scenes without the plugin. The
// functions implement methods for scripts, which the class reference describes. Results are empty if no session runs.

#include "world/world.h"

namespace sgm_godot {

/// Returns the sums that the runtime keeps up to date. Main thread only.
Dictionary drawnMeasures(const World& world);
/// Measures all drawn triangles, with a histogram of dihedral angles; takes longer than drawnMeasures(). Thread-safe.
Dictionary measureDrawn(const World& world, int64_t bins);
/// Returns the meshes, materials and collision faces of the drawn chunks. Main thread only.
Array bakeChunks(const World& world);

}  // namespace sgm_godot
