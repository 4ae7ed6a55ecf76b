#pragma once
// Samples the density of an SgmWorld3D for renderers of fog. The function implements a method for scripts, which the
// class reference describes.

#include "world/world.h"

namespace sgm_godot {

/// Returns two bytes for each point of a grid, in which x varies fastest, then y, then z: the density, and the share of
/// the sun's light that reaches the point. `corner` is in the node's coordinates; `spacing`, `fade` and `edge` are in
/// metres. If an argument is out of its range, logs an error and returns an empty array. Thread-safe.
Bytes sampleDensity(const World& world, const Vector3& corner, double spacing, const Vector3i& size,
                    const Vector3& to_sun, double fade, double edge);

}  // namespace sgm_godot
