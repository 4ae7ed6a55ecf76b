// Small passes over the samples or the mesh of a chunk, as loops that the compiler can vectorise.

inline uint32_t countSolid(const ChunkSamples& samples) {
  constexpr uint64_t lower = (uint64_t{1} << kChunkCells) - 1;
  int solid = 0;
  for (size_t z = 0; z < kChunkCells; ++z)
    for (size_t y = 0; y < kChunkCells; ++y) solid += std::popcount(samples.signs[y + z * kChunkSamples] & lower);
  return static_cast<uint32_t>(solid);
}

inline size_t brickOf(int x, int y, int z) {
  const auto at = [](int sample) { return static_cast<size_t>(std::min(sample / kBrickSamples, kBricks - 1)); };
  return at(x) + kBricks * (at(y) + kBricks * at(z));
}

inline void sortVertices(MeshScratch& scratch, size_t count, std::array<uint32_t, kBrickCount + 1>& start) {
  scratch.order.grow(0, count);
  for (RawArray<int32_t>* array : {&scratch.x, &scratch.y, &scratch.z}) array->grow(0, count);
  const uint32_t* brick = scratch.brick.data();
  start.fill(0);
  for (size_t i = 0; i < count; ++i) ++start[brick[i] + 1];
  for (size_t b = 0; b < kBrickCount; ++b) start[b + 1] += start[b];
  std::array<uint32_t, kBrickCount> next;
  std::copy_n(start.begin(), kBrickCount, next.begin());
  const int32_t *from_x = scratch.place_x.data(), *from_y = scratch.place_y.data(), *from_z = scratch.place_z.data();
  uint32_t* order = scratch.order.data();
  int32_t *x = scratch.x.data(), *y = scratch.y.data(), *z = scratch.z.data();
  for (size_t i = 0; i < count; ++i) {
    const size_t at = next[brick[i]]++;
    order[at] = static_cast<uint32_t>(i);
    x[at] = from_x[i];
    y[at] = from_y[i];
    z[at] = from_z[i];
  }
}

inline void attributeVertices(MeshScratch& scratch, size_t count, MeshPart& part) {
  const uint32_t *order = scratch.order.data(), *label = scratch.label.data();
  const int16_t *x = scratch.normal_x.data(), *y = scratch.normal_y.data();
  Vertex* vertices = part.vertices.data();
  for (size_t i = 0; i < count; ++i) {
    Vertex& v = vertices[order[i]];
    v.normal_x = x[i];
    v.normal_y = y[i];
    v.material = static_cast<uint16_t>(label[i]);
    v.tag = static_cast<uint16_t>(label[i] >> 16);
  }
}

inline void hashWords(const uint32_t* words, size_t count, uint32_t place, ContentHash& sum) {
  uint32_t a = 0, b = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t at = place + static_cast<uint32_t>(i), h = mixWord(words[i], at);
    a += h;
    b += h * (2 * at + 1);
  }
  sum.a += a;
  sum.b += b;
}

inline void hashMesh(MeshPart& part) {
  static_assert(std::endian::native == std::endian::little, "a vertex in memory is its four words only then");
  ContentHash sum;
  constexpr size_t kBlock = 64;
  uint32_t words[4 * kBlock];
  for (size_t first = 0; first < part.vertices.size(); first += kBlock) {
    const size_t count = std::min(kBlock, part.vertices.size() - first);
    memcpy(words, part.vertices.data() + first, count * sizeof(Vertex));
    hashWords(words, 4 * count, static_cast<uint32_t>(4 * first), sum);
  }
  hashWords(part.indices.data(), part.indices.size(), 1u << 31, sum);
  part.hash = sum;
}
