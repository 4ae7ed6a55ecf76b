#pragma once
// Meshes a chunk of a world, or loads its stored parts. Parts (body and seams) are looked up in baked stores and then
// in the disk cache; if a store is on a server, the disk cache comes first. Missing parts are meshed and stored in the
// cache (chunk_part.h): parts with triangles, and also parts without triangles if the chunk had to be sampled.

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
  ChunkSurface surface;                 ///< the mesh of the chunk; may have no triangles
  std::optional<VoidComponents> voids;  ///< void components of the chunk, if the request wants signs
  MadeMeasures measured;                ///< measures of the requested parts, and the time to measure them; the time to
                                        ///< mesh them is not included
  uint32_t rounded = 0;                 ///< number of cells that keep rounded edges (ChunkMesh::rounded); 0 if this
                                        ///< request has not meshed the body
  bool from_disk = false;               ///< true if all requested parts came from the cache or stores
};

struct MeshOrder {
  ChunkRequest request;
  const ChunkSurface* before = nullptr;  ///< an earlier surface of the chunk, which the result extends (surfaceOf());
                                         ///< null: none
  /// parts that find() has prefetched; they are moved from. A part that edits have changed since then is ignored. Null:
  /// parts are looked up in the cache, and in stores on this machine
  FoundParts* found = nullptr;
};

/// Meshes the chunks of one world. Does not own the objects that it refers to; thread-safe if those objects are.
struct ChunkMesher {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  std::pmr::memory_resource* memory;   ///< memory resource for results
  DiskCache* cache = nullptr;          ///< disk cache; null: none
  BakedParts* baked = nullptr;         ///< baked stores; null: none
  bool resident = false;               ///< true: results are also stored on the backend's device, while it has free
                                       ///< memory
  bool sharp = false;                  ///< true: surfaces have sharp features
  MeasuringPool* measuring = nullptr;  ///< if set, ChunkSurface::measures is computed; in this case, the surface
                                       ///< `before` must have measures, too

  /// Loads the stored parts of a request from the cache and from stores, including stores on servers, for which it may
  /// wait. Returns nullopt if the parts of this request are never stored, for example parts from an inexact backend.
  /// Throws std::bad_alloc.
  std::optional<FoundParts> find(const ChunkRequest& request, const EditSnapshot* edits) const;

  /// Returns the surface of a chunk. Wherever its parts come from, the surface is equal in every byte to the one that
  /// meshChunks() and surfaceOf() make. Signs and anchors are returned only together with the body. Cells are not
  /// derived for stored parts, so warnings about these cells may never be logged. Results of an inexact backend are not
  /// stored. May wait for the disk, but never for a server. After an error nothing is stored. Errors: those of
  /// meshChunks. Throws std::bad_alloc.
  Result<MeshedChunk> mesh(const ChunkRequest& request, const ChunkSurface* before,
                           const EditSnapshot* edits = nullptr) const;
  /// Processes several orders, with the same results as one by one. The backend meshes all of them together; the job
  /// system does the remaining work. progress: as in meshChunks(); but if an error splits the orders into groups, the
  /// progress of each group starts from 0.
  std::vector<Result<MeshedChunk>> mesh(std::span<const MeshOrder> orders, const EditSnapshot* edits,
                                        const Progress& progress = {}) const;
};

}  // namespace sgm
