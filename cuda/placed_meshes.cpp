#include "cuda/placed_meshes.h"

#include <algorithm>
#include <vector>

namespace sgm::cuda {

namespace {

/// What a block's memory is to one device; to another, after a loss, it is nothing.
struct Import {
  std::shared_ptr<const char> mark;
  std::shared_ptr<const ImportedMemory> memory;
};

PartSizes sizesOf(const PartSources& sources) {
  PartSizes sizes;
  for (size_t p = 0; p < sources.size(); ++p) sizes[p] = {sources[p].vertex_count, sources[p].index_count};
  return sizes;
}

}  // namespace

Result<std::unique_ptr<PlacedMeshes>> PlacedMeshes::create(Device& device, std::shared_ptr<MeshStore> store) {
  if (store->device() != device.info().id) {
    return Error{Code::unsupported, device.info().name + " is not the GPU that draws"};
  }
  std::unique_ptr<PlacedMeshes> meshes(new PlacedMeshes(device, std::move(store)));
  // One that cannot import would tell only when the first mesh has been made.
  PartSizes least{};
  least[0] = {1, 1};
  const std::unique_ptr<Placement> trial = meshes->store_->place({&least, 1});
  for (const PartPlace& part : trial->parts) {
    const auto imported = meshes->import(*part.block);
    if (!imported) return imported.error();
  }
  return meshes;
}

Result<std::shared_ptr<const ImportedMemory>> PlacedMeshes::import(SharedBlock& block) {
  // After a loss two sessions may be at it, the old one with its last batches.
  const std::scoped_lock lock(block.importing);
  const auto known = std::static_pointer_cast<const Import>(block.imported);
  if (known && known->mark == mark_) return known->memory;
  Result<std::shared_ptr<const ImportedMemory>> made = device_.import(block);
  if (!made) return made.error();
  block.imported = std::make_shared<const Import>(Import{mark_, *made});
  return made;
}

Result<std::unique_ptr<Placement>> PlacedMeshes::keep(Stream& stream, std::span<const PartSources> chunks) {
  std::vector<PartSizes> sizes(chunks.size());
  std::transform(chunks.begin(), chunks.end(), sizes.begin(), sizesOf);
  std::unique_ptr<Placement> placement = store_->place(sizes);
  placement->writing = true;
  for (const PartPlace& part : placement->parts) {
    const Result<std::shared_ptr<const ImportedMemory>> imported = import(*part.block);
    if (!imported) {
      // As where there is no room.
      placement->chunks[part.chunk] = {};
      continue;
    }
    if (placement->held.empty() || placement->held.back() != *imported) placement->held.push_back(*imported);
    std::byte* const block = (*imported)->data();
    const PartSource& source = chunks[part.chunk][part.part];
    if (Result<void> copied = stream.copy(block + part.vertices, source.vertices, source.vertex_count * sizeof(Vertex));
        !copied) {
      return copied.error();
    }
    if (Result<void> copied = stream.copy(block + part.indices, source.indices, source.index_count * sizeof(uint32_t));
        !copied) {
      return copied.error();
    }
  }
  if (Result<void> marked = stream.mark(); !marked) return marked.error();
  return placement;
}

}  // namespace sgm::cuda
