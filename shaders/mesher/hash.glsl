// The content hash of a mesh (mesh/hash.h): a sum over its words, so that words may be added in any order.

uvec2 hashWord(uint word, uint place) {
  uint h = word ^ (place * 0x9E3779B9u + 0x85EBCA6Bu);
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  h ^= h >> 16;
  return uvec2(h, h * (2u * place + 1u));
}

// Returns the hash of a vertex. number: index of the vertex in its part.
uvec2 hashVertex(uvec4 vertex, uint number) {
  uint place = 4u * number;
  return hashWord(vertex.x, place) + hashWord(vertex.y, place + 1u) + hashWord(vertex.z, place + 2u) +
         hashWord(vertex.w, place + 3u);
}

uvec2 hashIndex(uint index, uint number) { return hashWord(index, 0x80000000u + number); }

// Adds the shares of all invocations to the hashes of their parts, with one pair of atomic operations per part and
// subgroup. Must be called in uniform control flow. part = kNoRoom: this invocation has nothing to add.
void addHash(uint part, uvec2 share) {
  uint left = part;
  do {
    uint next = subgroupMin(left);
    uvec2 sum = subgroupAdd(left == next ? share : uvec2(0u));
    if (subgroupElect() && next != kNoRoom) {
      uint at = kHeadWords + next * kPartWords + kPartHash;
      atomicAdd(parts[at], sum.x);
      atomicAdd(parts[at + 1u], sum.y);
    }
    left = left == next ? kNoRoom : left;
  } while (subgroupMin(left) != kNoRoom);
}
