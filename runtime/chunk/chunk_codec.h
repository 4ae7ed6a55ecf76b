#pragma once
// Encodes a meshed chunk as bytes for the disk cache, and decodes it.
//
// Format: little-endian 32-bit numbers: version, number of vertices, of indices, of bytes of `extra`, of solid samples,
// mask of seams; six numbers for each range; then vertices, triangles, extra. Vertices are records of eight 16-bit
// words, and triangles of three 32-bit words. In canonical order each record is similar to the previous one, so each
// word is stored as the difference from the same word of the previous record, with the sign in the lowest bit. The
// bytes are stored by column: the lowest byte of the first word of every record, then the next byte of every record,
// and so on. This makes files compressed by zstd a third smaller, and compression faster (tests/bench).

#include <cstddef>
#include <span>

#include "base/result.h"
#include "mesh/packed_mesh.h"

namespace sgm {

/// The version of the format. Every key under which encoded chunks are stored must include it.
inline constexpr uint32_t kChunkCodecVersion = 1;

/// The data of a chunk that is encoded or decoded.
struct ChunkRecord {
  PackedMesh mesh;
  uint8_t seams = 0;                  ///< seams that were made, including empty ones: bit (1 << Face)
  uint32_t solid_samples = 0;         ///< number of solid samples (ChunkMesh::solid_samples)
  std::pmr::vector<std::byte> extra;  ///< additional bytes that the caller stores with the chunk

  explicit ChunkRecord(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : mesh(memory), extra(memory) {}
};

/// Encodes a chunk. Precondition: decodeChunk accepts the record, as it does for every chunk that was meshed and
/// packed.
std::pmr::vector<std::byte> encodeChunk(const ChunkRecord& record, std::pmr::memory_resource* memory);

/// Decodes bytes from an untrusted file. Allocates no more memory than their size. The result can be drawn without
/// further checks, except that the caller must check the numbers of materials and tags. Errors: bad_input if the
/// version differs; if sizes contradict each other; if ranges overlap, leave gaps or are out of order; if a vertex lies
/// outside of the chunk, or an index outside of its range.
Result<ChunkRecord> decodeChunk(std::span<const std::byte> bytes, std::pmr::memory_resource* memory);

}  // namespace sgm
