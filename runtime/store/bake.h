#pragma once
// Bakes the tiles of a store (tile.h), each independently of the others.

#include <array>
#include <filesystem>

#include "base/file_writer.h"
#include "chunk/world_measures.h"
#include "store/folder.h"

namespace sgm::store {

/// The inputs for baking a region of a world. They are the same wherever its tiles are made. Borrows everything it
/// refers to; thread-safe if those objects are.
struct Bakery {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  BakedRegion region;
  bool sharp = false;  ///< true: chunks have sharp features
  ContentId key, job;  ///< worldKey and jobKey of these inputs
  /// where tiles are written: Folder::baking of the job; must exist when tiles are made
  std::filesystem::path folder;
  UnfinishedFiles* unfinished = nullptr;  ///< same as for FileWriter::create()
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

/// Returns a hash that identifies all baked content of a world: its identity, and how it is meshed and encoded. If
/// version 0.2 baked the world into the store, returns the key under which it did. Error: invalid_argument if the world
/// has no identity.
Result<ContentId> worldKey(const Folder& store, const WorldField& world, bool sharp);
/// Returns a hash that identifies the region in addition to the world.
ContentId jobKey(const ContentId& world, const BakedRegion& region);

/// Creates the bakery for a region of a world. Errors: those of check and worldKey.
Result<Bakery> bakeryOf(const WorldField& world, Backend& backend, JobSystem& jobs, const BakedRegion& region,
                        bool sharp, const Folder& store, std::pmr::memory_resource* memory);

/// Returns the record of a tile that was baked before; nullopt if it was not, or the record is damaged.
std::optional<TileRecord> madeBefore(const Bakery& bakery, const TileKey& tile);

/// Bakes a tile: meshes its chunks, each with all seams that may ever be drawn, measures them, and writes first the
/// pack and then the record, whose existence marks the tile as done. Level 0 also gets anchors and voids, since a
/// streamed world requests them. A pure function of world, region and tile. Errors: those of meshing; io. Throws
/// std::bad_alloc.
Result<TileRecord> bakeTile(const Bakery& bakery, const TileKey& tile, const Progress& progress = {});

/// Meshes a chunk again, and returns the ids of the contents of its parts. Errors: those of meshing.
Result<std::array<ContentId, kChunkParts>> idsOf(const Bakery& bakery, const ChunkKey& chunk);

/// Returns the content of a tile's file: the record, with a head and a checksum that show whether it is complete.
std::vector<std::byte> encodeTileFile(const ContentId& job, const TileRecord& record);
std::optional<TileRecord> decodeTileFile(const ContentId& job, std::span<const std::byte> bytes,
                                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
