#pragma once
// A store that is open for reading: finds chunk parts in its files.

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "store/store_files.h"
#include "store/world_file.h"

namespace sgm::store {

struct FoundPart {
  uint32_t stored = 0;  ///< compressed size of the part in bytes
  std::pmr::vector<std::byte> bytes;
};

/// Reads a store, and caches the most recently used indexes, tile records and open packs. Thread-safe.
class OpenStore {
 public:
  /// Receives error messages about files of the store.
  using Tell = std::function<void(const std::string& file, const std::string& message)>;

  /// tell and memory must outlive the store; memory must be thread-safe.
  OpenStore(std::unique_ptr<StoreFiles> files, Tell tell, std::pmr::memory_resource* memory)
      : files_(std::move(files)),
        tell_(std::move(tell)),
        memory_(memory),
        worlds_(memory),
        lacking_(memory),
        kept_(memory),
        records_(memory),
        packs_(memory),
        rejected_(memory) {}

  StoreFiles& files() { return *files_; }

  /// Finds and reads a chunk part; nullopt if the store does not have it. Errors: io, also if a file is damaged or
  /// invalid (which is reported through `tell`); busy if a server is unavailable. Throws std::bad_alloc.
  Result<std::optional<FoundPart>> find(const ContentId& world, const ChunkKey& chunk, int part,
                                        std::pmr::memory_resource* memory);
  /// True if find() has searched the world, and the store has no index of the world.
  bool lacks(const ContentId& world);
  /// Call this if a part that find() returned proves invalid. Passes a message to `tell`; from now on find() does not
  /// return this part again.
  void reject(const ContentId& world, const ChunkKey& chunk, int part);

 private:
  /// null if the store has no index of the world, or the index is unreadable
  using World = std::shared_ptr<const WorldFile>;
  using Record = std::shared_ptr<const TileRecord>;
  using Pack = std::shared_ptr<const StoredFile>;
  struct RecordKey {
    ContentId world;
    TileKey tile;
    friend auto operator<=>(const RecordKey&, const RecordKey&) = default;
  };
  struct KeptRecord {
    RecordKey key;
    Record record;  ///< null if the tile's record cannot be read
  };
  struct OpenPack {
    ContentId name;
    Pack file;
  };
  struct Place {
    Record record;
    const StoredContent* content = nullptr;  ///< points into `record`; null if the store does not have the part
  };

  Error told(const std::string& file, std::string message);
  Result<bool> isStore();
  Result<World> worldOf(const ContentId& key);
  Result<Record> recordOf(const WorldFile& world, const TileEntry& entry);
  Result<Place> placeOf(const ContentId& world, const ChunkKey& chunk, int part);
  Result<Pack> packOf(const PackFile& pack);
  Result<std::pmr::vector<std::byte>> bytesOf(const TileRecord& record, const StoredContent& content,
                                              std::pmr::memory_resource* memory);

  const std::unique_ptr<StoreFiles> files_;
  const Tell tell_;
  std::pmr::memory_resource* const memory_;
  Unpacker unpacker_;
  std::mutex opening_;  ///< locked while an index is read, so that concurrent threads do not read it twice
  std::mutex mutex_;    ///< guards the members below
  std::optional<bool> is_store_;
  std::pmr::map<ContentId, World> worlds_;
  std::pmr::set<ContentId> lacking_;  ///< keys of worlds that were searched and have no index in the store
  std::pmr::list<KeptRecord> kept_;   ///< cached tile records, most recently used first
  std::pmr::map<RecordKey, std::pmr::list<KeptRecord>::iterator> records_;
  std::pmr::list<OpenPack> packs_;  ///< open pack files, most recently used first
  std::pmr::set<ContentId> rejected_;
};

}  // namespace sgm::store
