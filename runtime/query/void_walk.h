#pragma once
// Finds the shortest path through the free samples of a sequence of chunks.

#include <span>
#include <vector>

#include "chunk/mesh_chunks.h"
#include "query/sign_window.h"

namespace sgm {

/// Goes from sample to connected sample (void_path.h), through these chunks in this order; each shares a face with the
/// previous one. need: the squared clearance, in cells, from which a sample is free. Precondition: both samples are
/// free, and a path leads through the chunks. Drops from the window what it does not need. It holds 64 chunks at a
/// time, with those around them (at most 18 MB), and the walk's entry into each next 64: 17 KB, or 300 bytes a chunk.
/// So all but the last 64 chunks are visited twice; progress counts each visit. Errors: cancelled, and the field's.
Result<std::vector<Int3>> shortestWalk(SignWindow& window, JobSystem& jobs, std::span<const Int3> chunks, Int3 from,
                                       Int3 to, int need, std::pmr::memory_resource* memory, const Progress& progress);

/// The length of a walk, in cells.
double lengthOf(std::span<const Int3> walk);

}  // namespace sgm
