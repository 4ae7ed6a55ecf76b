#pragma once
// What a batch left on the device, as meshes.

#include <span>

#include "backend/vulkan/device_meshes.h"
#include "backend/vulkan/mesher.h"

namespace sgm::vulkan {

/// Fills the mesh of one chunk of the plan. false: some part had no room, and the mesh is as it was. Throws
/// std::bad_alloc.
bool readMesh(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const ChunkJob& job, ChunkMesh& mesh);

/// Where the parts of a chunk lie that readMesh has read.
PartSources sourcesOf(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const BatchBuffers& buffers);

}  // namespace sgm::vulkan
