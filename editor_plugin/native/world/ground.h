#pragma once
// The ground that a viewer can walk on.

#include "colliders.h"
#include "session.h"
#include "world/world_node.h"

namespace sgm_godot {

/// Whether a collider of the world lies below `position` (scene), at the height at which the world has its ground. Main
/// thread, in a physics frame.
bool hasGround(Vector3 position, const WorldNode& node, const Colliders& colliders, const Session& session);

}  // namespace sgm_godot
