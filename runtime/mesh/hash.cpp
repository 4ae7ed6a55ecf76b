#include "mesh/hash.h"

namespace sgm {

void hashPart(MeshPart& part) {
  ContentHash sum;
  uint32_t place = 0;
  for (const Vertex& v : part.vertices) {
    const auto pack = [](auto low, auto high) {
      return uint32_t{static_cast<uint16_t>(low)} | uint32_t{static_cast<uint16_t>(high)} << 16;
    };
    addWord(sum, pack(v.x, v.y), place);
    addWord(sum, pack(v.z, v.material), place + 1);
    addWord(sum, pack(v.normal_x, v.normal_y), place + 2);
    addWord(sum, pack(v.tag, v.kind), place + 3);
    place += 4;
  }
  place = 1u << 31;
  for (uint32_t index : part.indices) addWord(sum, index, place++);
  part.hash = sum;
}

ContentHash hashPlaced(ContentHash part, const ChunkGrid& grid, int number) {
  const uint32_t words[] = {part.a,
                            part.b,
                            static_cast<uint32_t>(grid.origin.x),
                            static_cast<uint32_t>(grid.origin.y),
                            static_cast<uint32_t>(grid.origin.z),
                            static_cast<uint32_t>(grid.level),
                            static_cast<uint32_t>(number)};
  ContentHash chain;
  for (uint32_t word : words) {
    chain.a = mixWord(word ^ chain.a, 1);
    chain.b = mixWord(word ^ chain.b, 2);
  }
  return chain;
}

ContentHash hashParts(std::span<const PlacedPart> parts) {
  ContentHash sum;
  for (const PlacedPart& part : parts) {
    if (part.mesh->indices.empty()) continue;
    const ContentHash placed = hashPlaced(part.mesh->hash, part.grid, part.number);
    sum.a += placed.a;
    sum.b += placed.b;
  }
  return sum;
}

}  // namespace sgm
