#pragma once
// Makes one chunk of a world. Its parts come from baked stores or, if these lack them, from the disk cache; if a store
// is on a server, the disk cache is searched first. Missing parts are meshed and stored in the cache (chunk_part.h):
// parts with triangles, and also parts without triangles if the chunk had to be sampled.

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

/// The result of a request for a chunk.
struct MeshedChunk {
  ChunkSurface surface;                 ///< may have no triangles
  std::optional<VoidComponents> voids;  ///< voids of the chunk, if signs were requested
  MadeMeasures measured;                ///< measures of the requested parts; without the time for meshing
  uint32_t rounded = 0;                 ///< ChunkMesh::rounded; 0 if the body was not meshed by this request
  bool from_disk = false;               ///< true if all requested parts came from the cache or stores
};

struct MeshOrder {
  ChunkRequest request;
  const ChunkSurface* before = nullptr;  ///< an earlier surface of the chunk; same as for surfaceOf()
  /// result of find(): its parts are moved from, except parts that edits have changed since, which are ignored. Null:
  /// the cache and nearby stores are searched
  FoundParts* found = nullptr;
};

/// Meshes the chunks of one world. Borrows everything that it refers to; thread-safe if those objects are.
struct ChunkMesher {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  std::pmr::memory_resource* memory;   ///< memory of results
  DiskCache* cache = nullptr;          ///< null: no disk cache
  BakedParts* baked = nullptr;         ///< null: no baked stores
  bool resident = false;               ///< also puts results on the backend's device, while it has free memory
  bool sharp = false;                  ///< true: chunks have sharp features
  MeasuringPool* measuring = nullptr;  ///< if set, ChunkSurface::measures is computed; `before` must have measures, too

  /// Searches the stored parts of a request in the cache and in stores, also on servers, for which it may wait. nullopt
  /// if requests of this kind are not stored. Throws std::bad_alloc.
  std::optional<FoundParts> find(const ChunkRequest& request, const EditSnapshot* edits) const;

  /// Returns the surface that surfaceOf() makes of the result of meshChunks(): equal in every byte, wherever its parts
  /// come from. Signs and anchors are returned only with the body. Cells are not derived for cached parts, so that
  /// their notes may never be reported. Results of an inexact backend are not stored. May wait for the disk, but never
  /// for a server. After an error nothing is stored. Errors: those of meshChunks. Throws std::bad_alloc.
  Result<MeshedChunk> mesh(const ChunkRequest& request, const ChunkSurface* before,
                           const EditSnapshot* edits = nullptr) const;
  /// Meshes many requests, with the same results as one by one. The backend gets all of them together; the job system
  /// does the rest of the work. progress: as in meshChunks(), but called for groups of requests, starting from 0 in
  /// each.
  std::vector<Result<MeshedChunk>> mesh(std::span<const MeshOrder> orders, const EditSnapshot* edits,
                                        const Progress& progress = {}) const;
};

}  // namespace sgm
