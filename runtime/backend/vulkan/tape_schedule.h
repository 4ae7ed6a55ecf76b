#pragma once
// Orders the instructions of a tape, and assigns their values to as few slots as possible. A shader evaluates a tape in
// sweeps, each of which goes through the kinds of instructions in turn: so instructions of one kind should form long
// runs.

#include "backend/vulkan/tape.h"

namespace sgm {

/// Fills scratch with the records: their order, kinds, slots for values, and places (warped positions). Returns false
/// if a limit of the shaders is exceeded (see appendTape). Throws std::bad_alloc.
bool scheduleTape(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
