#pragma once
// Sharp features of a chunk, whatever backend has meshed it: a step after meshing, on the host.

#include "backend/backend.h"

namespace sgm {

/// Sharpens the body and the seams that there are (mesh/sharpen.h), and splits the body's creases. What is on a device
/// is no longer what is there, and let go of. field, coarse: as the job's, for all that the step samples (sampledBox in
/// mesh_chunks.h). Throws std::bad_alloc.
void sharpenChunk(const ChunkGrid& grid, const FieldProgram& field, const FieldProgram* coarse, ChunkMesh& mesh,
                  std::pmr::memory_resource* memory);

}  // namespace sgm
