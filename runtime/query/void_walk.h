#pragma once
// The shortest way through the free samples of chunks in a row.

#include <span>
#include <vector>

#include "chunk/mesh_chunks.h"
#include "query/sign_window.h"

namespace sgm {

/// From sample to joined sample (void_path.h), through these chunks in this order, each of which shares a face with the
/// one before. need: square of the clearance, in cells, that a sample must have to be free. Both samples are free, and
/// some way leads through the chunks. Drops from the window what it does not need. Of the chunks it keeps 64 at a time,
/// with those around them (at most 18 MB), and in between how the walk enters the next 64: 17 KB, which is 300 bytes a
/// chunk. For that, all but the last 64 are looked at twice; progress counts each look at a chunk. Errors: cancelled,
/// and the field's.
Result<std::vector<Int3>> shortestWalk(SignWindow& window, JobSystem& jobs, std::span<const Int3> chunks, Int3 from,
                                       Int3 to, int need, std::pmr::memory_resource* memory, const Progress& progress);

/// Of a walk, in cells.
double lengthOf(std::span<const Int3> walk);

}  // namespace sgm
