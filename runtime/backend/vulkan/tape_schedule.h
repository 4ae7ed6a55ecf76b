#pragma once
// Orders a program's instructions for a tape: in sweeps with long runs of each kind, and every value in one of few
// slots.

#include "backend/vulkan/tape.h"

namespace sgm {

/// Fills scratch with the records' order, kinds, places and slots. Returns false if a shader's limits are exceeded
/// (appendTape). Throws std::bad_alloc.
bool scheduleTape(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
