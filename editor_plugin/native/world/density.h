#pragma once
// Densities of an SgmWorld3D for renderers of fog: a method for scripts, which the class reference describes.

#include "world/world.h"

namespace sgm_godot {

/// Two bytes for each point of a grid, in which x varies fastest, then y, then z: the density, and the share of the
/// sun's light that reaches the point. `corner` in the node's coordinates; `spacing`, `fade` and `edge` in metres.
/// Empty, with an error in the engine's log, if an argument is out of its range. Any thread.
Bytes sampleDensity(const World& world, const Vector3& corner, double spacing, const Vector3i& size,
                    const Vector3& to_sun, double fade, double edge);

}  // namespace sgm_godot
