#pragma once
// Instructions of a tape that become part of others, so that their results need no slots: what a shader pays for a slot
// is more than most instructions cost (shaders/mesher/tape.glsl).

#include "backend/vulkan/tape.h"

namespace sgm {

/// scratch: nodes in the program's order, their values by number. Leaves no more of either, numbered anew.
void fuseNodes(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
