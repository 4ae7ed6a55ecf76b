// The passes over a caller's grid of floats. See mesh_kernels.h; cells.inl lists the definitions that the including
// file must provide.

// True if the quantised value, floor(clamp(v * scale) + 0.5), is negative.
inline bool isSolid(float value, float scale) { return value * scale + 0.5f < 0.0f; }
inline bool isFinite(float value) { return std::fabs(value) <= std::numeric_limits<float>::max(); }

/// Prefetch distance, in floats, for reading the samples of a caller's grid row by row.
inline constexpr size_t kFetchAhead = 2048;

inline bool signsOfRow(const GridJob& job, size_t y, size_t z, uint64_t* words, uint64_t* uniform) {
  const float* values = job.row(y, z);
  const size_t count = job.lattice.size[0];
  const Real scale = broadcast(job.scale), half = broadcast(0.5f), zero = broadcast(0.0f);
  // The bits of the largest magnitude so far. Bits are ordered like magnitudes, with infinity and NaN above all others.
  Int largest = broadcastInt(0);
  bool good = true;
  for (size_t first = 0; first < count; first += 64) {
    const size_t size = std::min<size_t>(64, count - first);
    uint64_t word = 0;
    size_t lane = 0;
    const auto take = [&] {
      const Real v = loadValues(values + first + lane);
      PRECISE Real q = v * scale;
      q = q + half;
      word |= maskOf(q < zero) << lane;
      largest = maxInt(largest, toIntBits(realToBits(v) & Uint(0x7FFFFFFFu)));
    };
    if (size == 64) {
      // Memory bandwidth limits this loop. Hardware prefetching does not reach far enough ahead, so prefetch
      // explicitly.
      for (size_t line = 0; line < 4; ++line) __builtin_prefetch(values + first + kFetchAhead + 16 * line);
#pragma GCC unroll 16
      for (lane = 0; lane < 64; lane += kLanes) take();
    } else {
      for (; lane + kLanes <= size; lane += kLanes) take();
    }
    for (; lane < size; ++lane) {
      word |= uint64_t{isSolid(values[first + lane], job.scale)} << lane;
      good = good && isFinite(values[first + lane]);
    }
    words[first / 64] = word;
  }
  good = good && !any(largest > broadcastInt(0x7F7FFFFF));
  uint64_t some = 0, lacking = 0;  // one bit per group of words: the group has a solid sample (some), has a void sample
                                   // (lacking)
  const size_t group = job.lattice.group();
  for (size_t word = 0, bit = 0; word < job.lattice.words; ++bit) {
    for (const size_t end = std::min(word + group, job.lattice.words); word < end; ++word) {
      some |= uint64_t{words[word] != 0} << bit;
      lacking |= uint64_t{words[word] != wordMask(word, count)} << bit;
    }
  }
  uniform[0] = ~some;
  uniform[1] = ~lacking;
  return good;
}

struct Vector {
  Real x, y, z;
};

/// Returns the value in the unit of the quantised samples Q, clamped to their range but not rounded.
FN Real scaledOf(const GridJob& job, Real value) {
  PRECISE Real v = value * broadcast(job.scale);
  return clampReal(v, -static_cast<float>(kMaxQ), static_cast<float>(kMaxQ));
}
FN Real scaledAt(const GridJob& job, const float* plane, Int at) { return scaledOf(job, loadAt(plane, at)); }

FN Int quantised(Real scaled) {
  PRECISE Real v = scaled + 0.5f;
  return toInt(floorReal(v));
}

/// Returns the difference along an axis: central or, at the grid's border, one-sided. `step`: distance to the next
/// sample in floats; `at`: coordinate on the axis; `size`: number of samples on the axis.
FN Real slopeAt(const GridJob& job, const float* plane, Int index, Int at, size_t size, size_t step) {
  const Int by = broadcastInt(static_cast<int32_t>(step)), next = wrapAdd(index, by), before = wrapSub(index, by);
  const Bool low = at > broadcastInt(0), high = at < broadcastInt(static_cast<int32_t>(size) - 1);
  PRECISE Real d = scaledAt(job, plane, sel(high, next, index)) - scaledAt(job, plane, sel(low, before, index));
  return d * sel(low && high, broadcast(0.5f), broadcast(1.0f));
}

