#pragma once
// One store, for reading: what of its files is open, and how parts of chunks are found in them.

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "store/store_files.h"
#include "store/world_file.h"

namespace sgm::store {

struct FoundPart {
  uint32_t stored = 0;  ///< bytes in the store
  std::pmr::vector<std::byte> bytes;
};

/// Keeps what was used last: indexes, records of tiles, packs. Any thread.
class OpenStore {
 public:
  /// Told of an error in the file of a name.
  using Tell = std::function<void(const std::string& file, const std::string& message)>;

  /// tell, memory (thread-safe) must outlive it.
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

  /// Nothing where the store does not have it. io, also where it is not what it should be, which is told; busy: as
  /// StoreFiles::open. Throws std::bad_alloc.
  Result<std::optional<FoundPart>> find(const ContentId& world, const ChunkKey& chunk, int part,
                                        std::pmr::memory_resource* memory);
  /// Whether it was looked for the world, and the store has none of it.
  bool lacks(const ContentId& world);
  /// What was found is no part of a chunk: that is told, and it is not found again.
  void reject(const ContentId& world, const ChunkKey& chunk, int part);

 private:
  using World = std::shared_ptr<const WorldFile>;  ///< null: the store has none, or none that can be read
  using Record = std::shared_ptr<const TileRecord>;
  using Pack = std::shared_ptr<const StoredFile>;
  struct RecordKey {
    ContentId world;
    TileKey tile;
    friend auto operator<=>(const RecordKey&, const RecordKey&) = default;
  };
  struct KeptRecord {
    RecordKey key;
    Record record;  ///< null where it cannot be read
  };
  struct OpenPack {
    ContentId name;
    Pack file;
  };
  struct Place {
    Record record;
    const StoredContent* content = nullptr;  ///< in it; null: the store does not have the part
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
  std::mutex opening_;  ///< who reads an index
  std::mutex mutex_;    ///< of all below
  std::optional<bool> is_store_;
  std::pmr::map<ContentId, World> worlds_;
  std::pmr::set<ContentId> lacking_;  ///< of these
  std::pmr::list<KeptRecord> kept_;   ///< the latest used first
  std::pmr::map<RecordKey, std::pmr::list<KeptRecord>::iterator> records_;
  std::pmr::list<OpenPack> packs_;  ///< the latest used first
  std::pmr::set<ContentId> rejected_;
};

}  // namespace sgm::store
