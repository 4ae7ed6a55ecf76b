#pragma once
// The index of a world as a file of a folder.

#include <filesystem>

#include "store/folder.h"
#include "store/index.h"

namespace sgm::store {

struct WorldFile {
  std::filesystem::path path;
  WorldIndex index;

  /// Errors: those of readIndex, with the file's name.
  static Result<WorldFile> open(const std::filesystem::path& path);
  /// Of all worlds of a store, by name. Errors: io, and those of open.
  static Result<std::vector<WorldFile>> all(const Folder& store);
  /// Errors: likewise. Throws std::bad_alloc.
  Result<TileRecord> record(const TileEntry& tile, std::pmr::memory_resource* memory) const;
};

}  // namespace sgm::store