FN Vector gradientAt(const GridJob& job, const float* plane, Int index, Int x, Int y, Int z) {
  return {slopeAt(job, plane, index, x, job.lattice.size[0], 1),
          slopeAt(job, plane, index, y, job.lattice.size[1], job.stride_y),
          slopeAt(job, plane, index, z, job.lattice.size[2], job.stride_z)};
}

/// The samples around one end of an edge inside the grid, by lane: four samples of its row, beginning one before the
/// end, and the neighbours of the end along y and z. They are copied one by one, which is faster than gathers.
struct Surroundings {
  alignas(64) float row[4 * kLanes];
  alignas(64) float y0[kLanes], y1[kLanes], z0[kLanes], z1[kLanes];
};

/// The samples around both ends of a vector of edges. `there` is false if the samples were not copied, either because
/// one of the edges lies at the grid's border or because no normals are requested.
struct EdgeSurroundings {
  bool there;
  Surroundings start, end;
};

FN void look(const GridJob& job, const float* at, size_t lane, Surroundings& around) {
  memcpy(around.row + 4 * lane, at - 1, 4 * sizeof(float));
  around.y0[lane] = *(at - job.stride_y);
  around.y1[lane] = at[job.stride_y];
  around.z0[lane] = *(at - job.stride_z);
  around.z1[lane] = at[job.stride_z];
}

/// Returns the gradient at one end of the edges; sets `scaled` to the sample there.
FN Vector gradientOf(const GridJob& job, const Surroundings& around, Real& scaled) {
  Real before, here, after, unused;
  loadFour(around.row, before, here, after, unused);
  const auto half = [&](Real high, Real low) {
    PRECISE Real d = scaledOf(job, high) - scaledOf(job, low);
    return d * broadcast(0.5f);
  };
  scaled = scaledOf(job, here);
  return {half(after, before), half(loadValues(around.y1), loadValues(around.y0)),
          half(loadValues(around.z1), loadValues(around.z0))};
}

/// Returns the normalised gradient, interpolated between the ends of the edges. If it is 0, returns `own`, the
/// direction of the edge from solid to void.
FN Vector normalBetween(const Vector& g0, const Vector& g1, Int t, const Vector& own) {
  const Real part = toReal(t) * broadcast(1.0f / kSubcell);
  const auto between = [&](Real a, Real b) {
    PRECISE Real d = b - a;
    d = d * part;
    PRECISE Real sum = a + d;
    return sum;
  };
  const Real x = between(g0.x, g1.x), y = between(g0.y, g1.y), z = between(g0.z, g1.z);
  PRECISE Real xx = x * x;
  PRECISE Real yy = y * y;
  PRECISE Real zz = z * z;
  PRECISE Real square = xx + yy;
  square = square + zz;
  const Bool some = square > broadcast(0.0f);
  const Real length = quotient(broadcast(1.0f), squareRoot(sel(some, square, broadcast(1.0f))));
  return {sel(some, x * length, own.x), sel(some, y * length, own.y), sel(some, z * length, own.z)};
}

/// Stores three numbers for each of the first `count` lanes, interleaved.
FN void storeSome(Real x, Real y, Real z, size_t count, float* out) {
  if (count >= kLanes) return storeThree(x, y, z, out);
  float all_lanes[3 * kLanes];
  storeThree(x, y, z, all_lanes);
  std::copy_n(all_lanes, 3 * count, out);
}

/// Returns the direction of the edges from solid to void.
FN Vector ownDirection(const EdgeLanes& e, Int q0) {
  const Real side = sel(q0 < broadcastInt(0), broadcast(1.0f), broadcast(-1.0f)), none = broadcast(0.0f);
  return {sel(e.along_x, side, none), sel(e.along_y, side, none), sel(e.along_z, side, none)};
}

