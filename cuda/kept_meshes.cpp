#include "cuda/kept_meshes.h"

#include <cstring>
#include <new>
#include <utility>

namespace sgm::cuda {

namespace {

size_t aligned(size_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

size_t bytesOf(const PartSource& source) {
  if (source.index_count == 0) return 0;
  return aligned(source.vertex_count * sizeof(Vertex)) + aligned(source.index_count * sizeof(uint32_t));
}

/// Unless the parts are kept, the destructor waits for the copies in the stream. Otherwise the copies might write to
/// memory that is already free: another stream frees the parts, and does not wait for this stream.
class WaitUnlessKept {
 public:
  explicit WaitUnlessKept(Stream& stream) : stream_(stream) {}
  ~WaitUnlessKept() {
    if (kept_) return;
    try {
      static_cast<void>(stream_.wait());
    } catch (const std::bad_alloc&) {
      // wait() can throw only while it creates the message of an error; by then, the stream's work has ended, or the
      // device is lost
    }
  }
  WaitUnlessKept(const WaitUnlessKept&) = delete;
  WaitUnlessKept& operator=(const WaitUnlessKept&) = delete;
  void kept() { kept_ = true; }

 private:
  Stream& stream_;
  bool kept_ = false;
};

}  // namespace

KeptMemory::~KeptMemory() { meshes_.free(data_, bytes_); }

Result<std::unique_ptr<KeptMeshes>> KeptMeshes::create(Device& device, uint64_t cap) {
  std::unique_ptr<KeptMeshes> meshes(new KeptMeshes(device, cap));
  for (std::unique_ptr<Stream>* stream : {&meshes->ending_, &meshes->uploading_}) {
    Result<std::unique_ptr<Stream>> made = device.makeStream();
    if (!made) return made.error();
    *stream = std::move(*made);
  }
  return meshes;
}

Result<std::shared_ptr<const KeptMemory>> KeptMeshes::allocate(const std::shared_ptr<const void>& owner, Stream& stream,
                                                               size_t bytes) {
  std::shared_ptr<const KeptMemory> none;
  uint64_t taken = bytes_.load();
  do {
    if (bytes > cap_ || taken > cap_ - bytes) return none;
  } while (!bytes_.compare_exchange_weak(taken, taken + bytes));
  const Result<void*> made = stream.allocate(MemoryKind::device, bytes);
  if (!made) {
    bytes_.fetch_sub(bytes);
    if (made.error().code == Code::out_of_memory) return none;
    return made.error();
  }
  try {
    return std::shared_ptr<const KeptMemory>(
        std::make_shared<KeptMemory>(owner, *this, static_cast<std::byte*>(*made), bytes));
  } catch (const std::bad_alloc&) {
    stream.free(MemoryKind::device, *made);
    bytes_.fetch_sub(bytes);
    throw;
  }
}

void KeptMeshes::free(std::byte* data, size_t bytes) noexcept {
  const std::scoped_lock lock(ending_mutex_);
  ending_->free(MemoryKind::device, data);
  bytes_.fetch_sub(bytes);
}

Result<DeviceParts> KeptMeshes::keepChunk(const std::shared_ptr<const void>& owner, Stream& stream,
                                          const PartSources& sources, bool from_host) {
  DeviceParts parts;
  size_t bytes = 0;
  for (const PartSource& source : sources) bytes += bytesOf(source);
  if (bytes == 0) return parts;
  const Result<std::shared_ptr<const KeptMemory>> memory = allocate(owner, stream, bytes);
  if (!memory) return memory.error();
  if (!*memory) return parts;
  WaitUnlessKept waiting(stream);
  std::byte* at = (*memory)->data();
  const auto copy = [&](const void* from, size_t size) {
    std::byte* const to = std::exchange(at, at + aligned(size));
    return from_host ? stream.copyIn(to, from, size) : stream.copy(to, from, size);
  };
  for (size_t p = 0; p < sources.size(); ++p) {
    const PartSource& source = sources[p];
    if (source.index_count == 0) continue;
    auto part = std::make_shared<CudaPart>();
    part->memory = *memory;
    part->vertex_count = source.vertex_count;
    part->index_count = source.index_count;
    part->vertices = reinterpret_cast<const Vertex*>(at);
    if (Result<void> copied = copy(source.vertices, source.vertex_count * sizeof(Vertex)); !copied)
      return copied.error();
    part->indices = reinterpret_cast<const uint32_t*>(at);
    if (Result<void> copied = copy(source.indices, source.index_count * sizeof(uint32_t)); !copied)
      return copied.error();
    parts[p] = std::move(part);
  }
  waiting.kept();
  return parts;
}

Result<std::vector<DeviceParts>> KeptMeshes::keep(const std::shared_ptr<const void>& owner, Stream& stream,
                                                  std::span<const PartSources> chunks, bool from_host) {
  std::vector<DeviceParts> kept(chunks.size());
  WaitUnlessKept waiting(stream);
  for (size_t c = 0; c < chunks.size(); ++c) {
    Result<DeviceParts> parts = keepChunk(owner, stream, chunks[c], from_host);
    if (!parts) return parts.error();
    kept[c] = std::move(*parts);
  }
  if (Result<void> marked = stream.mark(); !marked) return marked.error();
  waiting.kept();
  return kept;
}

Result<std::vector<std::shared_ptr<const DevicePart>>> KeptMeshes::upload(const std::shared_ptr<const void>& owner,
                                                                          std::span<const MeshPart* const> parts) {
  std::vector<std::shared_ptr<const DevicePart>> brought(parts.size());
  size_t bytes = 0;
  for (const MeshPart* part : parts)
    bytes += aligned(part->vertices.size() * sizeof(Vertex)) + aligned(part->indices.size() * sizeof(uint32_t));
  if (bytes == 0) return brought;
  const std::scoped_lock lock(uploading_mutex_);
  if (Result<void> grown = staging_.grow(*uploading_, MemoryKind::pinned, bytes); !grown) return grown.error();
  std::byte* at = staging_.data();
  const auto stage = [&](const auto& array) {
    std::byte* const place = std::exchange(at, at + aligned(array.size() * sizeof(array[0])));
    if (!array.empty()) std::memcpy(static_cast<void*>(place), array.data(), array.size() * sizeof(array[0]));
    return place;
  };
  std::vector<PartSources> sources(parts.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    sources[i][0].vertices = reinterpret_cast<const Vertex*>(stage(parts[i]->vertices));
    sources[i][0].indices = reinterpret_cast<const uint32_t*>(stage(parts[i]->indices));
    sources[i][0].vertex_count = static_cast<uint32_t>(parts[i]->vertices.size());
    sources[i][0].index_count = static_cast<uint32_t>(parts[i]->indices.size());
  }
  Result<std::vector<DeviceParts>> kept = keep(owner, *uploading_, sources, true);
  if (!kept) return kept.error();
  if (Result<void> there = uploading_->wait(); !there) return there.error();
  for (size_t i = 0; i < parts.size(); ++i) brought[i] = std::move((*kept)[i][0]);
  return brought;
}

}  // namespace sgm::cuda
