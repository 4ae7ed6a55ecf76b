#include "store/source.h"

#include <algorithm>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <system_error>

#include "store/folder.h"
#include "store/world_file.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

/// Records of tiles that are kept in memory, each about 60 KB: a viewer sees a few hundred tiles of all levels.
constexpr size_t kMostRecords = 256;

/// Packs that stay open: those around a viewer.
constexpr size_t kMostOpen = 32;

/// One world of one store.
struct StoredWorld {
  const Folder& folder;
  std::optional<WorldFile> file;  ///< none where the store does not have it
};

class StoreSource final : public BakedParts {
 public:
  StoreSource(std::vector<Folder> folders, Log log, std::pmr::memory_resource* memory)
      : folders_(std::move(folders)), log_(std::move(log)), memory_(memory) {}

  DiskKey worldOf(std::span<const std::byte> inputs) const override { return idOf(inputs); }

  std::optional<std::pmr::vector<std::byte>> get(const DiskKey& world, const ChunkKey& chunk, int part,
                                                 std::pmr::memory_resource* memory) override {
    bool damaged = false;
    for (const auto& stored : worldsOf(world)) {
      if (!stored->file) continue;
      const TileEntry* entry = stored->file->index.find(tileOf(chunk));
      if (entry == nullptr) continue;
      const std::shared_ptr<const TileRecord> record = recordOf(*stored, *entry);
      damaged = damaged || record == nullptr;
      const uint16_t number = record == nullptr ? uint16_t{0} : record->part(numberInTile(chunk), part);
      if (number == 0) continue;
      const StoredContent& content = record->contents[number - 1u];
      if (isRejected(content.id)) continue;
      if (auto bytes = contentOf(stored->folder, *record, content, memory)) {
        const std::lock_guard lock(mutex_);
        ++stats_.hits;
        stats_.bytes += content.stored;
        return bytes;
      }
      damaged = true;
    }
    const std::lock_guard lock(mutex_);
    ++stats_.misses;
    stats_.damaged += damaged;
    return std::nullopt;
  }

  void reject(const DiskKey& world, const ChunkKey& chunk, int part) override {
    // Whichever store it came from: the others have the same, or as little.
    for (const auto& stored : worldsOf(world)) {
      const TileEntry* entry = stored->file ? stored->file->index.find(tileOf(chunk)) : nullptr;
      if (entry == nullptr) continue;
      const std::shared_ptr<const TileRecord> record = recordOf(*stored, *entry);
      const uint16_t number = record == nullptr ? uint16_t{0} : record->part(numberInTile(chunk), part);
      if (number == 0) continue;
      tell(stored->file->path, "'" + stored->file->path.string() + "' has contents that are no parts of chunks");
      const std::lock_guard lock(mutex_);
      rejected_.insert(record->contents[number - 1u].id);
    }
    const std::lock_guard lock(mutex_);
    --stats_.hits;
    ++stats_.misses;
    ++stats_.damaged;
  }

  BakedStats stats() const override {
    const std::lock_guard lock(mutex_);
    return stats_;
  }

 private:
  using Worlds = std::vector<std::shared_ptr<const StoredWorld>>;
  struct RecordKey {
    const StoredWorld* world;
    TileKey tile;
    friend auto operator<=>(const RecordKey&, const RecordKey&) = default;
  };
  struct OpenPack {
    const Folder* folder;
    ContentId name;
    std::shared_ptr<const OpenFile> file;
  };
  struct KeptRecord {
    RecordKey key;
    std::shared_ptr<const TileRecord> record;  ///< null where it cannot be read
  };

  void tell(const std::string& about, const std::string& message) {
    bool is_new = false;
    {
      const std::lock_guard lock(mutex_);
      ++stats_.errors;
      is_new = told_.insert(about).second;
    }
    if (is_new && log_) log_(message + "; chunks are derived instead");
  }

  bool isRejected(const ContentId& id) const {
    const std::lock_guard lock(mutex_);
    return rejected_.count(id) != 0;
  }