inline void lookAround(const GridJob& job, size_t z, const uint32_t* edges, EdgeSurroundings& around) {
  const EdgeLanes e = unpackEdges(edges, z);
  const Int zero = broadcastInt(0), one = broadcastInt(1);
  const auto inside = [&](Int at, Int end, size_t axis) {
    return at > zero && end < broadcastInt(static_cast<int32_t>(job.lattice.size[axis]) - 1);
  };
  // look() reads four samples of a row. The last one is not used, but must not lie beyond the row's end.
  around.there = all(inside(e.x, wrapAdd(e.x, sel(e.along_x, broadcastInt(2), one)), 0) &&
                     inside(e.y, wrapAdd(e.y, sel(e.along_y, one, zero)), 1) &&
                     inside(e.z, wrapAdd(e.z, sel(e.along_z, one, zero)), 2));
  if (!around.there) return;
  const float* plane = job.row(0, z);
  const size_t step[3] = {1, job.stride_y, job.stride_z};
  for (size_t lane = 0; lane < kLanes; ++lane) {
    const uint32_t edge = edges[lane];
    const float* at = plane + (edge >> kPlaceBits & kPlaceMask) * job.stride_y + (edge & kPlaceMask);
    look(job, at, lane, around.start);
    look(job, at + step[edge >> 2 * kPlaceBits], lane, around.end);
  }
}

/// Sets t to the points at which the surface crosses the edges, in 1/256 of an edge, and returns the normals there if
/// they are requested. Uses the copied samples if they exist, otherwise reads the grid.
FN Vector normalsOf(const GridJob& job, const EdgeLanes& e, const float* plane, const EdgeSurroundings& around,
                    bool normals, Int& t) {
  if (around.there) {
    Real s0, s1;
    const Vector g0 = gradientOf(job, around.start, s0), g1 = gradientOf(job, around.end, s1);
    const Int q0 = quantised(s0);
    t = crossingOf(q0, quantised(s1));
    return normalBetween(g0, g1, t, ownDirection(e, q0));
  }
  const Int stride_y = broadcastInt(static_cast<int32_t>(job.stride_y)),
            stride_z = broadcastInt(static_cast<int32_t>(job.stride_z)), zero = broadcastInt(0), one = broadcastInt(1);
  const Int start = wrapAdd(wrapMul(e.y, stride_y), e.x);
  const Int end = wrapAdd(start, sel(e.along_x, one, sel(e.along_y, stride_y, stride_z)));
  const Int q0 = quantised(scaledAt(job, plane, start));
  t = crossingOf(q0, quantised(scaledAt(job, plane, end)));
  if (!normals) return {};
  const Int end_x = wrapAdd(e.x, sel(e.along_x, one, zero)), end_y = wrapAdd(e.y, sel(e.along_y, one, zero)),
            end_z = wrapAdd(e.z, sel(e.along_z, one, zero));
  return normalBetween(gradientAt(job, plane, start, e.x, e.y, e.z), gradientAt(job, plane, end, end_x, end_y, end_z),
                       t, ownDirection(e, q0));
}

/// Bounds of the vertices' coordinates in 1/256 of a cell, separately for each lane.
struct BoundsLanes {
  Int lo[3], hi[3];
};

FN void growBounds(BoundsLanes& bounds, size_t axis, Int at) {
  bounds.lo[axis] = minInt(at, bounds.lo[axis]);
  bounds.hi[axis] = maxInt(at, bounds.hi[axis]);
}

/// Processes a vector of edges of plane z: computes where the surface crosses them and, if `write`, the positions and
/// normals of the first `count` vertices, beginning with number `vertex`.
inline void writeEdges(const GridJob& job, size_t z, const uint32_t* edges, const EdgeSurroundings& around,
                       size_t count, size_t vertex, uint32_t* offsets, bool write, BoundsLanes& bounds) {
  const EdgeLanes e = unpackEdges(edges, z);
  const bool normals = write && job.normals != nullptr;
  Int t;
  const Vector n = normalsOf(job, e, job.row(0, z), around, normals, t);
  storeLanes(placeOffset(e, t), offsets);
  if (!write) return;
  const Int at[3] = {e.x, e.y, e.z};
  const Bool along[3] = {e.along_x, e.along_y, e.along_z};
  Real position[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    const Int fixed = wrapAdd(wrapMul(at[axis], broadcastInt(kSubcell)), sel(along[axis], t, broadcastInt(0)));
    growBounds(bounds, axis, fixed);
    position[axis] = scaledDouble(fixed, job.step);
  }
  storeSome(position[0], position[1], position[2], count, job.positions + vertex * 3);
  if (normals) storeSome(n.x, n.y, n.z, count, job.normals + vertex * 3);
}

