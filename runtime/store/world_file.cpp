#include "store/world_file.h"

#include <algorithm>
#include <system_error>

namespace sgm::store {
namespace {

ReadAt readerOf(const std::filesystem::path& path) {
  return [path](uint64_t offset, size_t bytes) { return readFile(path, offset, bytes); };
}

Error in(const std::filesystem::path& path, Error error) {
  if (error.code == Code::bad_input) error.message = "'" + path.string() + "': " + error.message;
  return error;
}

}  // namespace

Result<WorldFile> WorldFile::open(const std::filesystem::path& path) {
  std::error_code error;
  const uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) return Error{Code::io, "'" + path.string() + "': " + error.message()};
  Result<WorldIndex> index = readIndex(readerOf(path), bytes);
  if (!index) return in(path, index.error());
  return WorldFile{path, std::move(*index)};
}

Result<std::vector<WorldFile>> WorldFile::all(const Folder& store) {
  const std::filesystem::path folder = store.root() / "worlds";
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return std::vector<WorldFile>();
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".sgmi") paths.push_back(entry.path());
  }
  if (error) return Error{Code::io, "'" + folder.string() + "': " + error.message()};
  std::sort(paths.begin(), paths.end());
  std::vector<WorldFile> worlds;
  for (const std::filesystem::path& path : paths) {
    Result<WorldFile> world = open(path);
    if (!world) return world.error();
    worlds.push_back(std::move(*world));
  }
  return worlds;
}

Result<TileRecord> WorldFile::record(const TileEntry& tile, std::pmr::memory_resource* memory) const {
  Result<TileRecord> record = readRecord(readerOf(path), tile, memory);
  if (!record) return in(path, record.error());
  return record;
}

}  // namespace sgm::store
