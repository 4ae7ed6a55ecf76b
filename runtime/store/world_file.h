#pragma once
// The index of a world as a file.

#include <filesystem>
#include <functional>
#include <set>

#include "store/folder.h"
#include "store/index.h"

namespace sgm::store {

struct WorldFile {
  std::string name;  ///< for people
  WorldIndex index;
  std::shared_ptr<const StoredFile> file;  ///< as it was when it was opened, whatever stands there now

  /// Errors: io, and those of readIndex, with the file's name and what to do.
  static Result<WorldFile> open(const std::filesystem::path& path);
  static Result<WorldFile> of(std::string name, std::shared_ptr<const StoredFile> file,
                              std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  /// Errors: likewise. Throws std::bad_alloc.
  Result<TileRecord> record(const TileEntry& tile, std::pmr::memory_resource* memory) const;
  /// Calls f for every record, to the first error, its own included. Throws std::bad_alloc.
  Result<void> forRecords(std::pmr::memory_resource* memory, const std::function<Result<void>(TileRecord&&)>& f) const;
};

/// What a world has, tile after tile.
struct WorldSummary {
  uint64_t tiles = 0, chunks = 0;
  uint64_t contents = 0;  ///< that differ from each other, inlined ones too
  uint64_t packs = 0, pack_bytes = 0;
  uint64_t plain_bytes = 0;  ///< as if each part were stored by itself
  measure::SurfaceSums measured;

  void add(const TileRecord& record);

 private:
  std::set<ContentId> contents_, packs_;
};

/// Errors: those of the records.
Result<WorldSummary> summaryOf(const WorldFile& world, std::pmr::memory_resource* memory);
/// Whether all packs are there that the world needs, as far as their sizes tell. Errors: likewise.
Result<bool> hasPacks(const Folder& store, const WorldFile& world, std::pmr::memory_resource* memory);

/// The indexes that a store has, by name. io.
Result<std::vector<std::filesystem::path>> worldsOf(const Folder& store);

}  // namespace sgm::store