/// Processes the listed edges of plane z. Without `write`, computes only the offsets of vertices along their edges.
inline void writePlane(const GridJob& job, size_t z, const uint32_t* edges, size_t count, size_t vertex,
                       uint32_t* offsets, bool write, BoundsLanes& bounds) {
  // kBatch vectors are processed at a time, so that some time passes between writing single values and reading them as
  // vectors. Samples for edges that come kAhead later in the list are prefetched: those of plane z + 2, which are
  // usually not in the cache; also those of planes z and z + 1 if plane z belongs to the slab below, because a thread
  // on another core may have processed that slab.
  constexpr size_t kBatch = 2, kAhead = 128;
  const float* const beyond = job.row(0, std::min(z + 2, job.lattice.size[2] - 1));
  const size_t cold = write ? 0 : 2;
  EdgeSurroundings around[kBatch];
  for (EdgeSurroundings& one : around) one.there = false;
  for (size_t first = 0; first < count; first += kBatch * kLanes) {
    const size_t some = std::min(kBatch * kLanes, count - first);
    const uint32_t* block = edges + first;
    uint32_t last[kBatch * kLanes];
    if (some < kBatch * kLanes) {
      std::fill(std::copy_n(block, some, last), last + kBatch * kLanes, block[0]);
      block = last;
    }
    for (size_t i = first + kAhead; i < std::min(first + kAhead + kBatch * kLanes, count); ++i) {
      const size_t place = (edges[i] >> kPlaceBits & kPlaceMask) * job.stride_y + (edges[i] & kPlaceMask);
      __builtin_prefetch(beyond + place);
      for (size_t plane = z; plane < z + cold; ++plane) {
        __builtin_prefetch(job.row(0, plane) + place);
        __builtin_prefetch(job.row(1, plane) + place);
      }
    }
    if (write && job.normals != nullptr)
      for (size_t at = 0; at < some; at += kLanes) lookAround(job, z, block + at, around[at / kLanes]);
    for (size_t at = 0; at < some; at += kLanes)
      writeEdges(job, z, block + at, around[at / kLanes], some - at, vertex + first + at, offsets + first + at, write,
                 bounds);
  }
}

inline GridBounds meshSlab(const GridJob& job, const GridSlab& slab, const GridScratch& scratch) {
  BoundsLanes bounds;
  for (size_t axis = 0; axis < 3; ++axis) {
    bounds.lo[axis] = broadcastInt(GridBounds{}.lo[axis]);
    bounds.hi[axis] = broadcastInt(GridBounds{}.hi[axis]);
  }
  const size_t size_x = job.lattice.size[0], below = slab.first - (slab.first > 0 ? 1 : 0);
  const size_t first_vertex = slab.first_vertex[below];
  uint32_t* low = scratch.numbers;
  uint32_t* high = scratch.numbers + size_x * job.lattice.size[1];
  LoopQueues queues(scratch.offsets, first_vertex, job.indices + slab.first_triangle * 3);
  // The plane below the slab's first plane belongs to the slab below, which writes its vertices. Their numbers and
  // their offsets along edges are needed here, too, for this slab's triangles.
  for (size_t z = below; z < slab.last; ++z) {
    const size_t vertex = slab.first_vertex[z], count = slab.first_vertex[z + 1] - vertex;
    const bool own = z >= slab.first;
    const uint32_t* edges = own ? slab.edges + (vertex - slab.first_vertex[slab.first]) : slab.edges_below;
    numberOwners(edges, count, vertex, size_x, high);
    writePlane(job, z, edges, count, vertex, scratch.offsets + (vertex - first_vertex), own, bounds);
    if (z > below) {
      const uint64_t cell = slab.first_cell[z - 1];
      const uint64_t* cells = z > slab.first ? slab.cells + (cell - slab.first_cell[slab.first]) : slab.cells_below;
      meshCells(cells, slab.first_cell[z] - cell, size_x, low, high, queues);
    }
    std::swap(low, high);
  }
  queues.finish();

  GridBounds result;
  for (size_t axis = 0; axis < 3; ++axis) {
    alignas(64) int32_t lo[kLanes], hi[kLanes];
    storeLanes(bounds.lo[axis], lo);
    storeLanes(bounds.hi[axis], hi);
    result.lo[axis] = *std::min_element(lo, lo + kLanes);
    result.hi[axis] = *std::max_element(hi, hi + kLanes);
  }
  return result;
}
