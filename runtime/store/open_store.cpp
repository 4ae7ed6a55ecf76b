#include "store/open_store.h"

#include <algorithm>

#include "store/folder.h"

namespace sgm::store {
namespace {

/// Maximum number of cached tile records, each about 60 KB. A viewer needs a few hundred tiles of all levels.
constexpr size_t kMaxRecords = 256;

/// Maximum number of open pack files: enough for the tiles around a viewer.
constexpr size_t kMaxOpen = 32;

}  // namespace

/// Passes an error message about a file to tell_, and returns the message as an error (Code::io).
Error OpenStore::told(const std::string& file, std::string message) {
  tell_(file, message);
  return {Code::io, std::move(message)};
}

/// True if the files are a store of this version. For a folder, this was checked when it was opened; for a server, the
/// first call checks it.
Result<bool> OpenStore::isStore() {
  {
    const std::lock_guard lock(mutex_);
    if (is_store_) return *is_store_;
  }
  const Result<void> good = checkFormat(*files_);
  if (!good && good.error().code == Code::busy) return good.error();
  {
    const std::lock_guard lock(mutex_);
    is_store_ = bool(good);
  }
  if (!good) return told(files_->nameOf(kFormatFile), good.error().message);
  return true;
}

Result<OpenStore::World> OpenStore::worldOf(const ContentId& key) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = worlds_.find(key); known != worlds_.end()) return known->second;
  }
  const std::lock_guard opening(opening_);
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = worlds_.find(key); known != worlds_.end()) return known->second;
  }
  const Result<bool> is_store = isStore();
  if (!is_store) return is_store.error();
  const auto settle = [&](World world) {
    const std::lock_guard lock(mutex_);
    return worlds_.try_emplace(key, std::move(world)).first->second;
  };
  if (!*is_store) return settle(nullptr);
  const std::string name = files_->nameOf(worldFileName(key));
  const Result<Pack> file = files_->open(worldFileName(key), std::nullopt);
  if (!file && file.error().code == Code::busy) return file.error();
  if (!file) {
    settle(nullptr);
    return told(name, file.error().message);
  }
  if (*file == nullptr) {
    {
      const std::lock_guard lock(mutex_);
      lacking_.insert(key);
    }
    return settle(nullptr);
  }
  Result<WorldFile> world = WorldFile::of(name, *file, memory_);
  if (!world && world.error().code == Code::busy) return world.error();
  if (world && world->index.world == key) return settle(std::make_shared<const WorldFile>(std::move(*world)));
  settle(nullptr);
  return told(name, world ? "'" + name + "' is another world's index" : world.error().message);
}

Result<OpenStore::Record> OpenStore::recordOf(const WorldFile& world, const TileEntry& entry) {
  const RecordKey key{world.index.world, entry.key};
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = records_.find(key); known != records_.end()) {
      kept_.splice(kept_.begin(), kept_, known->second);
      return known->second->record;
    }
  }
  Record record;
  Result<TileRecord> read = world.record(entry, memory_);
  if (!read && read.error().code == Code::busy) return read.error();
  if (read) {
    record = std::make_shared<const TileRecord>(std::move(*read));
  } else {
    tell_(world.name, read.error().message);
  }
  const std::lock_guard lock(mutex_);
  if (const auto known = records_.find(key); known != records_.end()) return known->second->record;
  kept_.push_front({key, record});
  records_.emplace(key, kept_.begin());
  if (kept_.size() > kMaxRecords) {
    records_.erase(kept_.back().key);
    kept_.pop_back();
  }
  return record;
}

Result<OpenStore::Place> OpenStore::placeOf(const ContentId& world, const ChunkKey& chunk, int part) {
  const Result<World> file = worldOf(world);
  if (!file) return file.error();
  const TileEntry* entry = *file == nullptr ? nullptr : (*file)->index.find(tileOf(chunk));
  if (entry == nullptr) return Place{};
  Result<Record> record = recordOf(**file, *entry);
  if (!record) return record.error();
  if (*record == nullptr) return Error{Code::io, "'" + (*file)->name + "' is damaged"};
  const StoredContent* content = (*record)->contentOf(numberInTile(chunk), part);
  return Place{std::move(*record), content};
}

Result<OpenStore::Pack> OpenStore::packOf(const PackFile& pack) {
  const auto is = [&](const OpenPack& open) { return open.name == pack.name; };
  {
    const std::lock_guard lock(mutex_);
    if (const auto open = std::find_if(packs_.begin(), packs_.end(), is); open != packs_.end()) {
      packs_.splice(packs_.begin(), packs_, open);
      return packs_.front().file;
    }
  }
  Result<Pack> file = files_->open(packFileName(pack.name), pack.bytes);
  if (!file) return file;
  if (*file == nullptr) return Error{Code::io, "'" + files_->nameOf(packFileName(pack.name)) + "' does not exist"};
  const std::lock_guard lock(mutex_);
  packs_.push_front({pack.name, *file});
  if (packs_.size() > kMaxOpen) packs_.pop_back();
  return file;
}

Result<std::pmr::vector<std::byte>> OpenStore::bytesOf(const TileRecord& record, const StoredContent& content,
                                                       std::pmr::memory_resource* memory) {
  if (content.pack == kInlined) {
    const auto first = record.inlined.begin() + static_cast<ptrdiff_t>(content.offset);
    return std::pmr::vector<std::byte>(first, first + static_cast<ptrdiff_t>(content.stored), memory);
  }
  const PackFile& pack = record.packs[content.pack];
  const Result<Pack> file = packOf(pack);
  if (!file) return file.error();
  const auto frame = (*file)->read(content.offset, content.stored, memory);
  if (!frame) return frame.error();
  std::optional<std::pmr::vector<std::byte>> bytes = unpacker_.unpack(*frame, content.bytes, memory);
  if (bytes && idOf(*bytes) == content.id) return std::move(*bytes);
  return Error{Code::io, "'" + files_->nameOf(packFileName(pack.name)) + "' is damaged" +
                             (files_->isFar() ? "" : ": find the place with sgm store verify")};
}

Result<std::optional<FoundPart>> OpenStore::find(const ContentId& world, const ChunkKey& chunk, int part,
                                                 std::pmr::memory_resource* memory) {
  const Result<Place> place = placeOf(world, chunk, part);
  if (!place) return place.error();
  if (place->content == nullptr) return std::optional<FoundPart>();
  const TileRecord& record = *place->record;
  const StoredContent& content = *place->content;
  {
    const std::lock_guard lock(mutex_);
    if (rejected_.count(content.id) != 0) return std::optional<FoundPart>();
  }
  Result<std::pmr::vector<std::byte>> bytes = bytesOf(record, content, memory);
  if (bytes) return std::optional(FoundPart{content.stored, std::move(*bytes)});
  if (bytes.error().code == Code::busy) return bytes.error();
  return told(files_->nameOf(packFileName(record.packs[content.pack].name)), bytes.error().message);
}

bool OpenStore::lacks(const ContentId& world) {
  const std::lock_guard lock(mutex_);
  return lacking_.count(world) != 0;
}

void OpenStore::reject(const ContentId& world, const ChunkKey& chunk, int part) {
  const Result<Place> place = placeOf(world, chunk, part);
  if (!place || place->content == nullptr) return;
  const std::string name = files_->nameOf(worldFileName(world));
  tell_(name, "'" + name + "' has contents that are not parts of chunks");
  const std::lock_guard lock(mutex_);
  rejected_.insert(place->content->id);
}

}  // namespace sgm::store
