#pragma once
// The record of a tile: where the parts of its chunks are stored, and measurements of their surfaces.

#include "chunk/chunk_part.h"
#include "measure/chunk_measures.h"
#include "store/frames.h"
#include "store/tile.h"

namespace sgm::store {

/// A value of StoredContent::pack: the content is inlined, that is, stored in the record itself. This applies to
/// content without triangles, and to other content of at most kMaxInlined bytes. Most chunks share a few such contents;
/// without inlining, a reader would have to open a file for each.
inline constexpr uint32_t kInlined = 0xFFFFFFFF;
inline constexpr size_t kMaxInlined = 256;  ///< maximum size of an inlined content, in bytes

/// Where the encoded bytes of a chunk part (the result of encodeChunkPart) are stored.
struct StoredContent {
  ContentId id;         ///< hash (idOf) of the uncompressed bytes
  uint32_t bytes = 0;   ///< uncompressed size in bytes
  uint32_t stored = 0;  ///< size as stored, in bytes; compressed, unless the content is inlined
  uint32_t pack = 0;    ///< index into TileRecord::packs, or kInlined
  uint64_t offset = 0;  ///< offset of the stored bytes in that pack, or in TileRecord::inlined
  friend bool operator==(const StoredContent&, const StoredContent&) = default;
};

/// A pack: a file that consists of a header and the compressed frames of chunk parts. Its name is a hash of its bytes.
struct PackFile {
  ContentId name;
  uint64_t bytes = 0;
  friend bool operator==(const PackFile&, const PackFile&) = default;
};

/// size of a pack's header in bytes: "SGMP" and the version, 4 bytes each
inline constexpr uint64_t kPackHead = 8;
inline constexpr uint32_t kPackVersion = 1;
std::vector<std::byte> packHead();

struct TileRecord {
  explicit TileRecord(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : packs(memory), contents(memory), inlined(memory), parts(kTileChunks * kChunkParts, memory) {}

  TileKey key;
  std::pmr::vector<PackFile> packs;
  /// the distinct contents of the tile's chunk parts, in the order of their first use
  std::pmr::vector<StoredContent> contents;
  std::pmr::vector<std::byte> inlined;
  /// for each chunk and part: index into `contents` plus one; 0 if the part was not baked
  std::pmr::vector<uint16_t> parts;
  measure::SurfaceSums measured;
  uint32_t chunks = 0;  ///< number of baked chunks
  /// sum over all parts of their content's stored size, in bytes; content that several parts share counts once for each
  /// part
  uint64_t unshared_bytes = 0;

  /// Returns the content of a part; null if the part was not baked. chunk: index of the chunk in the tile.
  const StoredContent* contentOf(size_t chunk, int part) const {
    const uint16_t number = this->part(chunk, part);
    return number == 0 ? nullptr : &contents[number - 1u];
  }
  const uint16_t& part(size_t chunk, int part) const { return parts[chunk * kChunkParts + static_cast<size_t>(part)]; }
  uint16_t& part(size_t chunk, int part) { return parts[chunk * kChunkParts + static_cast<size_t>(part)]; }
};

std::vector<std::byte> encodeTile(const TileRecord& record);
/// Decodes a record. Accepts arbitrary bytes; nullopt if they are not a result of encodeTile, or contain an invalid
/// index.
std::optional<TileRecord> decodeTile(std::span<const std::byte> bytes,
                                     std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
