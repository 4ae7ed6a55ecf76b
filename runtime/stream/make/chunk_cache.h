#pragma once
// Makes one chunk of a world. Its parts come from baked stores, or else from the disk cache; with a store on a server,
// first from the disk cache. Missing parts are meshed and stored in the cache (chunk_part.h): those with triangles, and
// those without triangles if the chunk had to be sampled.

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

/// The result of a request.
struct MeshedChunk {
  ChunkSurface surface;                 ///< may be without triangles
  std::optional<VoidComponents> voids;  ///< if signs were requested
  MadeMeasures measured;                ///< of the requested parts, without the time for meshing
  uint32_t rounded = 0;                 ///< ChunkMesh::rounded, if the body was meshed now
  bool from_disk = false;               ///< everything requested came from the cache or stores
};

struct MeshOrder {
  ChunkRequest request;
  const ChunkSurface* before = nullptr;  ///< as in surfaceOf()
  FoundParts* found = nullptr;           ///< from find(); parts that edits have changed since are not used, the others
                                         ///< are moved from. Null: near stores are searched
};

/// Meshes the chunks of one world. Borrows everything it refers to, and is as thread-safe as that.
struct ChunkMesher {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  std::pmr::memory_resource* memory;   ///< for its results
  DiskCache* cache = nullptr;          ///< null: everything is meshed
  BakedParts* baked = nullptr;         ///< null: none
  bool resident = false;               ///< also puts results on the backend's device, as far as there is room
  bool sharp = false;                  ///< with sharp features
  MeasuringPool* measuring = nullptr;  ///< computes ChunkSurface::measures; `before` must have them, too; null: no
                                       ///< measures

  /// Finds the stored parts of a request, near or on servers; may wait for servers. nullopt if such requests are not
  /// stored. Throws std::bad_alloc.
  std::optional<FoundParts> find(const ChunkRequest& request, const EditSnapshot* edits) const;

  /// Returns the surface that surfaceOf() makes of meshChunks()' result, equal in every byte wherever its parts come
  /// from. Signs and anchors come with the body only. Cached parts are not derived, so the notes of their cells may
  /// never be reported. Results of an inexact backend are not stored. Waits for the disk, but never for a server. On
  /// error nothing is stored. Errors: those of meshChunks. Throws std::bad_alloc.
  Result<MeshedChunk> mesh(const ChunkRequest& request, const ChunkSurface* before,
                           const EditSnapshot* edits = nullptr) const;
  /// Meshes many requests, each as if alone; the backend gets all of them together, the job system the rest of the
  /// work. progress: as in meshChunks(), but called for groups of requests, each from the beginning.
  std::vector<Result<MeshedChunk>> mesh(std::span<const MeshOrder> orders, const EditSnapshot* edits,
                                        const Progress& progress = {}) const;
};

}  // namespace sgm