  Worlds worldsOf(const ContentId& key) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = worlds_.find(key); known != worlds_.end()) return known->second;
    }
    Worlds worlds;
    for (const Folder& folder : folders_) {
      auto stored = std::make_shared<StoredWorld>(StoredWorld{folder, std::nullopt});
      const fs::path path = folder.world(key);
      std::error_code error;
      if (fs::exists(path, error)) {
        Result<WorldFile> file = WorldFile::open(path);
        if (file && file->index.world == key) {
          stored->file = std::move(*file);
        } else {
          tell(path, file ? "'" + path.string() + "' is another world's index" : file.error().message);
        }
      }
      worlds.push_back(std::move(stored));
    }
    const std::lock_guard lock(mutex_);
    return worlds_.try_emplace(key, std::move(worlds)).first->second;
  }

  std::shared_ptr<const TileRecord> recordOf(const StoredWorld& world, const TileEntry& entry) {
    const RecordKey key{&world, entry.key};
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = records_.find(key); known != records_.end()) {
        kept_.splice(kept_.begin(), kept_, known->second);
        return known->second->record;
      }
    }
    std::shared_ptr<const TileRecord> record;
    Result<TileRecord> read = world.file->record(entry, memory_);
    if (read) {
      record = std::make_shared<const TileRecord>(std::move(*read));
    } else {
      tell(world.file->path, read.error().message);
    }
    const std::lock_guard lock(mutex_);
    if (const auto known = records_.find(key); known != records_.end()) return known->second->record;
    kept_.push_front({key, record});
    records_.emplace(key, kept_.begin());
    if (kept_.size() > kMostRecords) {
      records_.erase(kept_.back().key);
      kept_.pop_back();
    }
    return record;
  }

  /// Null where it cannot be opened, which is told.
  std::shared_ptr<const OpenFile> packOf(const Folder& folder, const ContentId& name) {
    const auto is = [&](const OpenPack& pack) { return pack.folder == &folder && pack.name == name; };
    {
      const std::lock_guard lock(mutex_);
      if (const auto open = std::find_if(open_.begin(), open_.end(), is); open != open_.end()) {
        open_.splice(open_.begin(), open_, open);
        return open_.front().file;
      }
    }
    const fs::path path = folder.pack(name);
    Result<std::shared_ptr<const OpenFile>> file = OpenFile::open(path);
    if (!file) {
      tell(path, file.error().message);
      return nullptr;
    }
    const std::lock_guard lock(mutex_);
    open_.push_front({&folder, name, *file});
    if (open_.size() > kMostOpen) open_.pop_back();
    return std::move(*file);
  }

  std::optional<std::pmr::vector<std::byte>> contentOf(const Folder& folder, const TileRecord& record,
                                                       const StoredContent& content,
                                                       std::pmr::memory_resource* memory) {
    if (content.pack == kInlined) {
      const auto first = record.inlined.begin() + static_cast<ptrdiff_t>(content.offset);
      std::pmr::vector<std::byte> bytes(first, first + static_cast<ptrdiff_t>(content.stored), memory);
      if (idOf(bytes) != content.id) return std::nullopt;
      return bytes;
    }
    const ContentId& name = record.packs[content.pack].name;
    const std::shared_ptr<const OpenFile> file = packOf(folder, name);
    if (file == nullptr) return std::nullopt;
    const Result<std::vector<std::byte>> frame = file->read(content.offset, content.stored);
    if (!frame) {
      tell(folder.pack(name), frame.error().message);
      return std::nullopt;
    }
    std::optional<std::pmr::vector<std::byte>> bytes = unpack(*frame, content.bytes, memory);
    if (!bytes || idOf(*bytes) != content.id) {
      const fs::path path = folder.pack(name);
      tell(path, "'" + path.string() + "' is damaged: sgm store verify says where");
      return std::nullopt;
    }
    return bytes;
  }

  const std::vector<Folder> folders_;
  const Log log_;
  std::pmr::memory_resource* const memory_;
  mutable std::mutex mutex_;  ///< of all below
  std::map<ContentId, Worlds> worlds_;
  std::list<KeptRecord> kept_;  ///< the latest used first
  std::map<RecordKey, std::list<KeptRecord>::iterator> records_;
  std::list<OpenPack> open_;  ///< the latest used first
  std::set<ContentId> rejected_;
  std::set<std::string> told_;
  BakedStats stats_;
};

}  // namespace

Result<std::shared_ptr<BakedParts>> openStores(std::span<const fs::path> folders, Log log,
                                               std::pmr::memory_resource* memory) {
  if (Result<void> can = available(); !can) return can.error();
  std::vector<Folder> stores;
  for (const fs::path& folder : folders) {
    stores.emplace_back(folder);
    if (Result<void> good = stores.back().check(); !good) return good.error();
  }
  return std::shared_ptr<BakedParts>(std::make_shared<StoreSource>(std::move(stores), std::move(log), memory));
}

}  // namespace sgm::store
