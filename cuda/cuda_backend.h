#pragma once
// Chunks on an NVIDIA GPU, in batches; the CPU takes what the GPU cannot, or loses (backend/device_batch.h).

#include <functional>
#include <memory>
#include <string>

#include "backend/backend.h"
#include "backend/mesh_store.h"
#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm {

struct CudaBackendOptions {
  /// Opens the device, anew after a loss; an error then means that the CPU does all. Called by one thread at a time.
  std::function<Result<std::unique_ptr<cuda::Device>>()> open;
  std::function<void(const std::string&)> warn = nullptr;  ///< as BackendRequest::warn; also of a store that is lost
  cuda::Room room;
  std::shared_ptr<MeshStore> store =
      nullptr;                         ///< where meshes stay; null: in a borrowed device's own memory, or nowhere
  uint64_t resident_cap = UINT64_MAX;  ///< of a borrowed device: the most bytes of meshes that stay on it
};

/// Errors, where the device cannot even be opened: as options.open and cuda::Mesher::create.
Result<std::unique_ptr<Backend>> makeCudaBackend(const CudaBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                 std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
