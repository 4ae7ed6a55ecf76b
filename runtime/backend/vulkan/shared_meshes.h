#pragma once
// Meshes in the memory of the engine's Vulkan device, which draws them; a device of another API (CUDA) writes them.

#include "backend/mesh_store.h"
#include "backend/vulkan/device.h"

namespace sgm::vulkan {

/// Opens the engine's device, which must have BorrowedDevice::external_memory. Errors: same as Device::borrow;
/// out_of_memory.
Result<std::shared_ptr<MeshStore>> openSharedMeshes(const BorrowedDevice& external);

}  // namespace sgm::vulkan
