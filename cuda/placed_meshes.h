#pragma once
// Meshes that stay in another API's memory, on the drawing device: copied there from a batch's memory.

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
  /// Errors: unsupported (the store is on another GPU, or the device cannot import its memory); out_of_memory,
  /// device_lost.
  static Result<std::unique_ptr<PlacedMeshes>> create(Device& device, std::shared_ptr<MeshStore> store);

  /// Copies parts asynchronously in the stream. Publish the result (Placement) after waiting for that. On error no copy
  /// is running any more. Errors: as Stream::copy. Throws std::bad_alloc.
  Result<std::unique_ptr<Placement>> keep(Stream& stream, std::span<const PartSources> chunks);
  /// Precondition: no placement is still being written. Releases the imported memory although its blocks live on, since
  /// it would keep a lost device's memory alive.
  ~PlacedMeshes();
  PlacedMeshes(const PlacedMeshes&) = delete;
  PlacedMeshes& operator=(const PlacedMeshes&) = delete;
  MeshStore& store() const { return *store_; }

 private:
  struct Import;
  PlacedMeshes(Device& device, std::shared_ptr<MeshStore> store) : device_(device), store_(std::move(store)) {}
  /// Imports the block into the device.
  Result<std::shared_ptr<const ImportedMemory>> import(SharedBlock& block);

  Device& device_;
  const std::shared_ptr<MeshStore> store_;
  std::mutex mutex_;                            ///< guards the following
  std::vector<std::weak_ptr<Import>> imports_;  ///< our entries in the blocks
};

}  // namespace sgm::cuda
