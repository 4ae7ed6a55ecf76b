#pragma once
// Meshes that stay in memory of another API's, on the device that draws them: copied there out of a batch's memory.

#include <memory>
#include <span>

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

  /// Copies parts by the stream, in its own time. To be published once that has been waited for; what is not is never
  /// used again. Errors: as Stream::copy. Throws std::bad_alloc.
  Result<std::unique_ptr<Placement>> keep(Stream& stream, std::span<const PartSources> chunks);
  MeshStore& store() const { return *store_; }

 private:
  PlacedMeshes(Device& device, std::shared_ptr<MeshStore> store) : device_(device), store_(std::move(store)) {}
  /// The block as the device sees it.
  Result<std::shared_ptr<const ImportedMemory>> import(SharedBlock& block);

  Device& device_;
  const std::shared_ptr<MeshStore> store_;
  /// Nobody else's, while anything of ours is imported.
  const std::shared_ptr<const char> mark_ = std::make_shared<const char>();
};

}  // namespace sgm::cuda
