#pragma once
// The record of a tile: where the parts of its chunks are stored, and their measures.

#include "chunk/chunk_part.h"
#include "measure/chunk_measures.h"
#include "store/frames.h"
#include "store/tile.h"

namespace sgm::store {

/// A value of StoredContent::pack: the content is stored in the record itself. Contents without triangles, and others
/// as small, are inlined: there are only a few different ones, most chunks share them, and no reader should have to
/// open a file for each.
inline constexpr uint32_t kInlined = 0xFFFFFFFF;
inline constexpr size_t kMaxInlined = 256;  ///< maximum size of an inlined content, in bytes

/// Where a content, the output of encodeChunkPart, is stored.
struct StoredContent {
  ContentId id;         ///< idOf the uncompressed content
  uint32_t bytes = 0;   ///< size of the content
  uint32_t stored = 0;  ///< size of its compressed frame
  uint32_t pack = 0;    ///< index in TileRecord::packs, or kInlined
  uint64_t offset = 0;  ///< offset in that pack, or in TileRecord::inlined
  friend bool operator==(const StoredContent&, const StoredContent&) = default;
};

/// A pack: a file that consists of a head and successive frames. Its name is a hash of its bytes.
struct PackFile {
  ContentId name;
  uint64_t bytes = 0;
  friend bool operator==(const PackFile&, const PackFile&) = default;
};

/// size of a pack's head: "SGMP" and the version, 4 bytes each
inline constexpr uint64_t kPackHead = 8;
inline constexpr uint32_t kPackVersion = 1;
std::vector<std::byte> packHead();

struct TileRecord {
  explicit TileRecord(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : packs(memory), contents(memory), inlined(memory), parts(kTileChunks * kChunkParts, memory) {}

  TileKey key;
  std::pmr::vector<PackFile> packs;
  /// the different contents, in the order in which chunks and parts first use them
  std::pmr::vector<StoredContent> contents;
  std::pmr::vector<std::byte> inlined;
  /// By chunk and part: index into `contents` plus one; 0 if the part was not baked.
  std::pmr::vector<uint16_t> parts;
  measure::SurfaceSums measured;
  uint32_t chunks = 0;       ///< number of baked chunks
  uint64_t plain_bytes = 0;  ///< total size of all parts, if each were stored separately and uncompressed

  /// Returns the content of a part; null if it was not baked. chunk: its number in the tile.
  const StoredContent* contentOf(size_t chunk, int part) const {
    const uint16_t number = this->part(chunk, part);
    return number == 0 ? nullptr : &contents[number - 1u];
  }
  const uint16_t& part(size_t chunk, int part) const { return parts[chunk * kChunkParts + static_cast<size_t>(part)]; }
  uint16_t& part(size_t chunk, int part) { return parts[chunk * kChunkParts + static_cast<size_t>(part)]; }
};

std::vector<std::byte> encodeTile(const TileRecord& record);
/// Decodes a record. Accepts any bytes; nullopt if encodeTile cannot have made them, or an index in them is invalid.
std::optional<TileRecord> decodeTile(std::span<const std::byte> bytes,
                                     std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
