#pragma once
// The order in which a tape runs a program's instructions: in sweeps, of each kind as many as stand in a row, every
// value in one of few slots.

#include "backend/vulkan/tape.h"

namespace sgm {

/// Fills scratch with the records' order, kinds, places and slots. false: more than a shader's bounds hold
/// (appendTape). Throws std::bad_alloc.
bool scheduleTape(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
