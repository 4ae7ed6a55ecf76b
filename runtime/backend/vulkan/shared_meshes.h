#pragma once
// Meshes that another API's device makes, in memory of the engine's Vulkan device, which draws them.

#include "backend/mesh_store.h"
#include "backend/vulkan/device.h"

namespace sgm::vulkan {

/// On the engine's device, lent with BorrowedDevice::external_memory. Errors: as Device::borrow;
/// out_of_memory.
Result<std::shared_ptr<MeshStore>> openSharedMeshes(const BorrowedDevice& lent);

}  // namespace sgm::vulkan
