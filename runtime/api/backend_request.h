#pragma once
// Converts the backends of the C interface to internal backend requests, and creates the backends of a runtime.

#include <optional>

#include "backend/backend.h"
#include "backend/open/open_backend.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Converts a backend of the C interface; nullopt if the number is not a valid sgm_backend.
std::optional<BackendRequest> requestOf(sgm_backend backend);

/// Sets the runtime's Vulkan backend to an external device; also the automatic choice, if the device is hardware.
/// shares_memory: the device can share memory with CUDA, and the automatic choice becomes CUDA, with meshes in that
/// memory, if CUDA is available. Errors: those of makeBackend; busy.
Result<void> lendVulkan(sgm_runtime& runtime, std::shared_ptr<const vulkan::BorrowedDevice> device, bool shares_memory);

/// Sets the runtime's CUDA backend to an external context; also the automatic choice, unless an external hardware
/// Vulkan device was set before. Errors: those of makeBackend; busy.
Result<void> lendCuda(sgm_runtime& runtime, std::shared_ptr<const cuda::BorrowedContext> context);

/// Returns the backend for a field of the runtime. A device is opened once, and shared by all fields; if the automatic
/// choice found no device, it does not search again. Errors: those of makeBackend.
Result<std::shared_ptr<Backend>> backendFor(sgm_runtime& runtime, const BackendRequest& request);

/// Fills `info` for an existing backend, as sgm_backend_query does. Keeps info's struct_size and next.
void fillInfo(const Backend& backend, sgm_backend_info& info);

}  // namespace sgm::api
