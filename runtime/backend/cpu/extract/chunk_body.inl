// The body of a chunk, as mesh/body.h has it. See mesh_kernels.h; an includer defines what cells.inl says.

/// A vector of edges of plane z: where they are crossed, and the first `count` vertices and keys, from number `vertex`
/// on.
inline void writeChunkEdges(const ChunkSamples& samples, const ChunkGrid& grid, size_t z, const uint32_t* edges,
                            size_t count, size_t vertex, uint32_t* offsets, MeshPart& part) {
  constexpr int32_t kSide = kChunkSamples;
  const EdgeLanes e = unpackEdges(edges, z);
  const Int zero = broadcastInt(0);
  const int32_t* plane = samples.q.data() + z * kSide * kSide;
  const Int start = wrapAdd(wrapMul(e.y, broadcastInt(kSide)), e.x);
  const Int step = sel(e.along_x, broadcastInt(1), sel(e.along_y, broadcastInt(kSide), broadcastInt(kSide * kSide)));
  const Int t = crossingOf(loadIntAt(plane, start), loadIntAt(plane, wrapAdd(start, step)));
  storeLanes(placeOffset(e, t), offsets);

  const auto placed = [&](Int at, Bool along) {
    return toUintBits(wrapAdd(wrapMul(at, broadcastInt(kSubcell)), sel(along, t, zero)));
  };
  alignas(64) uint32_t words[4 * kLanes];
  const size_t some = std::min(count, kLanes);
  storeFour(placed(e.x, e.along_x) | placed(e.y, e.along_y) << 16, placed(e.z, e.along_z), Uint(0u), Uint(0u), words);
  memcpy(part.vertices.data() + vertex, words, some * sizeof(Vertex));

  const auto corner = [&](int32_t origin, Int at) {
    return toUintBits(wrapAdd(broadcastInt(origin), wrapMul(at, broadcastInt(grid.cell))));
  };
  static_assert(sizeof(VertexKey) == 16 && offsetof(VertexKey, level) == 12 && offsetof(VertexKey, axis) == 13);
  storeFour(corner(grid.origin.x, e.x), corner(grid.origin.y, e.y), corner(grid.origin.z, e.z),
            toUintBits(e.axis) << 8 | Uint(static_cast<uint32_t>(grid.level)), words);
  memcpy(static_cast<void*>(part.keys.data() + vertex), words, some * sizeof(VertexKey));
}

inline void writeChunkPlane(const ChunkSamples& samples, const ChunkGrid& grid, size_t z, const uint32_t* edges,
                            size_t count, size_t vertex, uint32_t* offsets, MeshPart& part) {
  size_t at = 0;
  for (; at + kLanes <= count; at += kLanes)
    writeChunkEdges(samples, grid, z, edges + at, kLanes, vertex + at, offsets + at, part);
  if (at == count) return;
  uint32_t rest[kLanes];
  std::fill(std::copy(edges + at, edges + count, rest), rest + kLanes, edges[at]);
  writeChunkEdges(samples, grid, z, rest, count - at, vertex + at, offsets + at, part);
}

inline void polygonizeChunk(const ChunkSamples& samples, const ChunkGrid& grid, MeshScratch& scratch, MeshPart& part) {
  constexpr size_t kSide = kChunkSamples, kPlane = kSide * kSide;
  const SignLattice lattice{{kSide, kSide, kSide}, 1, samples.signs.data(), nullptr};
  size_t first_vertex[kSide + 1] = {}, first_cell[kSide + 1] = {}, triangles = 0;
  for (size_t z = 0; z < kSide; ++z) {
    const size_t vertices = first_vertex[z], cells = first_cell[z];
    scratch.edges.grow(vertices, vertices + edgeRoom(kSide, kSide));
    scratch.cells.grow(cells, cells + cellRoom(kSide, kSide));
    const ListCounts counts =
        listRows(lattice, z, 0, kSide, scratch.edges.data() + vertices, scratch.cells.data() + cells);
    first_vertex[z + 1] = vertices + counts.vertices;
    first_cell[z + 1] = cells + counts.cells;
    triangles += counts.triangles;
  }
  const size_t vertices = first_vertex[kSide];
  part.vertices.resize(vertices);
  part.keys.resize(vertices);
  part.indices.resize(triangles * 3);
  part.hash = {};
  if (vertices == 0) return;

  scratch.offsets.grow(0, vertices + kMostLanes);
  scratch.numbers.grow(0, 2 * kPlane);
  uint32_t* const numbers[2] = {scratch.numbers.data(), scratch.numbers.data() + kPlane};
  LoopQueues queues(scratch.offsets.data(), 0, part.indices.data());
  for (size_t z = 0; z < kSide; ++z) {
    const uint32_t* edges = scratch.edges.data() + first_vertex[z];
    const size_t count = first_vertex[z + 1] - first_vertex[z];
    numberOwners(edges, count, first_vertex[z], kSide, numbers[z & 1]);
    writeChunkPlane(samples, grid, z, edges, count, first_vertex[z], scratch.offsets.data() + first_vertex[z], part);
    if (z == 0) continue;
    meshCells(scratch.cells.data() + first_cell[z - 1], first_cell[z] - first_cell[z - 1], kSide, numbers[(z - 1) & 1],
              numbers[z & 1], queues);
  }
  queues.finish();
}
