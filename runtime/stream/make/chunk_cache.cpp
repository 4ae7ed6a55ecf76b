#include "stream/make/chunk_cache.h"

#include "stream/plan/reachability.h"

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

struct FoundBaked {
  ChunkPart part;
  bool is_far;
};

std::optional<FoundBaked> fetchBaked(BakedParts& baked, const BakedWorld& world, const ChunkPartInputs& inputs,
                                     int part, Reach reach, std::pmr::memory_resource* memory) {
  const ChunkRequest& request = inputs.request();
  const auto stored = baked.get(world, request.key, part, reach, memory);
  if (!stored) return std::nullopt;
  std::optional<ChunkPart> found = decodeChunkPart(stored->bytes, part, inputs.asBaked(), memory, BytesAre::whole);
  if (!found) {
    baked.reject(world, request.key, part, reach);
    return std::nullopt;
  }
  if (!request.anchors) found->anchors.clear();
  if (!request.signs) found->voids.clear();
  return FoundBaked{std::move(*found), stored->is_far};
}

/// Copies a part that came from a server to the disk cache. Parts without triangles are not copied: the store's record
/// of their tile (block of 8 x 8 x 8 chunks) already contains them.
void keepBaked(DiskCache& cache, const ChunkPartInputs& inputs, int part, const ChunkPart& found,
               std::pmr::memory_resource* memory) try {
  if (found.mesh.indices.empty()) return;
  cache.put(cache.keyOf(inputs.bytes(part)), encodeChunkPart(part, found.mesh, found.anchors, found.voids, memory));
} catch (const std::bad_alloc&) {
  // Memory ran out: the part is not cached, and the next request fetches it from the server again.
}

/// Looks up a part in the disk cache and in the stores. If a store is on a server, the disk cache is tried first;
/// otherwise the stores are.
std::optional<ChunkPart> lookUp(DiskCache* cache, BakedParts* baked, const BakedWorld& world,
                                const ChunkPartInputs& inputs, int part, Reach reach,
                                std::pmr::memory_resource* memory) {
  const bool cache_first = cache != nullptr && baked != nullptr && baked->isFar();
  std::optional<ChunkPart> kept;
  if (cache_first) kept = fetch(*cache, inputs, part, memory);
  if (kept) return kept;
  if (baked != nullptr && inputs.isAsBaked(part)) {
    if (auto found = fetchBaked(*baked, world, inputs, part, reach, memory)) {
      if (found->is_far && cache != nullptr) keepBaked(*cache, inputs, part, found->part, memory);
      return std::move(found->part);
    }
  }
  if (!cache_first && cache != nullptr) kept = fetch(*cache, inputs, part, memory);
  return kept;
}

void leaveOut(int part, ChunkRequest& request) {
  if (part == 0) {
    request.body = request.signs = request.anchors = false;
  } else {
    request.seams = static_cast<uint8_t>(request.seams & ~(1 << (part - 1)));
  }
}

/// Stores the requested parts in the cache. Exception: if the chunk was proven solid or void without sampling, its
/// empty parts are not stored. Such a proof takes as long as reading a file, and a tenth of the time of writing one.
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
  // Memory ran out: the parts are not cached, and the next request meshes them again.
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

ChunkRequest completed(ChunkRequest request, bool sharp) {
  request.sharp = sharp;
  if (!request.body) request.signs = request.anchors = false;
  return request;
}

/// Returns the inputs that identify the parts of a request in the cache and the stores; nullopt if these parts are
/// never stored, for example parts from an inexact backend.
std::optional<ChunkPartInputs> inputsOf(const ChunkMesher& mesher, const ChunkRequest& request,
                                        const EditSnapshot* edits) {
  if ((mesher.cache == nullptr && mesher.baked == nullptr) || !mesher.backend.capabilities().exact) return {};
  return ChunkPartInputs::of(mesher.world, request, edits);
}

using Parts = decltype(FoundParts::parts);

Parts lookUp(const ChunkMesher& mesher, const ChunkPartInputs& inputs, Reach reach) {
  const ChunkRequest& request = inputs.request();
  Parts found;
  BakedWorld world;
  if (mesher.baked != nullptr) {
    world.key = mesher.baked->worldOf(*bakedWorldInputs(mesher.world, request.sharp));
    world.former_key = [&mesher, sharp = request.sharp] {
      return mesher.baked->worldOf(*formerBakedWorldInputs(mesher.world, sharp));
    };
  }
  for (int part = 0; part < kChunkParts; ++part) {
    if (!asksFor(request, part)) continue;
    found[static_cast<size_t>(part)] = lookUp(mesher.cache, mesher.baked, world, inputs, part, reach, mesher.memory);
  }
  return found;
}

