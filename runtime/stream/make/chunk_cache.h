#pragma once
// One chunk of a world. Its parts come from baked stores, or else from the disk cache; with a store on a server, first
// from the disk cache. The rest is meshed and kept in the cache (chunk_part.h): parts with triangles, and those without
// triangles if the chunk had to be sampled to know.

#include <optional>
#include <span>
#include <vector>

#include "chunk/chunk_part.h"
#include "chunk/chunk_surface.h"
#include "chunk/world_measures.h"
#include "mesh/void_components.h"
#include "store/cache/baked_parts.h"
#include "store/cache/disk_cache.h"

namespace sgm {

/// What came of a request.
struct MeshedChunk {
  ChunkSurface surface;                 ///< may be without triangles
  std::optional<VoidComponents> voids;  ///< where signs were asked for
  MadeMeasures measured;                ///< of the parts that were asked for, without the time to mesh them
  uint32_t rounded = 0;                 ///< ChunkMesh::rounded, if the body was meshed now
  bool from_disk = false;               ///< all that was asked for
};

struct MeshOrder {
  ChunkRequest request;
  const ChunkSurface* before = nullptr;  ///< as surfaceOf takes it
  FoundParts* found = nullptr;           ///< by find; what the edits have changed since is not taken, the rest is
                                         ///< moved from. Null: what is near is found
};

/// Meshes the chunks of one world. Borrows all that it names; as thread-safe as they are.
struct ChunkMesher {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  std::pmr::memory_resource* memory;   ///< of what it gives
  DiskCache* cache = nullptr;          ///< null: everything is meshed
  BakedParts* baked = nullptr;         ///< null: nothing was
  bool resident = false;               ///< also has what it gives on the backend's device, as far as there is room
  bool sharp = false;                  ///< with sharp features
  MeasuringPool* measuring = nullptr;  ///< ChunkSurface::measures, of `before`, too; null: nothing is measured

  /// What there is of a request, near or far: takes as long as servers do. None where nothing is kept of it. Throws
  /// std::bad_alloc.
  std::optional<FoundParts> find(const ChunkRequest& request, const EditSnapshot* edits) const;

  /// As surfaceOf makes it of what meshChunks gives, equal in every byte wherever it comes from. Signs and anchors come
  /// with the body only. What the cache has is not derived, so that notes of its cells may never be told. Of a backend
  /// that is not exact nothing is kept. Takes as long as the disk does, and no longer: in what is baked and far is not
  /// looked here. Errors: those of meshChunks, and nothing is kept. Throws std::bad_alloc.
  Result<MeshedChunk> mesh(const ChunkRequest& request, const ChunkSurface* before,
                           const EditSnapshot* edits = nullptr) const;
  /// Many at once, each as if alone: the backend gets all of them together, and the job system the rest of the work.
  /// progress: as of meshChunks, also of parts of them, from the beginning each time.
  std::vector<Result<MeshedChunk>> mesh(std::span<const MeshOrder> orders, const EditSnapshot* edits,
                                        const Progress& progress = {}) const;
};

}  // namespace sgm
