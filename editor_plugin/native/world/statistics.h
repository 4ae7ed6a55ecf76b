#pragma once
// The figures of an SgmWorld3D. The functions implement methods for scripts, which the class reference describes. Main
// thread only.

#include "world/world.h"

namespace sgm_godot {

/// Returns all figures by name; empty if no session runs.
Dictionary statistics(const World& world);
/// Returns a single figure of the statistics, for the debugger; 0 if no figure has this key.
double figure(const World& world, const std::string& key);

}  // namespace sgm_godot
