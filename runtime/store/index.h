#pragma once
// The index of a world: which tiles of it were baked, and their records.
//
// "SGMW" and the version, 4 bytes each; records, packed; the directory; and 88 bytes that say where it is. So it is
// written from front to back, and read from its end: the end, the directory, and of the records those that are asked
// for, which a server of plain files can give.

#include "base/file_writer.h"
#include "store/store_files.h"
#include "store/tile_record.h"

namespace sgm::store {

inline constexpr uint32_t kIndexVersion = 2;
inline constexpr size_t kIndexEnd = 88;

/// Where a tile's record lies.
struct TileEntry {
  TileKey key;
  uint64_t offset = 0;
  uint32_t stored = 0, bytes = 0;  ///< of its frame, and of what is in it
  uint64_t checksum = 0;           ///< of the frame
};

struct WorldIndex {
  explicit WorldIndex(std::pmr::memory_resource* memory) : tiles(memory) {}

  ContentId world;  ///< worldKey of bake.h
  BakedRegion region;
  std::pmr::vector<TileEntry> tiles;  ///< tilesOf the region

  const TileEntry* find(const TileKey& key) const;
};

/// Writes one, record by record in the order of their keys.
class IndexWriter {
 public:
  /// io.
  static Result<IndexWriter> create(const std::filesystem::path& file, UnfinishedFiles* unfinished);
  /// out_of_memory. Throws std::bad_alloc.
  Result<void> add(const TileRecord& record, std::pmr::memory_resource* memory);
  /// io.
  Result<void> commit(const ContentId& world, const BakedRegion& region);

 private:
  explicit IndexWriter(FileWriter&& writer);
  FileWriter writer_;
  std::vector<TileEntry> tiles_;
};

/// For any bytes. bad_input: they are no index, of another version, or damaged; errors of reading. Throws
/// std::bad_alloc.
Result<WorldIndex> readIndex(const StoredFile& file,
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());
Result<TileRecord> readRecord(const StoredFile& file, const TileEntry& entry, std::pmr::memory_resource* memory);

}  // namespace sgm::store