/// Returns the prefetched parts whose inputs have not changed since the prefetch; looks up the other parts in the cache
/// and in stores on this machine.
Parts stillFound(const ChunkMesher& mesher, FoundParts&& found, const ChunkPartInputs& inputs) {
  Parts still;
  std::optional<Parts> near;
  for (int part = 0; part < kChunkParts; ++part) {
    if (!asksFor(inputs.request(), part)) continue;
    const auto p = static_cast<size_t>(part);
    const bool is_same = found.inputs.bytes(part) == inputs.bytes(part);
    if (!is_same && !near) near = lookUp(mesher, inputs, Reach::near);
    still[p] = std::move(is_same ? found.parts[p] : (*near)[p]);
  }
  return still;
}

/// A MeshOrder that is being processed.
struct InWork {
  ChunkRequest request, rest;  ///< request: all parts; rest: the parts that were not found and must be meshed
  const ChunkSurface* before;
  std::optional<ChunkPartInputs> inputs;
  Parts found;
  PlacedChunk chunk;
  VoidComponents voids;
  std::optional<Error> error;

  InWork(const MeshOrder& order, bool sharp, std::pmr::memory_resource* memory)
      : request(completed(order.request, sharp)),
        rest(request),
        before(order.before),
        chunk{order.request.key, {}, ChunkMesh(memory), {}},
        voids(memory) {}
  bool isToMesh() const { return !error && (rest.body || rest.seams != 0); }
};

void begin(const ChunkMesher& mesher, const EditSnapshot* edits, FoundParts* found, InWork& work) {
  const Result<ChunkGrid> grid = chunkGrid(mesher.world, work.request.key);
  if (!grid) {
    work.error = grid.error();
    return;
  }
  work.chunk.grid = *grid;
  work.inputs = inputsOf(mesher, work.request, edits);
  if (!work.inputs) return;
  work.found = found != nullptr ? stillFound(mesher, std::move(*found), *work.inputs)
                                : lookUp(mesher, *work.inputs, Reach::near);
  for (int part = 0; part < kChunkParts; ++part) {
    if (work.found[static_cast<size_t>(part)]) leaveOut(part, work.rest);
  }
}

/// Meshes the missing parts of several orders together. If that fails, meshes each half separately, so that only the
/// order that causes the error fails. numbers: indices into `work`.
void meshRest(const ChunkMesher& mesher, const EditSnapshot* edits, std::span<const size_t> numbers,
              const Progress& progress, std::vector<InWork>& work) {
  if (numbers.empty()) return;
  std::vector<ChunkRequest> requests;
  for (const size_t i : numbers) {
    requests.push_back(work[i].rest);
    requests.back().keys = false;
    requests.back().resident = mesher.resident;
    requests.back().prompt = true;
  }
  Result<std::pmr::vector<PlacedChunk>> meshed =
      meshChunks(mesher.world, mesher.backend, mesher.jobs, requests, progress, edits);
  if (meshed) {
    for (size_t k = 0; k < numbers.size(); ++k) work[numbers[k]].chunk = std::move((*meshed)[k]);
  } else if (numbers.size() == 1 || meshed.error().code == Code::cancelled) {
    for (const size_t i : numbers) work[i].error = meshed.error();
  } else {
    const size_t half = numbers.size() / 2;
    meshRest(mesher, edits, numbers.first(half), progress, work);
    meshRest(mesher, edits, numbers.subspan(half), progress, work);
  }
}

/// Stores the parts that were meshed in the cache, and adds the parts that were found to the chunk.
void complete(const ChunkMesher& mesher, InWork& work) {
  if (work.isToMesh()) {
    work.chunk.anchors.shrink_to_fit();
    if (work.rest.signs) work.voids = voidsOf(work.chunk.mesh);
    // `sampled` states whether the chunk's body had to be sampled. If only seams are requested, this is not known: then
    // assume that it was sampled if the chunk already has a surface.
    const bool sampled = work.request.body ? !work.chunk.mesh.uniform : work.before != nullptr;
    if (work.inputs && mesher.cache != nullptr)
      keep(*mesher.cache, *work.inputs, work.rest, work.chunk, work.voids, sampled, mesher.memory);
  }
  for (int part = 0; part < kChunkParts; ++part) {
    if (auto& of_part = work.found[static_cast<size_t>(part)]) place(std::move(*of_part), part, work.chunk, work.voids);
  }
}

