#pragma once
// Converts sgm_backend numbers to internal backend requests, and creates the backends of a runtime.

#include <optional>

#include "backend/backend.h"
#include "backend/open/open_backend.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Converts a backend number of the C interface; nullopt if it is not a valid sgm_backend.
std::optional<BackendRequest> requestOf(sgm_backend backend);

/// Makes an external Vulkan device the runtime's Vulkan backend. If the device is hardware, it also becomes the
/// automatic choice. shares_memory: the device can share memory with CUDA; then the automatic choice is CUDA, with
/// meshes in that memory, if CUDA is available. Errors: those of makeBackend; busy if another device is in use.
Result<void> lendVulkan(sgm_runtime& runtime, std::shared_ptr<const vulkan::BorrowedDevice> device, bool shares_memory);

/// Makes an external CUDA context the runtime's CUDA backend. It also becomes the automatic choice, unless an external
/// hardware Vulkan device was set before. Errors: those of makeBackend; busy if another device is in use.
Result<void> lendCuda(sgm_runtime& runtime, std::shared_ptr<const cuda::BorrowedContext> context);

/// Returns the backend for a new field of the runtime. A device is opened once and shared by all fields. If a previous
/// automatic choice has found no device, the CPU is used without another search. Errors: those of makeBackend.
Result<std::shared_ptr<Backend>> backendFor(sgm_runtime& runtime, const BackendRequest& request);

/// Fills `info` with the properties of an existing backend, for sgm_backend_query. Keeps struct_size and next of
/// `info`.
void fillInfo(const Backend& backend, sgm_backend_info& info);

}  // namespace sgm::api
