// Meshes the body of a chunk, with the same result as mesh/body.h. See mesh_kernels.h; cells.inl lists the definitions
// that the including file must provide.

/// Processes a vector of crossed edges of plane z: computes where the surface crosses them, and writes the first
/// `count` vertices and keys, beginning with number `vertex`.
inline void writeChunkEdges(const ChunkSamples& samples, const ChunkGrid& grid, size_t z, const uint32_t* edges,
                            size_t count, size_t vertex, bool keys, MeshScratch& scratch, MeshPart& part) {
  constexpr int32_t kSide = kChunkSamples;
  const EdgeLanes e = unpackEdges(edges, z);
  const Int zero = broadcastInt(0);
  const int32_t* plane = samples.q.data() + z * kSide * kSide;
  const Int start = wrapAdd(wrapMul(e.y, broadcastInt(kSide)), e.x);
  const Int step = sel(e.along_x, broadcastInt(1), sel(e.along_y, broadcastInt(kSide), broadcastInt(kSide * kSide)));
  const Int t = crossingOf(loadIntAt(plane, start), loadIntAt(plane, wrapAdd(start, step)));
  storeLanes(placeOffset(e, t), scratch.offsets.data() + vertex);

  const auto placed = [&](Int at, Bool along) {
    return toUintBits(wrapAdd(wrapMul(at, broadcastInt(kSubcell)), sel(along, t, zero)));
  };
  alignas(64) uint32_t words[4 * kLanes];
  const size_t some = std::min(count, kLanes);
  storeFour(placed(e.x, e.along_x) | placed(e.y, e.along_y) << 16, placed(e.z, e.along_z), Uint(0u), Uint(0u), words);
  memcpy(part.vertices.data() + vertex, words, some * sizeof(Vertex));

  const Int cell = broadcastInt(grid.cell);
  const auto corner = [&](int32_t origin, Int at) { return wrapAdd(broadcastInt(origin), wrapMul(at, cell)); };
  const Int corner_x = corner(grid.origin.x, e.x), corner_y = corner(grid.origin.y, e.y),
            corner_z = corner(grid.origin.z, e.z);
  static_assert(sizeof(VertexKey) == 16 && offsetof(VertexKey, level) == 12 && offsetof(VertexKey, axis) == 13);
  if (keys) {
    storeFour(toUintBits(corner_x), toUintBits(corner_y), toUintBits(corner_z),
              toUintBits(e.axis) << 8 | Uint(static_cast<uint32_t>(grid.level)), words);
    memcpy(static_cast<void*>(part.keys.data() + vertex), words, some * sizeof(VertexKey));
  }

  // Same result as vertexUnits(): only the coordinate along the edge lies between samples, so only it needs rounding.
  const Int along = toIntBits(toUintBits(wrapAdd(wrapMul(t, cell), broadcastInt(kSubcell / 2))) >> 8);
  storeLanes(wrapAdd(corner_x, sel(e.along_x, along, zero)), scratch.place_x.data() + vertex);
  storeLanes(wrapAdd(corner_y, sel(e.along_y, along, zero)), scratch.place_y.data() + vertex);
  storeLanes(wrapAdd(corner_z, sel(e.along_z, along, zero)), scratch.place_z.data() + vertex);
  static_assert(kBrickSamples == 8);
  const auto brick = [](Int at) {
    const Int b = toIntBits(toUintBits(at) >> 3), last = broadcastInt(kBricks - 1);
    return sel(b > last, last, b);
  };
  const Int row = wrapAdd(brick(e.y), wrapMul(brick(e.z), broadcastInt(kBricks)));
  storeLanes(wrapAdd(brick(e.x), wrapMul(row, broadcastInt(kBricks))), scratch.brick.data() + vertex);
}

inline void writeChunkPlane(const ChunkSamples& samples, const ChunkGrid& grid, size_t z, const uint32_t* edges,
                            size_t count, size_t vertex, bool keys, MeshScratch& scratch, MeshPart& part) {
  size_t at = 0;
  for (; at + kLanes <= count; at += kLanes)
    writeChunkEdges(samples, grid, z, edges + at, kLanes, vertex + at, keys, scratch, part);
  if (at == count) return;
  uint32_t rest[kLanes];
  std::fill(std::copy(edges + at, edges + count, rest), rest + kLanes, edges[at]);
  writeChunkEdges(samples, grid, z, rest, count - at, vertex + at, keys, scratch, part);
}

/// Meshes the body of a chunk. kList: the function MeshKernels::list of the instruction set.
template <auto kList>
void polygonizeChunk(const ChunkSamples& samples, const ChunkGrid& grid, bool keys, MeshScratch& scratch,
                     MeshPart& part) {
  constexpr size_t kSide = kChunkSamples, kPlane = kSide * kSide;
  const SignLattice lattice{{kSide, kSide, kSide}, 1, samples.signs.data(), nullptr};
  size_t first_vertex[kSide + 1] = {}, first_cell[kSide + 1] = {}, triangles = 0;
  for (size_t z = 0; z < kSide; ++z) {
    const size_t vertices = first_vertex[z], cells = first_cell[z];
    scratch.edges.grow(vertices, vertices + edgeRoom(kSide, kSide));
    scratch.cells.grow(cells, cells + cellRoom(kSide, kSide));
    const ListCounts counts =
        kList(lattice, z, 0, kSide, scratch.edges.data() + vertices, scratch.cells.data() + cells);
    first_vertex[z + 1] = vertices + counts.vertices;
    first_cell[z + 1] = cells + counts.cells;
    triangles += counts.triangles;
  }
  const size_t vertices = first_vertex[kSide];
  part.vertices.resize(vertices);
  part.keys.resize(keys ? vertices : 0);
  part.indices.resize(triangles * 3);
  part.hash = {};
  if (vertices == 0) return;

  scratch.offsets.grow(0, vertices + kMaxLanes);
  scratch.growPlaces(vertices + kMaxLanes);
  scratch.numbers.grow(0, 2 * kPlane);
  uint32_t* const numbers[2] = {scratch.numbers.data(), scratch.numbers.data() + kPlane};
  LoopQueues queues(scratch.offsets.data(), 0, part.indices.data());
  for (size_t z = 0; z < kSide; ++z) {
    const uint32_t* edges = scratch.edges.data() + first_vertex[z];
    const size_t count = first_vertex[z + 1] - first_vertex[z];
    numberOwners(edges, count, first_vertex[z], kSide, numbers[z & 1]);
    writeChunkPlane(samples, grid, z, edges, count, first_vertex[z], keys, scratch, part);
    if (z == 0) continue;
    meshCells(scratch.cells.data() + first_cell[z - 1], first_cell[z] - first_cell[z - 1], kSide, numbers[(z - 1) & 1],
              numbers[z & 1], queues);
  }
  queues.finish();
}
