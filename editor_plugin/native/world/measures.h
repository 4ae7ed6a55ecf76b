#pragma once
// Measures of the meshes that an SgmWorld3D draws, and these meshes for scenes without the plugin: methods for scripts,
// which the class reference describes. The results are empty if no session runs.

#include "world/world.h"

namespace sgm_godot {

/// The sums that the runtime keeps. Main thread.
Dictionary drawnMeasures(const World& world);
/// Measures with a histogram of dihedral angles, which take longer. Any thread.
Dictionary measureDrawn(const World& world, int64_t bins);
/// Meshes, materials and collision faces of the drawn chunks. Main thread.
Array bakeChunks(const World& world);

}  // namespace sgm_godot