/// Uploads parts to the compute device that it has not meshed itself: parts from the disk, and parts that the CPU has
/// meshed. If an upload fails, the device lacks these parts, which is not an error.
void upload(Backend& backend, std::span<InWork> all) {
  std::vector<const MeshPart*> parts;
  std::vector<std::shared_ptr<const DevicePart>*> places;
  for (InWork& work : all) {
    const MeshParts meshes = partsOf(work.chunk.mesh);
    for (int part = 0; part < kChunkParts && !work.error; ++part) {
      const auto p = static_cast<size_t>(part);
      if (!asksFor(work.request, part) || meshes[p] == nullptr || meshes[p]->indices.empty()) continue;
      if (work.chunk.mesh.on_device[p] && work.chunk.mesh.on_device[p]->there()) continue;
      parts.push_back(meshes[p]);
      places.push_back(&work.chunk.mesh.on_device[p]);
    }
  }
  if (parts.empty()) return;
  auto brought = backend.upload(parts);
  for (size_t i = 0; brought && i < places.size(); ++i) *places[i] = std::move((*brought)[i]);
}

MeshedChunk surfaced(const ChunkMesher& mesher, InWork& work) {
  const ProfileScope scope(mesher.world.profiler(), zone::kPack);
  std::optional<measure::ChunkMeasures> measures;
  MadeMeasures measured;
  if (mesher.measuring != nullptr) {
    measures = measureParts(work.request, work.chunk, work.before, *mesher.measuring, measured);
  }
  const uint32_t rounded = work.chunk.mesh.rounded;
  MeshedChunk result{surfaceOf(work.request, std::move(work.chunk), work.before, mesher.memory), std::nullopt, measured,
                     rounded, !work.isToMesh()};
  result.surface.measures = measures;
  if (work.request.signs) result.voids = std::move(work.voids);
  return result;
}

/// Calls `body` on the job system for each order that has no error. If `body` throws std::bad_alloc, sets the order's
/// error to out_of_memory.
template <class Body>
void forEach(JobSystem& jobs, std::vector<InWork>& work, const Body& body) {
  parallelFor(jobs, work.size(), [&](size_t i) {
    if (work[i].error) return;
    try {
      body(i);
    } catch (const std::bad_alloc&) {
      work[i].error = Error{Code::out_of_memory, "out of memory"};
    }
  });
}

}  // namespace

std::optional<FoundParts> ChunkMesher::find(const ChunkRequest& request, const EditSnapshot* edits) const {
  const ChunkRequest of = completed(request, sharp);
  if (!chunkGrid(world, of.key)) return std::nullopt;
  std::optional<ChunkPartInputs> inputs = inputsOf(*this, of, edits);
  if (!inputs) return std::nullopt;
  Parts parts = lookUp(*this, *inputs, Reach::far);
  return FoundParts{std::move(parts), std::move(*inputs)};
}

Result<MeshedChunk> ChunkMesher::mesh(const ChunkRequest& request, const ChunkSurface* before,
                                      const EditSnapshot* edits) const {
  const MeshOrder order{request, before};
  return std::move(mesh({&order, 1}, edits).front());
}

std::vector<Result<MeshedChunk>> ChunkMesher::mesh(std::span<const MeshOrder> orders, const EditSnapshot* edits,
                                                   const Progress& progress) const {
  std::vector<InWork> work;
  work.reserve(orders.size());
  for (const MeshOrder& order : orders) work.emplace_back(order, sharp, memory);
  forEach(jobs, work, [&](size_t i) { begin(*this, edits, orders[i].found, work[i]); });
  std::vector<size_t> to_mesh;
  for (size_t i = 0; i < work.size(); ++i) {
    if (work[i].isToMesh()) to_mesh.push_back(i);
  }
  meshRest(*this, edits, to_mesh, progress, work);
  forEach(jobs, work, [&](size_t i) { complete(*this, work[i]); });
  if (resident) upload(backend, work);
  std::vector<std::optional<MeshedChunk>> finished(work.size());
  forEach(jobs, work, [&](size_t i) { finished[i] = surfaced(*this, work[i]); });
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
