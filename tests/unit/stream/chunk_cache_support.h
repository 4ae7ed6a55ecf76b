#pragma once
// Meshes chunks of the sample grammars, with a disk cache.

#include "backend/open/open_backend.h"
#include "chunk/chunk_part.h"
#include "store/disk_cache_support.h"
#include "stream/make/chunk_cache.h"
#include "world/edits_support.h"
#include "world/world_support.h"

namespace sgm {

inline constexpr uint64_t kAmple = uint64_t{1} << 30;

/// A grammar's world, and a box in it that contains much surface.
struct Excerpt {
  std::string grammar;
  int32_t cell;
  IntBox box;

  WorldFieldSettings settings() const { return settingsOf(yardstick(grammar), cell, 3); }
};

inline IntBox around(int32_t x, int32_t y, int32_t z, int32_t metres) {
  const Int3 middle{x * 1024, y * 1024, z * 1024};
  return IntBox{middle, middle}.grown(metres * 1024);
}

inline const std::vector<Excerpt>& scenes() {
  static const std::vector<Excerpt> all{{"cave.sgm", 256, around(112, 96, 96, 24)},
                                        {"cloud.sgm", 4096, around(450, 1200, 450, 600)},
                                        {"combine.sgm", 256, around(0, 0, 0, 12)}};
  return all;
}

/// Everything that meshing needs, except the field: threads and a backend.
struct Machine {
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(1);
  std::unique_ptr<Backend> backend = *makeBackend({}, *jobs, std::pmr::get_default_resource());

  ChunkMesher mesher(const WorldField& world, DiskCache* cache) const {
    return {world, *backend, *jobs, std::pmr::get_default_resource(), cache};
  }
};

/// Meshes a chunk as a streamed world does: if the store is on a server, its parts are fetched before meshing.
inline Result<MeshedChunk> tryToMesh(const ChunkMesher& mesher, const ChunkRequest& request,
                                     const ChunkSurface* before = nullptr, const EditSnapshot* edits = nullptr) {
  if (mesher.baked == nullptr || !mesher.baked->isFar()) return mesher.mesh(request, before, edits);
  std::optional<FoundParts> found = mesher.find(request, edits);
  const MeshOrder order{request, before, found ? &*found : nullptr};
  return std::move(mesher.mesh({&order, 1}, edits).front());
}

inline MeshedChunk meshed(const ChunkMesher& mesher, const ChunkRequest& request, const ChunkSurface* before = nullptr,
                          const EditSnapshot* edits = nullptr) {
  Result<MeshedChunk> chunk = tryToMesh(mesher, request, before, edits);
  INFO((chunk ? "" : chunk.error().message));
  REQUIRE(chunk);
  return std::move(*chunk);
}

inline bool same(const Anchor& a, const Anchor& b) {
  return a.frame.origin == b.frame.origin && a.frame.rows == b.frame.rows && a.kind == b.kind && a.name == b.name &&
         a.tag == b.tag && a.key == b.key;
}

inline bool same(const MeshedChunk& a, const MeshedChunk& b) {
  const ChunkSurface &s = a.surface, &t = b.surface;
  const auto &u = s.mesh.vertices, &v = t.mesh.vertices;
  return s.key == t.key && s.grid.origin == t.grid.origin && s.grid.cell == t.grid.cell &&
         s.grid.level == t.grid.level && u.size() == v.size() &&
         (u.empty() || std::memcmp(u.data(), v.data(), u.size() * sizeof(Vertex)) == 0) &&
         s.mesh.indices == t.mesh.indices && s.mesh.ranges == t.mesh.ranges && s.seams == t.seams &&
         s.bounds.lo == t.bounds.lo && s.bounds.hi == t.bounds.hi && s.tags == t.tags && s.hash == t.hash &&
         s.bytes() == t.bytes() &&
         std::equal(s.anchors.begin(), s.anchors.end(), t.anchors.begin(), t.anchors.end(),
                    [](const Anchor& x, const Anchor& y) { return same(x, y); }) &&
         a.voids == b.voids;
}

inline ChunkRequest randomRequest(std::mt19937& random, const Excerpt& scene) {
  ChunkRequest request;
  request.key.level = static_cast<int>(random() % 3);
  const Int3 at = randomPlace(random, scene.box);
  const int64_t edge = int64_t{kChunkCells} * scene.cell << request.key.level;
  for (int axis = 0; axis < 3; ++axis) request.key.at[axis] = static_cast<int32_t>(floorDiv(at[axis], edge));
  request.seams = static_cast<uint8_t>(random() % 2 ? random() % 64 : 0);
  request.coarser = random() % (Neighbourhood{1} << 26);
  request.signs = random() % 2;
  request.anchors = random() % 2;
  request.outermost = random() % 4 == 0;
  return request;
}

inline uint64_t partCount(const ChunkRequest& request) {
  uint64_t parts = 0;
  for (int part = 0; part < kChunkParts; ++part) parts += asksFor(request, part);
  return parts;
}

/// Number of parts with triangles.
inline uint64_t drawnParts(const ChunkSurface& surface) {
  const auto& ranges = surface.mesh.ranges;
  return static_cast<uint64_t>(
      std::count_if(ranges.begin(), ranges.end(), [](const PackedRange& range) { return range.index_count > 0; }));
}

/// Whether the chunk must be sampled, because it cannot be proven solid or void.
inline bool sampled(const Machine& machine, const WorldField& world, const ChunkRequest& request,
                    const EditSnapshot* edits) {
  const auto chunks = meshChunks(world, *machine.backend, *machine.jobs, {&request, 1}, {}, edits);
  REQUIRE(chunks);
  return !chunks->front().mesh.uniform;
}

inline std::shared_ptr<const EditSnapshot> randomEdits(std::mt19937& random, const Excerpt& scene, int count) {
  EditSnapshot edits;
  for (int i = 1; i <= count; ++i) {
    const auto number = static_cast<uint64_t>(i);
    edits = edits.with({number, {1, number}}, randomBrush(random, scene.box, 10 * scene.cell));
  }
  return std::make_shared<EditSnapshot>(edits);
}

inline std::vector<std::byte> inputsOf(const WorldField& world, const ChunkRequest& request, int part,
                                       const EditSnapshot* edits = nullptr) {
  const auto inputs = ChunkPartInputs::of(world, request, edits);
  REQUIRE(inputs);
  return inputs->bytes(part);
}

inline ChunkRequest caveRequest() {
  ChunkRequest request;
  request.key = {0, {14, 11, 11}};  // this chunk contains a part of a hall, and the hall's anchor
  request.signs = request.anchors = true;
  request.seams = 5;
  return request;
}

}  // namespace sgm
