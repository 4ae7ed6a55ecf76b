#pragma once
// The record of a tile: the locations of its chunks' parts, and their measures.

#include "chunk/chunk_part.h"
#include "measure/chunk_measures.h"
#include "store/frames.h"
#include "store/tile.h"

namespace sgm::store {

/// Contents without triangles, and others as small, are stored in the record itself: there are only a few different
/// ones, most chunks share them, and no reader should need a file for each.
inline constexpr uint32_t kInlined = 0xFFFFFFFF;
inline constexpr size_t kMostInlined = 256;  ///< bytes

/// A part encoded by encodeChunkPart.
struct StoredContent {
  ContentId id;         ///< idOf the content
  uint32_t bytes = 0;   ///< of the content
  uint32_t stored = 0;  ///< of its frame
  uint32_t pack = 0;    ///< index of the file in TileRecord::packs, or kInlined
  uint64_t offset = 0;  ///< in that file, or in TileRecord::inlined
  friend bool operator==(const StoredContent&, const StoredContent&) = default;
};

/// A file of consecutive frames after a head; named by a hash of its bytes.
struct PackFile {
  ContentId name;
  uint64_t bytes = 0;
  friend bool operator==(const PackFile&, const PackFile&) = default;
};

/// Behind "SGMP" and the version, 4 bytes each.
inline constexpr uint64_t kPackHead = 8;
inline constexpr uint32_t kPackVersion = 1;
std::vector<std::byte> packHead();

struct TileRecord {
  explicit TileRecord(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : packs(memory), contents(memory), inlined(memory), parts(kTileChunks * kChunkParts, memory) {}

  TileKey key;
  std::pmr::vector<PackFile> packs;
  std::pmr::vector<StoredContent> contents;  ///< each once, in the order of its first use by chunks and parts
  std::pmr::vector<std::byte> inlined;
  /// By chunk and part: 0 if it was not baked, else the content's index plus one.
  std::pmr::vector<uint16_t> parts;
  measure::SurfaceSums measured;
  uint32_t chunks = 0;       ///< number of baked chunks
  uint64_t plain_bytes = 0;  ///< of all parts, as if each were stored by itself

  /// The content of a chunk's part; null if it was not baked.
  const StoredContent* contentOf(size_t chunk, int part) const {
    const uint16_t number = this->part(chunk, part);
    return number == 0 ? nullptr : &contents[number - 1u];
  }
  const uint16_t& part(size_t chunk, int part) const { return parts[chunk * kChunkParts + static_cast<size_t>(part)]; }
  uint16_t& part(size_t chunk, int part) { return parts[chunk * kChunkParts + static_cast<size_t>(part)]; }
};

std::vector<std::byte> encodeTile(const TileRecord& record);
/// Accepts any bytes; nullopt if encodeTile cannot have made them, or an index in them is invalid.
std::optional<TileRecord> decodeTile(std::span<const std::byte> bytes,
                                     std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm::store
