#pragma once
// Meshes made by another API's device, in memory of the engine's Vulkan device, which draws them.

#include "backend/mesh_store.h"
#include "backend/vulkan/device.h"

namespace sgm::vulkan {

/// Opens the engine's device, which must have BorrowedDevice::external_memory. Errors: as Device::borrow;
/// out_of_memory.
Result<std::shared_ptr<MeshStore>> openSharedMeshes(const BorrowedDevice& lent);

}  // namespace sgm::vulkan
