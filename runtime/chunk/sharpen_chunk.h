#pragma once
// Sharpens the edges and corners of a meshed chunk: a step on the host after meshing, for chunks of any backend.

#include "backend/backend.h"

namespace sgm {

/// Sharpens the body and the existing seams (mesh/sharpen.h), and splits the creases of the body. Releases the parts on
/// the device, because they are out of date afterwards. field, coarse: programs as in the chunk's job, compiled for the
/// region that sharpening samples (sampledBox in mesh_chunks.h). Throws std::bad_alloc.
void sharpenChunk(const ChunkGrid& grid, const FieldProgram& field, const FieldProgram* coarse, ChunkMesh& mesh,
                  std::pmr::memory_resource* memory);

}  // namespace sgm
