#pragma once
// The C interface's backends as requests for ours.

#include <optional>

#include "backend/backend.h"
#include "backend/open/open_backend.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Nothing for a number that is no sgm_backend.
std::optional<BackendRequest> requestOf(sgm_backend backend);

/// From now on the runtime's Vulkan backend is on this device; that which is chosen by itself, too, where it is
/// hardware. shares_memory: it was lent with external memory, so that what CUDA meshes stays on it, and CUDA is rather
/// chosen where it can do that. Errors: as makeBackend; busy.
Result<void> lendVulkan(sgm_runtime& runtime, std::shared_ptr<const vulkan::BorrowedDevice> device, bool shares_memory);

/// As lendVulkan; what is chosen by itself is that, unless a Vulkan device that is hardware was lent before.
Result<void> lendCuda(sgm_runtime& runtime, std::shared_ptr<const cuda::BorrowedContext> context);

/// The backend for a field of the runtime's. A device is opened once and meshes for all fields; where `automatic` has
/// found none it is not looked for again. Errors: as makeBackend.
Result<std::shared_ptr<Backend>> backendFor(sgm_runtime& runtime, const BackendRequest& request);

/// What sgm_backend_query says of a backend that there is; the struct's head stays as it is.
void fillInfo(const Backend& backend, sgm_backend_info& info);

}  // namespace sgm::api
