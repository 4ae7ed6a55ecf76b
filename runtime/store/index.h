#pragma once
// The index of a world in a store: the list of its baked tiles, and their records.
//
// Format: "SGMW" and the version, 4 bytes each; the compressed records; the directory; and 88 bytes that locate the
// directory. So an index is written from front to back, and read from its end: the last 88 bytes, the directory, and
// only the records that are needed. This works with a static file server.

#include "base/file_writer.h"
#include "store/store_files.h"
#include "store/tile_record.h"

namespace sgm::store {

inline constexpr uint32_t kIndexVersion = 2;
inline constexpr size_t kIndexEnd = 88;

/// Where the record of a tile is.
struct TileEntry {
  TileKey key;
  uint64_t offset = 0;
  uint32_t stored = 0, bytes = 0;  ///< size of the record's compressed frame; size of the record
  uint64_t checksum = 0;           ///< checksum of the frame
};

struct WorldIndex {
  explicit WorldIndex(std::pmr::memory_resource* memory) : tiles(memory) {}

  ContentId world;  ///< worldKey (bake.h) of the world
  BakedRegion region;
  std::pmr::vector<TileEntry> tiles;  ///< in the order of tilesOf(region)

  const TileEntry* find(const TileKey& key) const;
};

/// Writes an index; records are added in the order of their keys.
class IndexWriter {
 public:
  /// Creates the file. unfinished: same as for FileWriter::create(). Error: io.
  static Result<IndexWriter> create(const std::filesystem::path& file, UnfinishedFiles* unfinished);
  /// Appends a record. Error: out_of_memory. Throws std::bad_alloc.
  Result<void> add(const TileRecord& record, std::pmr::memory_resource* memory);
  /// Writes the directory and finishes the file. Error: io.
  Result<void> commit(const ContentId& world, const BakedRegion& region);

 private:
  explicit IndexWriter(FileWriter&& writer);
  FileWriter writer_;
  std::vector<TileEntry> tiles_;
};

/// Reads the directory of an index. Accepts any bytes. Errors: bad_input if the file is not an index, is of another
/// version, or is damaged; errors of reading. Throws std::bad_alloc.
Result<WorldIndex> readIndex(const StoredFile& file,
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());
Result<TileRecord> readRecord(const StoredFile& file, const TileEntry& entry, std::pmr::memory_resource* memory);

}  // namespace sgm::store
