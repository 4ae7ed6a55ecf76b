#pragma once
// Converts a batch's results to meshes.

#include <span>

#include "backend/vulkan/device_meshes.h"
#include "backend/vulkan/mesher.h"

namespace sgm::vulkan {

/// Fills the mesh of one chunk of the plan. Returns false and keeps the mesh if a part had no room. Throws
/// std::bad_alloc.
bool readMesh(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const ChunkJob& job, ChunkMesh& mesh);

/// The locations of a chunk's parts after readMesh.
PartSources sourcesOf(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const BatchBuffers& buffers);

}  // namespace sgm::vulkan
