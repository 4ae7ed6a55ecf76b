#pragma once
// Queries of an SgmWorld3D that its field answers, also where nothing is drawn. The functions implement methods for
// scripts, which the class reference describes. On failure they log an error, and return an empty value. Main thread
// only.

#include "world/world.h"

namespace sgm_godot {

Dictionary castRay(World& world, const Vector3& from, const Vector3& direction, double length);
Dictionary findClosestPoint(World& world, const Vector3& position, double max_distance);
Points findPath(World& world, const Vector3& from, const Vector3& to, double radius);
Array listAnchors(World& world, const Aabb& box);
int64_t hashWorld(World& world, const Aabb& box, int64_t level);
/// Returns the bounding box of all drawn chunks, in the node's coordinates.
Aabb drawnBounds(const World& world);

}  // namespace sgm_godot
