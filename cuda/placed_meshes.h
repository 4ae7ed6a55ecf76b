#pragma once
// Meshes that stay in memory of another API, on the device that draws: they are copied there from a batch's memory.

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/mesh_store.h"
#include "cuda/device.h"
#include "cuda/kept_meshes.h"

namespace sgm::cuda {

/// Thread-safe. The device must outlive it.
class PlacedMeshes {
 public:
  /// Errors: unsupported (the store is on another GPU, or the device cannot import its memory); out_of_memory;
  /// device_lost.
  static Result<std::unique_ptr<PlacedMeshes>> create(Device& device, std::shared_ptr<MeshStore> store);

  /// Copies parts asynchronously in the stream. Publish the result (MeshStore::publish) after waiting for the stream.
  /// After an error, no copy is running. Errors: same as Stream::copy. Throws std::bad_alloc.
  Result<std::unique_ptr<Placement>> keep(Stream& stream, std::span<const PartSources> chunks);
  /// Precondition: no placement is still being written. Releases the imported memory although the blocks continue to
  /// exist, since it would keep the memory of a lost device alive.
  ~PlacedMeshes();
  PlacedMeshes(const PlacedMeshes&) = delete;
  PlacedMeshes& operator=(const PlacedMeshes&) = delete;
  MeshStore& store() const { return *store_; }

 private:
  struct Import;
  PlacedMeshes(Device& device, std::shared_ptr<MeshStore> store) : device_(device), store_(std::move(store)) {}
  /// Imports the block's memory into the device.
  Result<std::shared_ptr<const ImportedMemory>> import(SharedBlock& block);

  Device& device_;
  const std::shared_ptr<MeshStore> store_;
  std::mutex mutex_;                            ///< guards the following members
  std::vector<std::weak_ptr<Import>> imports_;  ///< the imports that this object has stored in the blocks
};

}  // namespace sgm::cuda
