#pragma once
// The content hash of a mesh part: a sum of words, each mixed with its index, so that a GPU can add them in any order.
//
// A vertex is four words (x | y << 16, z | material << 16, normal_x | normal_y << 16, tag | kind << 16), an index
// is one. Word w at place i, with i = 4 * vertex + word for vertices and 2^31 + n for the n-th index, is mixed to
//   h = w ^ (i * 0x9E3779B9 + 0x85EBCA6B)
//   h ^= h >> 16, h *= 0x7FEB352D, h ^= h >> 15, h *= 0x846CA68B, h ^= h >> 16
// and a = sum of h, b = sum of h * (2 i + 1), all modulo 2^32. An empty part has a = b = 0. At one place different
// words have different h, so that a change of a single word always changes the hash.

#include <span>

#include "base/kernel.h"
#include "mesh/chunk.h"

namespace sgm {

SGM_KERNEL uint32_t mixWord(uint32_t word, uint32_t place) {
  uint32_t h = word ^ (place * 0x9E3779B9u + 0x85EBCA6Bu);
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  return h ^ h >> 16;
}

inline void addWord(ContentHash& sum, uint32_t word, uint32_t place) {
  const uint32_t h = mixWord(word, place);
  sum.a += h;
  sum.b += h * (2 * place + 1);
}

/// Fills part.hash from its vertices and indices; keys are not part of the content.
void hashPart(MeshPart& part);

/// A mesh part with the position of its chunk, for functions that take parts of several chunks.
struct PlacedPart {
  const MeshPart* mesh = nullptr;
  ChunkGrid grid;
  int number = 0;  ///< number of the part in its chunk: 0 for the body, 1 + Face for a seam
};

/// Returns a part's hash mixed with its position and its number in the chunk (0 for the body, 1 + Face for a seam).
ContentHash hashPlaced(ContentHash part, const ChunkGrid& grid, int number);

/// Returns the hash of a set of parts: the sum of the parts' hashes, each mixed with its position (hashPlaced). The
/// order of the parts has no effect. Parts without triangles have no effect either, so that empty chunks may be listed
/// or not. Reads MeshPart::hash.
ContentHash hashParts(std::span<const PlacedPart> parts);

}  // namespace sgm
