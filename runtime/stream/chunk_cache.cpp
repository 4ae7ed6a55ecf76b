#include "stream/chunk_cache.h"

#include "stream/chunk_part.h"
#include "stream/reachability.h"

namespace sgm {
namespace {

std::optional<ChunkPart> fetch(DiskCache& cache, const ChunkPartInputs& inputs, int part,
                               std::pmr::memory_resource* memory) {
  const DiskKey key = cache.keyOf(inputs.bytes(part));
  const auto bytes = cache.get(key, memory);
  if (!bytes) return std::nullopt;
  std::optional<ChunkPart> found = decodeChunkPart(*bytes, part, inputs, memory);
  if (!found) cache.reject(key);
  return found;
}

void leaveOut(int part, ChunkRequest& request) {
  if (part == 0) {
    request.body = request.signs = request.anchors = false;
  } else {
    request.seams = static_cast<uint8_t>(request.seams & ~(1 << (part - 1)));
  }
}

/// Keeps what the request asks for: of a chunk that was not sampled, but proven solid or void as a whole, no part
/// without triangles. That proof takes no longer than a file takes to read, and a tenth of what it takes to write.
void keep(DiskCache& cache, const ChunkPartInputs& inputs, const ChunkRequest& request, const PlacedChunk& chunk,
          const VoidComponents& voids, bool sampled, std::pmr::memory_resource* memory) try {
  const MeshParts meshes = partsOf(chunk.mesh);
  for (int part = 0; part < kChunkParts; ++part) {
    if (!asksFor(request, part)) continue;
    const MeshPart& mesh = *meshes[static_cast<size_t>(part)];
    if (mesh.indices.empty() && !sampled) continue;
    cache.put(cache.keyOf(inputs.bytes(part)), encodeChunkPart(part, mesh, chunk.anchors, voids, memory));
  }
} catch (const std::bad_alloc&) {
  // It is meshed again the next time.
}

void place(ChunkPart&& found, int part, PlacedChunk& chunk, VoidComponents& voids) {
  if (part == 0) {
    chunk.mesh.body = std::move(found.mesh);
    chunk.anchors = std::move(found.anchors);
    voids = std::move(found.voids);
    return;
  }
  std::vector<MeshPart>& seams = chunk.mesh.seams;
  while (seams.size() < kChunkParts - 1) seams.emplace_back(found.mesh.vertices.get_allocator().resource());
  seams[static_cast<size_t>(part - 1)] = std::move(found.mesh);
}

/// Brings to the device what it has not meshed itself: what comes from the disk, and what the CPU has meshed for it.
void bring(Backend& backend, const ChunkRequest& request, PlacedChunk& chunk) {
  const MeshParts meshes = partsOf(chunk.mesh);
  for (int part = 0; part < kChunkParts; ++part) {
    const auto p = static_cast<size_t>(part);
    if (!asksFor(request, part) || meshes[p] == nullptr || meshes[p]->indices.empty()) continue;
    if (chunk.mesh.on_device[p]) continue;
    if (auto brought = backend.upload(*meshes[p])) chunk.mesh.on_device[p] = std::move(*brought);
  }
}

}  // namespace

Result<MeshedChunk> ChunkMesher::mesh(ChunkRequest request, const ChunkSurface* before,
                                      const EditSnapshot* edits) const {
  if (!request.body) request.signs = request.anchors = false;
  const Result<ChunkGrid> grid = chunkGrid(world, request.key);
  if (!grid) return grid.error();

  std::optional<ChunkPartInputs> inputs;
  if (cache != nullptr && backend.capabilities().exact) inputs = ChunkPartInputs::of(world, request, edits);
  std::array<std::optional<ChunkPart>, kChunkParts> found;
  ChunkRequest rest = request;
  for (int part = 0; inputs && part < kChunkParts; ++part) {
    if (!asksFor(request, part)) continue;
    std::optional<ChunkPart>& of_part = found[static_cast<size_t>(part)];
    of_part = fetch(*cache, *inputs, part, memory);
    if (of_part) leaveOut(part, rest);
  }

  PlacedChunk chunk{request.key, *grid, ChunkMesh(memory), {}};
  VoidComponents voids(memory);
  if (rest.body || rest.seams != 0) {
    rest.resident = resident;
    Result<std::pmr::vector<PlacedChunk>> meshed = meshChunks(world, backend, jobs, {&rest, 1}, {}, edits);
    if (!meshed) return meshed.error();
    chunk = std::move(meshed->front());
    chunk.anchors.shrink_to_fit();
    if (rest.signs) voids = voidsOf(chunk.mesh);
    // A body from the cache was sampled, and a chunk that is drawn most likely.
    const bool sampled = request.body ? !chunk.mesh.uniform : before != nullptr;
    if (inputs) keep(*cache, *inputs, rest, chunk, voids, sampled, memory);
  }
  for (int part = 0; part < kChunkParts; ++part) {
    if (auto& of_part = found[static_cast<size_t>(part)]) place(std::move(*of_part), part, chunk, voids);
  }
  const ProfileScope scope(world.profiler(), zone::kPack);
  if (resident) bring(backend, request, chunk);
  MeshedChunk result{surfaceOf(request, std::move(chunk), before, memory), std::nullopt};
  if (request.signs) result.voids = std::move(voids);
  return result;
}

}  // namespace sgm
