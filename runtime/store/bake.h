#pragma once
// Makes the tiles of a store, each by itself.

#include <array>
#include <filesystem>

#include "base/file_writer.h"
#include "chunk/world_measures.h"
#include "store/folder.h"

namespace sgm::store {

/// Of one world and region, wherever its tiles are made. Borrows all that it names; as thread-safe as they are.
struct Bakery {
  const WorldField& world;
  Backend& backend;
  JobSystem& jobs;
  BakedRegion region;
  bool sharp = false;                     ///< with sharp features
  ContentId key, job;                     ///< worldKey and jobKey of these
  std::filesystem::path folder;           ///< Folder::baking of the job; where tiles are made it is there
  UnfinishedFiles* unfinished = nullptr;  ///< as FileWriter::create takes it
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

/// What tells what is baked of a world from all else: its identity, how it is meshed and encoded.
/// invalid_argument: the world has no identity.
Result<ContentId> worldKey(const WorldField& world, bool sharp);
/// And of which region.
ContentId jobKey(const ContentId& world, const BakedRegion& region);

/// The bakery of a world and a region. Errors: those of check and worldKey.
Result<Bakery> bakeryOf(const WorldField& world, Backend& backend, JobSystem& jobs, const BakedRegion& region,
                        bool sharp, const Folder& store, std::pmr::memory_resource* memory);

/// The tile's record where it was made before, and is whole.
std::optional<TileRecord> madeBefore(const Bakery& bakery, const TileKey& tile);

/// Meshes the tile's chunks, each with the seams that may be drawn of it, measures them, and writes the pack and then
/// the record: when that is there, the tile is done. Level 0 has anchors and voids, as a streamed world asks for them.
/// A pure function of world, region and tile. Errors: those of meshing; io. Throws std::bad_alloc.
Result<TileRecord> bakeTile(const Bakery& bakery, const TileKey& tile, const Progress& progress = {});

/// What the parts of a chunk come to, made anew: the ids of their contents, of those that are baked. Errors: those of
/// meshing.
Result<std::array<ContentId, kChunkParts>> idsOf(const Bakery& bakery, const ChunkKey& chunk);

/// A tile's file: the record, and what tells whether it is whole.
std::vector<std::byte> encodeTileFile(const ContentId& job, const TileRecord& record);
std::optional<TileRecord> decodeTileFile(const ContentId& job, std::span<const std::byte> bytes,
                                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
