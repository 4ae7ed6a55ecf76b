#pragma once
// The index of a world as a file of a folder.

#include <filesystem>

#include "store/index.h"

namespace sgm::store {

struct WorldFile {
  std::filesystem::path path;
  WorldIndex index;

  /// Errors: those of readIndex, with the file's name.
  static Result<WorldFile> open(const std::filesystem::path& path);
  /// Errors: likewise. Throws std::bad_alloc.
  Result<TileRecord> record(const TileEntry& tile, std::pmr::memory_resource* memory) const;
};

}  // namespace sgm::store
