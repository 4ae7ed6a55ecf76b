#pragma once
// Digging and building in an SgmWorld3D, and the exchange of edits. The functions implement methods for scripts, which
// the class reference describes. On failure they log an error, and return an empty value or the engine's Error. Main
// thread only.

#include "world/world.h"

namespace sgm_godot {

// The following functions emit the signal `edited` and return the edit's id. A handler of the signal may destroy the
// world.
Integers dig(World& world, const Vector3& position, double radius, double smooth);
Integers build(World& world, const Vector3& position, double radius, const std::string& material, double smooth);
Integers edit(World& world, const Dictionary& brush);
Integers undo(World& world, const Integers& id);

int64_t countEdits(const World& world);
Bytes exportEdits(World& world, int64_t since);
int64_t importEdits(World& world, const Bytes& bytes);
int64_t flushEdits(World& world);
int64_t hashEdits(const World& world);

}  // namespace sgm_godot
