#pragma once
// Tests whether there is ground below a place, on which a viewer can walk.

#include "colliders.h"
#include "session.h"
#include "world/world_node.h"

namespace sgm_godot {

/// Whether a collider of the world lies below `position` (scene coordinates) at the height of the ground in the world's
/// field. Main thread only, during a physics frame.
bool hasGround(Vector3 position, const WorldNode& node, const Colliders& colliders, const Session& session);

}  // namespace sgm_godot
