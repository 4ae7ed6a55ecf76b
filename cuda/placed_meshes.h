#pragma once
// Meshes that are copied from a batch's memory to memory of another API, and stay there, on the rendering device.

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/mesh_store.h"
#include "cuda/device.h"
#include "cuda/kept_meshes.h"

namespace sgm::cuda {

/// Copies meshes into a store of the rendering device. Thread-safe. The CUDA device must outlive this object.
class PlacedMeshes {
 public:
  /// Errors: unsupported if the store is on another GPU or the device cannot import its memory; out_of_memory;
  /// device_lost.
  static Result<std::unique_ptr<PlacedMeshes>> create(Device& device, std::shared_ptr<MeshStore> store);

  /// Enqueues copies of mesh parts in the stream. The caller must wait for the stream and then publish the result
  /// (MeshStore::publish). If an error is returned, no copy is running. Errors: those of Stream::copy. Throws
  /// std::bad_alloc.
  Result<std::unique_ptr<MeshPlacement>> keep(Stream& stream, std::span<const PartSources> chunks);
  /// Releases all imports, also those whose blocks continue to exist: such an import would keep the memory of a lost
  /// device alive. Precondition: no placement is still being written.
  ~PlacedMeshes();
  PlacedMeshes(const PlacedMeshes&) = delete;
  PlacedMeshes& operator=(const PlacedMeshes&) = delete;
  MeshStore& store() const { return *store_; }

 private:
  struct Import;
  PlacedMeshes(Device& device, std::shared_ptr<MeshStore> store) : device_(device), store_(std::move(store)) {}
  /// Imports a block's memory into the device, or returns the existing import.
  Result<std::shared_ptr<const ImportedMemory>> import(SharedBlock& block);

  Device& device_;
  const std::shared_ptr<MeshStore> store_;
  std::mutex mutex_;                            ///< guards `imports_`
  std::vector<std::weak_ptr<Import>> imports_;  ///< all imports that this object has stored in blocks
};

}  // namespace sgm::cuda
