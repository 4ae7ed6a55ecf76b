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

/// One order between what the disk had and what is handed out.
struct InWork {
  ChunkRequest request, rest;  ///< rest: without what the disk had
  const ChunkSurface* before;
  std::optional<ChunkPartInputs> inputs;
  std::array<std::optional<ChunkPart>, kChunkParts> found;
  PlacedChunk chunk;
  std::optional<Error> error;

  InWork(const ChunkOrder& order, std::pmr::memory_resource* memory)
      : request(order.request), before(order.before), chunk{order.request.key, {}, ChunkMesh(memory), {}} {
    if (!request.body) request.signs = request.anchors = false;
    rest = request;
  }
  bool isToMesh() const { return !error && (rest.body || rest.seams != 0); }
};

void lookUp(const ChunkMesher& mesher, const EditSnapshot* edits, InWork& work) {
  const Result<ChunkGrid> grid = chunkGrid(mesher.world, work.request.key);
  if (!grid) {
    work.error = grid.error();
    return;
  }
  work.chunk.grid = *grid;
  if (mesher.cache == nullptr || !mesher.backend.capabilities().exact) return;
  work.inputs = ChunkPartInputs::of(mesher.world, work.request, edits);
  for (int part = 0; work.inputs && part < kChunkParts; ++part) {
    if (!asksFor(work.request, part)) continue;
    std::optional<ChunkPart>& of_part = work.found[static_cast<size_t>(part)];
    of_part = fetch(*mesher.cache, *work.inputs, part, mesher.memory);
    if (of_part) leaveOut(part, work.rest);
  }
}

/// Those of the numbers, together; where that fails each alone, so that one does not fail all.
void meshRest(const ChunkMesher& mesher, const EditSnapshot* edits, std::span<const size_t> numbers,
              std::vector<InWork>& work) {
  std::vector<ChunkRequest> requests;
  for (const size_t i : numbers) {
    requests.push_back(work[i].rest);
    requests.back().resident = mesher.resident;
  }
  Result<std::pmr::vector<PlacedChunk>> meshed =
      meshChunks(mesher.world, mesher.backend, mesher.jobs, requests, {}, edits);
  if (meshed) {
    for (size_t k = 0; k < numbers.size(); ++k) work[numbers[k]].chunk = std::move((*meshed)[k]);
  } else if (numbers.size() == 1) {
    work[numbers[0]].error = meshed.error();
  } else {
    for (const size_t& i : numbers) meshRest(mesher, edits, {&i, 1}, work);
  }
}

MeshedChunk finish(const ChunkMesher& mesher, InWork& work) {
  VoidComponents voids(mesher.memory);
  if (work.isToMesh()) {
    work.chunk.anchors.shrink_to_fit();
    if (work.rest.signs) voids = voidsOf(work.chunk.mesh);
    // A body from the cache was sampled, and a chunk that is drawn most likely.
    const bool sampled = work.request.body ? !work.chunk.mesh.uniform : work.before != nullptr;
    if (work.inputs) keep(*mesher.cache, *work.inputs, work.rest, work.chunk, voids, sampled, mesher.memory);
  }
  for (int part = 0; part < kChunkParts; ++part) {
    if (auto& of_part = work.found[static_cast<size_t>(part)]) place(std::move(*of_part), part, work.chunk, voids);
  }
  const ProfileScope scope(mesher.world.profiler(), zone::kPack);
  if (mesher.resident) bring(mesher.backend, work.request, work.chunk);
  MeshedChunk result{surfaceOf(work.request, std::move(work.chunk), work.before, mesher.memory), std::nullopt};
  if (work.request.signs) result.voids = std::move(voids);
  return result;
}

}  // namespace

Result<MeshedChunk> ChunkMesher::mesh(const ChunkRequest& request, const ChunkSurface* before,
                                      const EditSnapshot* edits) const {
  const ChunkOrder order{request, before};
  return std::move(mesh({&order, 1}, edits).front());
}

std::vector<Result<MeshedChunk>> ChunkMesher::mesh(std::span<const ChunkOrder> orders,
                                                   const EditSnapshot* edits) const {
  std::vector<InWork> work;
  work.reserve(orders.size());
  for (const ChunkOrder& order : orders) work.emplace_back(order, memory);
  parallelFor(jobs, work.size(), [&](size_t i) { lookUp(*this, edits, work[i]); });
  std::vector<size_t> to_mesh;
  for (size_t i = 0; i < work.size(); ++i) {
    if (work[i].isToMesh()) to_mesh.push_back(i);
  }
  if (!to_mesh.empty()) meshRest(*this, edits, to_mesh, work);
  std::vector<std::optional<MeshedChunk>> finished(work.size());
  parallelFor(jobs, work.size(), [&](size_t i) {
    if (!work[i].error) finished[i] = finish(*this, work[i]);
  });
  std::vector<Result<MeshedChunk>> results;
  results.reserve(work.size());
  for (size_t i = 0; i < work.size(); ++i) {
    if (finished[i]) {
      results.emplace_back(std::move(*finished[i]));
    } else {
      results.emplace_back(std::move(*work[i].error));
    }
  }
  return results;
}

}  // namespace sgm
