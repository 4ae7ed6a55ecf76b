#pragma once
// Orders the instructions of a tape so that a sweep has long runs of each kind, and assigns values to as few slots as
// possible.

#include "backend/vulkan/tape.h"

namespace sgm {

/// Fills scratch with the order, kinds, places and slots of the records. Returns false if a limit of the shaders is
/// exceeded (see appendTape). Throws std::bad_alloc.
bool scheduleTape(const ProgramView& program, TapeScratch& scratch);

}  // namespace sgm
