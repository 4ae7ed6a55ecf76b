#pragma once
// Merges instructions of a tape into others, so that their results need no slots: a slot costs a shader more than most
// instructions do (shaders/mesher/tape.glsl).

#include "backend/vulkan/tape.h"

namespace sgm {

/// Removes merged nodes and values, and renumbers the others. scratch: has the nodes in the order of the program.
void fuseNodes(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
