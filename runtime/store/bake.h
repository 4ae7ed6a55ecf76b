#pragma once
// Bakes the tiles of a store. A tile (tile.h) is a block of 8 x 8 x 8 chunks; tiles are baked independently.

#include <array>
#include <filesystem>

#include "base/file_writer.h"
#include "chunk/world_measures.h"
#include "store/folder.h"

namespace sgm::store {

/// The inputs for baking a region of a world. All workers that bake tiles of the region have equal inputs. Does not own
/// the objects that it refers to; thread-safe if those objects are.
struct Bakery {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  BakedRegion region;
  bool sharp = false;  ///< true: surfaces have sharp features, so that edges and corners are not rounded
  ContentId key, job;  ///< results of worldKey and jobKey for these inputs
  /// folder to which tiles are written: Folder::baking(job); must exist before a tile is baked
  std::filesystem::path folder;
  UnfinishedFiles* unfinished = nullptr;  ///< registry of unfinished files for a signal handler (FileWriter::create());
                                          ///< may be null
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

/// Returns a hash that identifies all baked content of a world. It covers the world's identity, and how the world is
/// meshed and encoded. If the store already contains this world under the key that version 0.2 of the library used,
/// returns that key instead. Error: invalid_argument if the world has no identity.
Result<ContentId> worldKey(const Folder& store, const WorldField& world, bool sharp);
/// Returns a hash that identifies the world and the region together.
ContentId jobKey(const ContentId& world, const BakedRegion& region);

/// Creates the bakery for a region of a world. Errors: those of check(region) and worldKey().
Result<Bakery> bakeryOf(const WorldField& world, Backend& backend, JobSystem& jobs, const BakedRegion& region,
                        bool sharp, const Folder& store, std::pmr::memory_resource* memory);

/// Returns the record of a tile that was already baked; nullopt if the tile was not baked, or its record is damaged.
std::optional<TileRecord> madeBefore(const Bakery& bakery, const TileKey& tile);

/// Bakes a tile: meshes its chunks with all seams that may ever be drawn, and measures them. First writes the file of
/// their meshes (the pack), and then the tile's record, whose existence marks the tile as done. Chunks of level 0 also
/// get anchors and void components, since a streamed world requests them. The result is a pure function of world,
/// region and tile. Errors: those of meshing; io. Throws std::bad_alloc.
Result<TileRecord> bakeTile(const Bakery& bakery, const TileKey& tile, const Progress& progress = {});

/// Meshes a chunk again, and returns the hashes of its encoded parts, to compare them with the baked ones. Errors:
/// those of meshing.
Result<std::array<ContentId, kChunkParts>> idsOf(const Bakery& bakery, const ChunkKey& chunk);

/// Returns the bytes of a tile's file: the encoded record, preceded by a header with a checksum.
std::vector<std::byte> encodeTileFile(const ContentId& job, const TileRecord& record);
std::optional<TileRecord> decodeTileFile(const ContentId& job, std::span<const std::byte> bytes,
                                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
