#pragma once
// Encodes a meshed chunk as bytes for the disk cache, and decodes it.
//
// Little-endian 32-bit numbers: version, vertices, indices, bytes of `extra`, solid samples, seams; six for each range;
// then vertices, triangles, extra. Vertices are records of eight 16-bit words and triangles of three 32-bit ones. In
// canonical order each record is similar to the previous one, so each word is stored as the difference to it, with the
// sign in the lowest bit. The bytes are stored by column: the lowest byte of every record's first word, then the next
// byte of all, and so on. This makes zstd's files a third smaller, and compression faster (tests/bench).

#include <cstddef>
#include <span>

#include "base/result.h"
#include "mesh/packed_mesh.h"

namespace sgm {

/// Must be part of every key under which encoded chunks are stored.
inline constexpr uint32_t kChunkCodecVersion = 1;

/// The stored content of a chunk.
struct ChunkRecord {
  PackedMesh mesh;
  uint8_t seams = 0;                  ///< made seams, also empty ones: bit (1 << Face)
  uint32_t solid_samples = 0;         ///< ChunkMesh::solid_samples
  std::pmr::vector<std::byte> extra;  ///< additional content of the caller

  explicit ChunkRecord(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : mesh(memory), extra(memory) {}
};

/// Precondition: decodeChunk accepts the record; it accepts every chunk that was meshed and packed.
std::pmr::vector<std::byte> encodeChunk(const ChunkRecord& record, std::pmr::memory_resource* memory);

/// Accepts any bytes; takes no more memory than they do. The result can be drawn without further checks, except for
/// materials and tags, whose names are unknown here. bad_input: another version; contradictory sizes; ranges that
/// overlap, leave gaps or are out of order; a vertex outside of the chunk; an index outside of its range.
Result<ChunkRecord> decodeChunk(std::span<const std::byte> bytes, std::pmr::memory_resource* memory);

}  // namespace sgm
