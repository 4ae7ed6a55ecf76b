#pragma once
// Meshes chunks on an NVIDIA GPU, in batches; the CPU meshes those that the GPU cannot, or loses
// (backend/device_batch.h).

#include <functional>
#include <memory>
#include <string>

#include "backend/backend.h"
#include "backend/mesh_store.h"
#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm {

struct CudaBackendOptions {
  /// Opens the device, also after a loss; then an error means that the CPU does all. Called by one thread at a time.
  std::function<Result<std::unique_ptr<cuda::Device>>()> open;
  std::function<void(const std::string&)> warn = nullptr;  ///< as BackendRequest::warn; also receives the loss of
                                                           ///< `store`
  cuda::Room room;
  std::shared_ptr<MeshStore> store =
      nullptr;                         ///< where meshes stay; null: in an external context's own memory, or nowhere
  uint64_t resident_cap = UINT64_MAX;  ///< for an external context: limit for meshes that stay on the device, bytes
};

/// Errors if the device cannot be opened at first: as options.open and cuda::Mesher::create.
Result<std::unique_ptr<Backend>> makeCudaBackend(const CudaBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                 std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
