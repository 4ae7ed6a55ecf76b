#include "store/world_file.h"

#include <system_error>

#include "store/folder.h"

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

Result<TileRecord> WorldFile::record(const TileEntry& tile, std::pmr::memory_resource* memory) const {
  Result<TileRecord> record = readRecord(readerOf(path), tile, memory);
  if (!record) return in(path, record.error());
  return record;
}

}  // namespace sgm::store
