#pragma once
// Finds the shortest path through the free samples of a sequence of chunks.

#include <span>
#include <vector>

#include "chunk/mesh_chunks.h"
#include "query/sign_window.h"

namespace sgm {

/// Returns the shortest walk from sample to connected sample (void_path.h) through these chunks in this order; each
/// chunk shares a face with the previous one. need: a sample is free if its squared clearance, in cells, is at least
/// this. Precondition: both end samples are free, and a path leads through the chunks.
///
/// Drops chunks from the window that are no longer needed: it keeps 64 chunks at a time, with the chunks around them
/// (at most 18 MB), and the entries of walks into every 64th chunk (17 KB, or 300 bytes per chunk). Therefore all but
/// the last 64 chunks are visited twice; progress counts each visit. Errors: cancelled, and those of the field.
Result<std::vector<Int3>> shortestWalk(SignWindow& window, JobSystem& jobs, std::span<const Int3> chunks, Int3 from,
                                       Int3 to, int need, std::pmr::memory_resource* memory, const Progress& progress);

/// Returns the length of a walk, in cells.
double lengthOf(std::span<const Int3> walk);

}  // namespace sgm
