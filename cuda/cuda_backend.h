#pragma once
// The backend that meshes batches of chunks on an NVIDIA GPU. The CPU meshes the chunks for which the GPU has too
// little memory, and all chunks after the GPU was lost (backend/device_batch.h).

#include <functional>
#include <memory>
#include <string>

#include "backend/backend.h"
#include "backend/mesh_store.h"
#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm {

struct CudaBackendOptions {
  /// Opens the device. After a loss of the device, each batch calls it again until it succeeds; after too many failures
  /// in a row, the CPU meshes all further chunks. Called by one thread at a time.
  std::function<Result<std::unique_ptr<cuda::Device>>()> open;
  /// same as BackendRequest::warn; also called if meshes cannot be moved to `store`
  std::function<void(const std::string&)> warn = nullptr;
  cuda::Room room;
  /// where meshes stay after meshing; null: in the memory of the engine's CUDA context, if there is one, otherwise only
  /// on the host
  std::shared_ptr<MeshStore> store = nullptr;
  uint64_t resident_cap = UINT64_MAX;  ///< limit in bytes for meshes that stay on the device; used only in the engine's
                                       ///< CUDA context
};

/// Creates the backend. Errors if the device cannot be opened: those of options.open and cuda::Mesher::create.
Result<std::unique_ptr<Backend>> makeCudaBackend(const CudaBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                 std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
