#pragma once
// Checks the drawn surface from scratch.

#include "tools/flight/checked_chunk.h"
#include "tools/flight/frame_report.h"

namespace sgm::cli {

/// Checks the drawn parts of all chunks. Takes about 4 us a triangle.
WholeReport checkAll(const CheckedChunks& chunks);

}  // namespace sgm::cli
