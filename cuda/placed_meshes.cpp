#include "cuda/placed_meshes.h"

#include <algorithm>
#include <vector>

namespace sgm::cuda {

/// The import of a memory block into one device. After a loss of the device, a newly opened device must import the
/// block again.
struct PlacedMeshes::Import {
  std::mutex mutex;  ///< guards `of` and `memory`
  /// the owner of the import; null after the owner's destruction, so that a later object at the same address does not
  /// count as the owner
  const PlacedMeshes* of;
  std::shared_ptr<const ImportedMemory> memory;
};

namespace {

/// Unless given() is called, the destructor waits for the copies in the stream. They write to the placement, and after
/// a failure no other code would wait for them.
class Writing {
 public:
  Writing(Stream& stream, MeshPlacement& placement) : stream_(stream), placement_(placement) {
    placement.writing = true;
  }
  ~Writing() {
    if (given_) return;
    try {
      if (stream_.wait()) placement_.writing = false;
    } catch (const std::bad_alloc&) {
      // wait() threw while it made an error's message, which happens only if the device is lost
    }
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  void given() { given_ = true; }

 private:
  Stream& stream_;
  MeshPlacement& placement_;
  bool given_ = false;
};

PartSizes sizesOf(const PartSources& sources) {
  PartSizes sizes;
  for (size_t p = 0; p < sources.size(); ++p) sizes[p] = {sources[p].vertex_count, sources[p].index_count};
  return sizes;
}

}  // namespace

Result<std::unique_ptr<PlacedMeshes>> PlacedMeshes::create(Device& device, std::shared_ptr<MeshStore> store) {
  if (store->device() != device.info().id) {
    return Error{Code::unsupported, device.info().name + " is not the drawing GPU"};
  }
  std::unique_ptr<PlacedMeshes> meshes(new PlacedMeshes(device, std::move(store)));
  // Try to import a block now, so that a failure is found before the first mesh is made.
  PartSizes least{};
  least[0] = {1, 1};
  const std::unique_ptr<MeshPlacement> trial = meshes->store_->place({&least, 1});
  if (trial->parts.empty()) return Error{Code::out_of_memory, "the drawing device has no memory for a single mesh"};
  for (const PartPlace& part : trial->parts) {
    const auto imported = meshes->import(*part.block);
    if (imported) continue;
    const Error& why = imported.error();
    const bool plain = why.code == Code::out_of_memory || why.code == Code::device_lost;
    return Error{plain ? why.code : Code::unsupported, why.message};
  }
  return meshes;
}

PlacedMeshes::~PlacedMeshes() {
  for (const std::weak_ptr<Import>& weak : imports_) {
    const std::shared_ptr<Import> import = weak.lock();
    if (!import) continue;
    const std::scoped_lock lock(import->mutex);
    import->of = nullptr;
    import->memory = nullptr;
  }
}

Result<std::shared_ptr<const ImportedMemory>> PlacedMeshes::import(SharedBlock& block) {
  // Lock, because after a loss of the device two PlacedMeshes objects may import the same block at once: the new
  // device's object, and the lost device's object with its last batches.
  const std::scoped_lock lock(block.importing);
  if (const auto known = std::static_pointer_cast<Import>(block.imported)) {
    const std::scoped_lock of_import(known->mutex);
    if (known->of == this) return known->memory;
  }
  Result<std::shared_ptr<const ImportedMemory>> made = device_.import(block);
  if (!made) return made.error();
  auto import = std::make_shared<Import>();
  import->of = this;
  import->memory = *made;
  {
    const std::scoped_lock of_list(mutex_);
    std::erase_if(imports_, [](const auto& one) { return one.expired(); });
    imports_.push_back(import);
  }
  block.imported = std::move(import);
  return made;
}

Result<std::unique_ptr<MeshPlacement>> PlacedMeshes::keep(Stream& stream, std::span<const PartSources> chunks) {
  std::vector<PartSizes> sizes(chunks.size());
  std::transform(chunks.begin(), chunks.end(), sizes.begin(), sizesOf);
  std::unique_ptr<MeshPlacement> placement = store_->place(sizes);
  Writing writing(stream, *placement);
  for (const PartPlace& part : placement->parts) {
    const Result<std::shared_ptr<const ImportedMemory>> imported = import(*part.block);
    if (!imported) {
      // Treat a failed import as a lack of memory: the chunk's mesh does not stay on the device.
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
  writing.given();
  return placement;
}

}  // namespace sgm::cuda
