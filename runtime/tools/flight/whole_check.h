#pragma once
// Checks the whole drawn surface from scratch, without the incremental state of FrameChecker.

#include "tools/flight/checked_chunk.h"
#include "tools/flight/frame_report.h"

namespace sgm::cli {

/// Checks the drawn parts of all chunks. Takes about 4 us per triangle.
WholeReport checkAll(const CheckedChunks& chunks);

}  // namespace sgm::cli
