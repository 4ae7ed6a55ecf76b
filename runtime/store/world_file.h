#pragma once
// The file of a world's index.

#include <filesystem>
#include <functional>
#include <set>

#include "store/folder.h"
#include "store/index.h"

namespace sgm::store {

struct WorldFile {
  std::string name;  ///< for people
  WorldIndex index;
  std::shared_ptr<const StoredFile> file;  ///< as it was when opened, even if it was replaced since

  /// Errors: io, and those of readIndex, with the file's name and what to do.
  static Result<WorldFile> open(const std::filesystem::path& path);
  static Result<WorldFile> of(std::string name, std::shared_ptr<const StoredFile> file,
                              std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  /// Errors: as above. Throws std::bad_alloc.
  Result<TileRecord> record(const TileEntry& tile, std::pmr::memory_resource* memory) const;
  /// Calls f for every record, up to the first error of reading or of f. Throws std::bad_alloc.
  Result<void> forRecords(std::pmr::memory_resource* memory, const std::function<Result<void>(TileRecord&&)>& f) const;
};

/// Totals of a world, added up tile by tile.
struct WorldSummary {
  uint64_t tiles = 0, chunks = 0;
  uint64_t contents = 0;  ///< different ones, including inlined ones
  uint64_t packs = 0, pack_bytes = 0;
  uint64_t plain_bytes = 0;  ///< if each part were stored by itself
  measure::SurfaceSums measured;

  void add(const TileRecord& record);

 private:
  std::set<ContentId> contents_, packs_;
};

/// Errors: those of the records.
Result<WorldSummary> summaryOf(const WorldFile& world, std::pmr::memory_resource* memory);
/// Whether the store has all packs of the world, as far as their sizes tell. Errors: as above.
Result<bool> hasPacks(const Folder& store, const WorldFile& world, std::pmr::memory_resource* memory);

/// The indexes in a store, by name. io.
Result<std::vector<std::filesystem::path>> worldsOf(const Folder& store);

}  // namespace sgm::store
