#pragma once
// Converts a batch's results to meshes.

#include <span>

#include "backend/vulkan/device_meshes.h"
#include "backend/vulkan/mesher.h"

namespace sgm::vulkan {

/// Fills the mesh of one chunk of the plan. Returns false, and does not change the mesh, if the device had no memory
/// for one of its parts. Throws std::bad_alloc.
bool readMesh(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const ChunkJob& job, ChunkMesh& mesh);

/// Returns where the parts of a chunk are in the device's buffers. Call after readMesh.
PartSources sourcesOf(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const BatchBuffers& buffers);

}  // namespace sgm::vulkan
