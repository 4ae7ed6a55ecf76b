#pragma once
// The index of a world in a store: the list of its baked tiles, and their records.
//
// Format: "SGMW" and the version, 4 bytes each; the compressed records; the directory; and a trailer of 88 bytes that
// locates the directory. An index is therefore written from front to back, and read from its end: first the trailer,
// then the directory, then only the records that are needed. This also works with a static file server.

#include "base/file_writer.h"
#include "store/store_files.h"
#include "store/tile_record.h"

namespace sgm::store {

inline constexpr uint32_t kIndexVersion = 2;
inline constexpr size_t kIndexEnd = 88;

/// The location of a tile's record in the index file.
struct TileEntry {
  TileKey key;
  uint64_t offset = 0;
  uint32_t stored = 0, bytes = 0;  ///< size of the compressed record, and of the uncompressed one, in bytes
  uint64_t checksum = 0;           ///< checksum of the compressed record
};

struct WorldIndex {
  explicit WorldIndex(std::pmr::memory_resource* memory) : tiles(memory) {}

  ContentId world;  ///< hash that identifies the world: worldKey (bake.h)
  BakedRegion region;
  std::pmr::vector<TileEntry> tiles;  ///< one entry per tile, in the order of tilesOf(region)

  const TileEntry* find(const TileKey& key) const;
};

/// Writes the index file of a world. Records are added in ascending order of their tiles' keys.
class IndexWriter {
 public:
  /// Creates the file. unfinished: registry of unfinished files (FileWriter::create()); may be null. Error: io.
  static Result<IndexWriter> create(const std::filesystem::path& file, UnfinishedFiles* unfinished);
  /// Appends the record of a tile. Error: out_of_memory. Throws std::bad_alloc.
  Result<void> add(const TileRecord& record, std::pmr::memory_resource* memory);
  /// Writes the directory and finishes the file. Error: io.
  Result<void> commit(const ContentId& world, const BakedRegion& region);

 private:
  explicit IndexWriter(FileWriter&& writer);
  FileWriter writer_;
  std::vector<TileEntry> tiles_;
};

/// Reads the directory of an index. Accepts arbitrary bytes. Errors: bad_input if the file is not an index, has another
/// version, or is damaged; errors of reading the file. Throws std::bad_alloc.
Result<WorldIndex> readIndex(const StoredFile& file,
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());
Result<TileRecord> readRecord(const StoredFile& file, const TileEntry& entry, std::pmr::memory_resource* memory);

}  // namespace sgm::store
