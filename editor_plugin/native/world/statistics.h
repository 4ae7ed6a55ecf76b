#pragma once
// The figures of an SgmWorld3D: methods for scripts, which the class reference describes. Main thread.

#include "world/world.h"

namespace sgm_godot {

/// Empty if no session runs.
Dictionary statistics(const World& world);
/// One of the statistics, for a monitor of the debugger; 0 if there is none with this key.
double figure(const World& world, const std::string& key);

}  // namespace sgm_godot
