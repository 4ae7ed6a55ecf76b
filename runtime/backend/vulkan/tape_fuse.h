#pragma once
// Merges instructions of a tape into others, so that their results need no slots: a slot costs a shader more than most
// instructions (shaders/mesher/tape.glsl).

#include "backend/vulkan/tape.h"

namespace sgm {

/// scratch: nodes in the program's order, values by index. Removes merged nodes and values, and renumbers the rest.
void fuseNodes(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
