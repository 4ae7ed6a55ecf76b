#pragma once
// Reads the index file of a world in a store.

#include <filesystem>
#include <functional>
#include <set>

#include "store/folder.h"
#include "store/index.h"

namespace sgm::store {

struct WorldFile {
  std::string name;  ///< name of the index file, for messages
  WorldIndex index;
  /// the open index file; keeps its old content even if another file replaces it
  std::shared_ptr<const StoredFile> file;

  /// Opens an index. Errors: io, and those of readIndex; messages contain the file's name and what the user can do.
  static Result<WorldFile> open(const std::filesystem::path& path);
  static Result<WorldFile> of(std::string name, std::shared_ptr<const StoredFile> file,
                              std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  /// Reads the record of a tile. Errors: same as open. Throws std::bad_alloc.
  Result<TileRecord> record(const TileEntry& tile, std::pmr::memory_resource* memory) const;
  /// Calls f for every record, until reading fails or f returns an error. Throws std::bad_alloc.
  Result<void> forRecords(std::pmr::memory_resource* memory, const std::function<Result<void>(TileRecord&&)>& f) const;
};

/// Totals over all tiles of a world.
struct WorldSummary {
  uint64_t tiles = 0, chunks = 0;
  /// number of distinct contents of chunk parts, including those stored in a record itself (inlined)
  uint64_t contents = 0;
  uint64_t packs = 0, pack_bytes = 0;
  /// sum over all parts of their content's stored size, in bytes; content that several parts share counts once for each
  /// part
  uint64_t unshared_bytes = 0;
  measure::SurfaceSums measured;

  void add(const TileRecord& record);

 private:
  std::set<ContentId> contents_, packs_;
};

/// Computes the totals of a world. Errors: those of reading its records.
Result<WorldSummary> summaryOf(const WorldFile& world, std::pmr::memory_resource* memory);
/// True if the store contains all packs of the world, and they have the expected sizes. Errors: those of reading the
/// world's records.
Result<bool> hasPacks(const Folder& store, const WorldFile& world, std::pmr::memory_resource* memory);

/// Returns the paths of the indexes in a store, sorted by name. Error: io.
Result<std::vector<std::filesystem::path>> worldsOf(const Folder& store);

}  // namespace sgm::store
