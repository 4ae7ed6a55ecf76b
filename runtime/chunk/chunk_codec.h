#pragma once
// A meshed chunk as bytes, for the disk cache, and back.
//
// Little-endian 32-bit numbers: version, vertices, indices, bytes of `extra`, solid samples, seams; six for each range;
// then vertices, triangles, extra. Vertices are records of eight 16-bit words and triangles of three 32-bit ones, in
// canonical order, so that a record is much like the one before it: each word is its difference to that one's, sign in
// the lowest bit, and the lowest byte of every record's first word comes first, then the next byte of all, and so on.
// That makes zstd's files a third smaller, and faster to make (tests/bench).

#include <cstddef>
#include <span>

#include "base/result.h"
#include "mesh/packed_mesh.h"

namespace sgm {

/// Belongs into every key under which encoded chunks are kept.
inline constexpr uint32_t kChunkCodecVersion = 1;

/// What is kept of a chunk.
struct ChunkRecord {
  PackedMesh mesh;
  uint8_t seams = 0;                  ///< those that were made, empty ones too: bit (1 << Face)
  uint32_t solid_samples = 0;         ///< ChunkMesh::solid_samples
  std::pmr::vector<std::byte> extra;  ///< what else the caller wants kept

  explicit ChunkRecord(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : mesh(memory), extra(memory) {}
};

/// Precondition: decodeChunk accepts it, which it does with every chunk that was meshed and packed.
std::pmr::vector<std::byte> encodeChunk(const ChunkRecord& record, std::pmr::memory_resource* memory);

/// For any bytes; takes no more memory than they do. What comes out can be drawn without a further look at its numbers,
/// but for materials and tags: their names are not known here.
/// bad_input: another version; sizes that contradict each other; ranges that do not lie behind each other, or leave
/// some of an array out; a vertex outside of the chunk; an index outside of its range.
Result<ChunkRecord> decodeChunk(std::span<const std::byte> bytes, std::pmr::memory_resource* memory);

}  // namespace sgm
