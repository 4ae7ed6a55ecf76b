#pragma once
// Meshes that stay in memory of another API's, on the device that draws them: copied there out of a batch's memory.

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/mesh_store.h"
#include "cuda/device.h"
#include "cuda/kept_meshes.h"

namespace sgm::cuda {

/// Any thread may use it. Outlived by the device.
class PlacedMeshes {
 public:
  /// Errors: unsupported, the store is another GPU's or the device cannot import its memory; out_of_memory,
  /// device_lost.
  static Result<std::unique_ptr<PlacedMeshes>> create(Device& device, std::shared_ptr<MeshStore> store);

  /// Copies parts by the stream, in its own time. To be published once that has been waited for (Placement).
  /// Errors: as Stream::copy; nothing is being copied any more then. Throws std::bad_alloc.
  Result<std::unique_ptr<Placement>> keep(Stream& stream, std::span<const PartSources> chunks);
  /// Nothing that it gave is written to any more. Ends what it has imported, though blocks live on: that would keep a
  /// lost device's memory.
  ~PlacedMeshes();
  PlacedMeshes(const PlacedMeshes&) = delete;
  PlacedMeshes& operator=(const PlacedMeshes&) = delete;
  MeshStore& store() const { return *store_; }

 private:
  struct Import;
  PlacedMeshes(Device& device, std::shared_ptr<MeshStore> store) : device_(device), store_(std::move(store)) {}
  /// The block as the device sees it.
  Result<std::shared_ptr<const ImportedMemory>> import(SharedBlock& block);

  Device& device_;
  const std::shared_ptr<MeshStore> store_;
  std::mutex mutex_;                            ///< guards what follows
  std::vector<std::weak_ptr<Import>> imports_;  ///< what blocks have of ours
};

}  // namespace sgm::cuda
