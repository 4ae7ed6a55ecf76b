#pragma once
// The index of a world: its baked tiles, and their records.
//
// "SGMW" and the version, 4 bytes each; records, compressed; the directory; and 88 bytes that locate it. So an index is
// written from front to back, and read from its end: the last bytes, the directory, and only the needed records. This
// works with a static file server.

#include "base/file_writer.h"
#include "store/store_files.h"
#include "store/tile_record.h"

namespace sgm::store {

inline constexpr uint32_t kIndexVersion = 2;
inline constexpr size_t kIndexEnd = 88;

/// The location of a tile's record.
struct TileEntry {
  TileKey key;
  uint64_t offset = 0;
  uint32_t stored = 0, bytes = 0;  ///< sizes of its frame, and of the decompressed record
  uint64_t checksum = 0;           ///< of the frame
};

struct WorldIndex {
  explicit WorldIndex(std::pmr::memory_resource* memory) : tiles(memory) {}

  ContentId world;  ///< worldKey of bake.h
  BakedRegion region;
  std::pmr::vector<TileEntry> tiles;  ///< in the order of tilesOf(region)

  const TileEntry* find(const TileKey& key) const;
};

/// Writes an index, record by record in the order of their keys.
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

/// Accepts any bytes. bad_input: not an index, of another version, or damaged; errors of reading. Throws
/// std::bad_alloc.
Result<WorldIndex> readIndex(const StoredFile& file,
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());
Result<TileRecord> readRecord(const StoredFile& file, const TileEntry& entry, std::pmr::memory_resource* memory);

}  // namespace sgm::store
