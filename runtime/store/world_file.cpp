#include "store/world_file.h"

#include <algorithm>
#include <system_error>

#include "base/plain_text.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

Error in(const std::string& name, Error error) {
  if (error.code == Code::bad_input)
    error.message = "'" + name + "': " + error.message + "; remove it, and bake its world again";
  return error;
}

}  // namespace

Result<WorldFile> WorldFile::open(const fs::path& path) {
  Result<std::shared_ptr<const OpenFile>> file = OpenFile::open(path);
  if (!file) return file.error();
  return of(path.string(), std::move(*file));
}

Result<WorldFile> WorldFile::of(std::string name, std::shared_ptr<const StoredFile> file,
                                std::pmr::memory_resource* memory) {
  Result<WorldIndex> index = readIndex(*file, memory);
  if (!index) return in(name, index.error());
  return WorldFile{std::move(name), std::move(*index), std::move(file)};
}

Result<TileRecord> WorldFile::record(const TileEntry& tile, std::pmr::memory_resource* memory) const {
  Result<TileRecord> record = readRecord(*file, tile, memory);
  if (!record) return in(name, record.error());
  return record;
}

Result<void> WorldFile::forRecords(std::pmr::memory_resource* memory,
                                   const std::function<Result<void>(TileRecord&&)>& f) const {
  for (const TileEntry& tile : index.tiles) {
    Result<TileRecord> one = record(tile, memory);
    if (!one) return one.error();
    if (Result<void> done = f(std::move(*one)); !done) return done;
  }
  return {};
}

void WorldSummary::add(const TileRecord& record) {
  ++tiles;
  chunks += record.chunks;
  unshared_bytes += record.unshared_bytes;
  measured.add(record.measured);
  for (const StoredContent& content : record.contents) contents += contents_.insert(content.id).second;
  for (const PackFile& pack : record.packs) {
    if (!packs_.insert(pack.name).second) continue;
    ++packs;
    pack_bytes += pack.bytes;
  }
}

Result<WorldSummary> summaryOf(const WorldFile& world, std::pmr::memory_resource* memory) {
  WorldSummary summary;
  const Result<void> read = world.forRecords(memory, [&](TileRecord&& record) -> Result<void> {
    summary.add(record);
    return {};
  });
  if (!read) return read.error();
  return summary;
}

Result<bool> hasPacks(const Folder& store, const WorldFile& world, std::pmr::memory_resource* memory) {
  bool all = true;
  const Result<void> read = world.forRecords(memory, [&](TileRecord&& record) -> Result<void> {
    for (const PackFile& pack : record.packs) {
      std::error_code error;
      all = all && fs::file_size(store.pack(pack.name), error) == pack.bytes && !error;
    }
    return {};
  });
  if (!read) return read.error();
  return all;
}

Result<std::vector<fs::path>> worldsOf(const Folder& store) {
  const fs::path folder = store.root() / "worlds";
  std::vector<fs::path> paths;
  std::error_code error;
  if (!fs::exists(folder, error)) return paths;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".sgmi") paths.push_back(entry->path());
  }
  if (error) return Error{Code::io, "'" + folder.string() + "': " + systemMessage(error)};
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace sgm::store
