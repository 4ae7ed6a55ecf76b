#pragma once
// Makes the tiles of a store, each independently.

#include <array>
#include <filesystem>

#include "base/file_writer.h"
#include "chunk/world_measures.h"
#include "store/folder.h"

namespace sgm::store {

/// The inputs for baking a region of a world, the same wherever its tiles are made. Borrows everything it refers to,
/// and is as thread-safe as that.
struct Bakery {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  BakedRegion region;
  bool sharp = false;                     ///< with sharp features
  ContentId key, job;                     ///< worldKey and jobKey of these
  std::filesystem::path folder;           ///< Folder::baking of the job; must exist when tiles are made
  UnfinishedFiles* unfinished = nullptr;  ///< as in FileWriter::create()
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

/// Identifies all baked content of a world: its identity, and how it is meshed and encoded. invalid_argument: the world
/// has no identity.
Result<ContentId> worldKey(const WorldField& world, bool sharp);
/// Identifies the region as well.
ContentId jobKey(const ContentId& world, const BakedRegion& region);

/// Creates the bakery of a world and a region. Errors: those of check and worldKey.
Result<Bakery> bakeryOf(const WorldField& world, Backend& backend, JobSystem& jobs, const BakedRegion& region,
                        bool sharp, const Folder& store, std::pmr::memory_resource* memory);

/// Returns the record of a tile that was baked before; nullopt if there is none or it is damaged.
std::optional<TileRecord> madeBefore(const Bakery& bakery, const TileKey& tile);

/// Meshes the tile's chunks, each with the seams that may ever be drawn, measures them, and writes the pack and then
/// the record: its existence marks the tile as done. Level 0 has anchors and voids, since a streamed world asks for
/// them. A pure function of world, region and tile. Errors: those of meshing; io. Throws std::bad_alloc.
Result<TileRecord> bakeTile(const Bakery& bakery, const TileKey& tile, const Progress& progress = {});

/// Meshes a chunk anew and returns the ids of its baked parts' contents. Errors: those of meshing.
Result<std::array<ContentId, kChunkParts>> idsOf(const Bakery& bakery, const ChunkKey& chunk);

/// The content of a tile's file: the record, with checks for completeness.
std::vector<std::byte> encodeTileFile(const ContentId& job, const TileRecord& record);
std::optional<TileRecord> decodeTileFile(const ContentId& job, std::span<const std::byte> bytes,
                                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
