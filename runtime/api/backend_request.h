#pragma once
// Converts the backends of the C interface to backend requests.

#include <optional>

#include "backend/backend.h"
#include "backend/open/open_backend.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// nullopt if the number is not a valid sgm_backend.
std::optional<BackendRequest> requestOf(sgm_backend backend);

/// Sets the runtime's Vulkan backend to this device, and the automatic choice, too, if the device is hardware.
/// shares_memory: the device has external memory for CUDA's meshes, and the automatic choice prefers CUDA if it can use
/// that. Errors: as makeBackend; busy.
Result<void> lendVulkan(sgm_runtime& runtime, std::shared_ptr<const vulkan::BorrowedDevice> device, bool shares_memory);

/// As lendVulkan; sets the automatic choice, too, unless a hardware Vulkan device was set before.
Result<void> lendCuda(sgm_runtime& runtime, std::shared_ptr<const cuda::BorrowedContext> context);

/// The backend for a field of the runtime. A device is opened once, and shared by all fields; if `automatic` found
/// none, it does not search again. Errors: as makeBackend.
Result<std::shared_ptr<Backend>> backendFor(sgm_runtime& runtime, const BackendRequest& request);

/// Writes sgm_backend_query's answer for an existing backend; keeps the struct's head.
void fillInfo(const Backend& backend, sgm_backend_info& info);

}  // namespace sgm::api
