#pragma once
// Meshes chunks on an NVIDIA GPU in batches. The CPU meshes the chunks for which the GPU has no memory, and those of a
// GPU that is lost (backend/device_batch.h).

#include <functional>
#include <memory>
#include <string>

#include "backend/backend.h"
#include "backend/mesh_store.h"
#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm {

struct CudaBackendOptions {
  /// Opens the device; also called after a loss, where an error means that the CPU does all further work. Called by one
  /// thread at a time.
  std::function<Result<std::unique_ptr<cuda::Device>>()> open;
  /// same as BackendRequest::warn; also receives the loss of `store`
  std::function<void(const std::string&)> warn = nullptr;
  cuda::Room room;
  /// where meshes stay; null: in an external context's own memory, or nowhere
  std::shared_ptr<MeshStore> store = nullptr;
  uint64_t resident_cap = UINT64_MAX;  ///< for an external context: limit in bytes for meshes that stay on the device
};

/// Creates the backend. Errors: those of options.open and cuda::Mesher::create, if the device cannot be opened at
/// first.
Result<std::unique_ptr<Backend>> makeCudaBackend(const CudaBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                 std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
