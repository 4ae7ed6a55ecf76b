#pragma once
// Questions about an SgmWorld3D, which its field answers, whether it is drawn there or not: methods for scripts, which
// the class reference describes. They report errors to the engine's log, and return an empty value. Main thread.

#include "world/world.h"

namespace sgm_godot {

Dictionary castRay(World& world, const Vector3& from, const Vector3& direction, double length);
Dictionary findClosestPoint(World& world, const Vector3& position, double max_distance);
Points findPath(World& world, const Vector3& from, const Vector3& to, double radius);
Array listAnchors(World& world, const Aabb& box);
int64_t hashWorld(World& world, const Aabb& box, int64_t level);
/// The box around everything that is drawn, in the node's coordinates.
Aabb drawnBounds(const World& world);

}  // namespace sgm_godot
