// Makes triangles from active cells, a vector of loops at a time. A file that includes .inl files must define the types
// and functions of shaders/common/real.h, and
//   kLanes                     number of lanes of a vector
//   loadValues, loadLanes      loads of consecutive lanes
//   loadFour                   four numbers of each lane
//   loadAt, loadIntAt          gathers
//   storeLanes                 stores consecutive lanes
//   storeThree, storeFour      stores three or four numbers of each lane, interleaved
//   squareRoot, quotient       as in IEEE 754
//   scaledDouble               Int times double, rounded to float
//   minInt, maxInt             of integers
//   maskOf, all, any           one bit per lane; whether all lanes are true; whether any lane is
//   spreadBits<n>              64 bytes of n words: bit i of word k becomes bit k of byte i
//   writeTriangles<n>          the triangles of a loop's triangulation
//   addSteps                   numbers of the vertices on a cell's edges: the number of the first vertex at the sample
//                              where the edge starts, plus, for each of the edges 4 to 11, a byte of `steps`

/// For each edge of a cube: where it begins in its cell, in 1/256 of a cell, 9 bits per axis. The offset of the vertex
/// along the edge is added to this value.
struct CubePlaces {
  uint32_t of_edge[kCubeEdges];
};
constexpr CubePlaces makeCubePlaces() {
  CubePlaces places{};
  for (int e = 0; e < kCubeEdges; ++e) {
    const int axis = e / 4, lower = axis == 0 ? 1 : 0, upper = axis == 2 ? 1 : 2;
    places.of_edge[e] = static_cast<uint32_t>((e & 1) * kSubcell) << 9 * lower |
                        static_cast<uint32_t>((e >> 1 & 1) * kSubcell) << 9 * upper;
  }
  return places;
}
inline constexpr CubePlaces kCubePlaces = makeCubePlaces();

/// True if chordMask() forbids a diagonal in some loop of N edges, which is the case only for 6 and 7 edges (proved in
/// tests/unit/backend).
template <size_t N>
inline constexpr bool kForbids = N >= 6;

/// kLanes loops with the same number of points: their vertices and, for each point, its position and the chordMask of
/// its edge.
template <size_t N>
struct LoopLanes {
  alignas(64) uint32_t vertex[kLanes][8];
  alignas(64) uint32_t place[N][kLanes], faces[kForbids<N> ? N : 1][kLanes];
};

inline Int absolute(Int a) { return sel(a < broadcastInt(0), wrapSub(broadcastInt(0), a), a); }

/// Same as triangulateLoopOf of mesh/triangulate.h, for kLanes loops at a time. Returns in `ways` the number of each
/// loop's triangulation.
template <size_t N>
void triangulateLanes(const LoopLanes<N>& loops, int32_t* ways) {
  using triangulation::firstWay;
  using triangulation::kWays;
  struct Cross {
    Int x, y, z;
  };
  const auto norm = [](const Cross& c) { return wrapAdd(wrapAdd(absolute(c.x), absolute(c.y)), absolute(c.z)); };
  Int x[N], y[N], z[N], faces[N], best[N][N], way[N][N];
  Cross cross[N][N];  // cross products of the points' positions relative to point 0
#pragma GCC unroll 8
  for (size_t i = 0; i < N; ++i) {
    const Uint place = toUintBits(loadLanes(loops.place[i]));
    x[i] = toIntBits(place & Uint(511u));
    y[i] = toIntBits(place >> 9 & Uint(511u));
    z[i] = toIntBits(place >> 18);
    if constexpr (kForbids<N>) faces[i] = loadLanes(loops.faces[i]);
    if (i > 0) {
      x[i] = wrapSub(x[i], x[0]);
      y[i] = wrapSub(y[i], y[0]);
      z[i] = wrapSub(z[i], z[0]);
#pragma GCC unroll 8
      for (size_t j = 1; j < i; ++j) {
        cross[j][i] = {wrapSub(wrapMul(y[j], z[i]), wrapMul(z[j], y[i])),
                       wrapSub(wrapMul(z[j], x[i]), wrapMul(x[j], z[i])),
                       wrapSub(wrapMul(x[j], y[i]), wrapMul(y[j], x[i]))};
      }
    }
    if (i + 1 < N) {
      best[i][i + 1] = broadcastInt(std::numeric_limits<int32_t>::max());
      way[i][i + 1] = broadcastInt(0);
    }
  }
#pragma GCC unroll 8
  for (size_t span = 2; span < N; ++span) {
#pragma GCC unroll 8
    for (size_t i = 0; i + span < N; ++i) {
      const size_t j = i + span;
      Int largest = broadcastInt(-1), chosen = broadcastInt(0);
#pragma GCC unroll 8
      for (size_t k = i + 1; k < j; ++k) {
        Cross c = cross[k][j];
        if (i > 0) {
          const Cross &a = cross[i][k], &b = cross[k][j], &d = cross[i][j];
          c = {wrapSub(wrapAdd(a.x, b.x), d.x), wrapSub(wrapAdd(a.y, b.y), d.y), wrapSub(wrapAdd(a.z, b.z), d.z)};
        }
        const Int measure = norm(c);
        Int smallest = sel(best[i][k] < best[k][j], best[i][k], best[k][j]);
        smallest = sel(smallest < measure, smallest, measure);
        const Bool better = smallest > largest;
        largest = sel(better, smallest, largest);
        const Int own = wrapAdd(
            wrapAdd(broadcastInt(firstWay(span + 1, k - i)), wrapMul(way[i][k], broadcastInt(kWays[j - k + 1]))),
            way[k][j]);
        chosen = sel(better, own, chosen);
      }
      best[i][j] = largest;
      if constexpr (kForbids<N>) {
        const Bool allowed = (faces[i] & faces[j]) == broadcastInt(0);
        if (span < N - 1) best[i][j] = sel(allowed, largest, broadcastInt(-1));
      }
      way[i][j] = chosen;
    }
  }
  storeLanes(way[0][N - 1], ways);
}

/// A loop that waits in a queue: the numbers of the vertices on its cell's edges, by edge of the cube; the loop's
/// edges; and where to write its triangles.
struct alignas(64) WaitingLoop {
  uint32_t number[kCubeEdges];
  const uint8_t* edges;
  uint32_t* out;
};

/// Queues of loops, one queue for each length of loop. A queue is processed when it is full. The length of the next
/// loop is unpredictable, so loops are added without a branch on their length.
class LoopQueues {
 public:
  /// offsets[v - first]: result of placeOffset() for vertex v. Triangles are written from `out` on.
  LoopQueues(const uint32_t* offsets, size_t first, uint32_t* out) : offsets_(offsets), first_(first), out_(out) {
    for (size_t n = 0; n < kLengths; ++n) {
      next_[kShortest + n] = waiting_[n];
      full_[kShortest + n] = waiting_[n] + kMaxWaiting;
    }
  }

  /// Adds the loops of a cell. `place(number)` must write the numbers of the vertices on the cell's edges to
  /// number[edge].
  template <class Place>
  FN void add(uint64_t cell_case, const Place& place) {
    const uint32_t loop = kCubeFirstLoop[cell_case];
    const uint8_t* edges = kCubeLoops + (loop & 0xFFFF);
    size_t length = loop >> 16 & 0xFF;
    push(place, edges, length);
    if (loop >> 24 == 0) return;
    const uint8_t* end = kCubeLoops + kCubeLoopStart[cell_case + 1];
    for (edges += length; edges != end; edges += length) {
      length = *edges++;
      push(place, edges, length);
    }
  }

  void finish() {
    for (size_t n = kShortest; n <= kLongestCubeLoop; ++n) write(n);
  }

 private:
  static constexpr size_t kShortest = 3, kLengths = kLongestCubeLoop - kShortest + 1;
  static constexpr size_t kMaxWaiting = 32;
  static_assert(kMaxWaiting % kLanes == 0);

  template <class Place>
  FN void push(const Place& place, const uint8_t* edges, size_t length) {
    WaitingLoop* slot = next_[length];
    place(slot->number);
    slot->edges = edges;
    slot->out = out_;
    out_ += 3 * (length - 2);
    next_[length] = slot + 1;
    if (slot + 1 == full_[length]) write(length);
  }

  void write(size_t n) {
    WaitingLoop* loops = waiting_[n - kShortest];
    const auto count = static_cast<size_t>(next_[n] - loops);
    next_[n] = loops;
    switch (n) {
      case 3:
        for (size_t i = 0; i < count; ++i) {
          for (size_t k = 0; k < 3; ++k) loops[i].out[k] = loops[i].number[loops[i].edges[k]];
        }
        return;
      case 4:
        return writeLoops<4>(loops, count);
      case 5:
        return writeLoops<5>(loops, count);
      case 6:
        return writeLoops<6>(loops, count);
      default:
        return writeLoops<7>(loops, count);
    }
  }

  template <size_t N>
  void writeLoops(const WaitingLoop* loops, size_t count) {
    LoopLanes<N> lanes;
    alignas(64) int32_t ways[kLanes];
    const WaitingLoop* const end = loops + count;
    for (; loops != end; loops += std::min<size_t>(kLanes, static_cast<size_t>(end - loops))) {
      const auto some = std::min<size_t>(kLanes, static_cast<size_t>(end - loops));
      for (size_t lane = 0; lane < some; ++lane) {
        const WaitingLoop& loop = loops[lane];
#pragma GCC unroll 8
        for (size_t i = 0; i < N; ++i) {
          const uint8_t e = loop.edges[i];
          const size_t number = loop.number[e];
          lanes.vertex[lane][i] = static_cast<uint32_t>(number);
          lanes.place[i][lane] = kCubePlaces.of_edge[e] + offsets_[number - first_];
          if constexpr (kForbids<N>) lanes.faces[i][lane] = chordMask(kCubeEdgeFaces[e], e, N);
        }
      }
      // Unused lanes get a copy of a loop in the queue; their results are ignored.
      for (size_t lane = some; lane < kLanes; ++lane) {
        for (size_t i = 0; i < N; ++i) {
          lanes.place[i][lane] = lanes.place[i][0];
          if constexpr (kForbids<N>) lanes.faces[i][lane] = lanes.faces[i][0];
        }
      }
      triangulateLanes<N>(lanes, ways);
      for (size_t lane = 0; lane < some; ++lane) {
        writeTriangles<N>(static_cast<size_t>(ways[lane]), lanes.vertex[lane], loops[lane].out);
      }
    }
  }

  const uint32_t* offsets_;
  size_t first_;
  uint32_t* out_;
  WaitingLoop *next_[kShortest + kLengths], *full_[kShortest + kLengths];  ///< by length
  WaitingLoop waiting_[kLengths][kMaxWaiting];
};
static_assert(kLongestCubeLoop == 7);

/// Several crossed edges, each with one vertex, can start at the same sample. A byte for each of the edges 4 to 11 of a
/// cube tells how many vertices of the sample precede the edge's vertex, whose number is thus this byte plus the number
/// of the sample's first vertex. Edges 0 to 3 run along x, so each of them has the first vertex of its sample.
///
/// The byte is the sum of two parts. of_case: counts crossed edges of the cell itself. of_high: counts crossed edges
/// beyond the cell, along x (bits 0 to 2: rows 0 to 2 at high x) and y (bits 3, 4: row 1 at low and high x).
struct CellSteps {
  uint64_t of_case[256], of_high[32];
};
constexpr CellSteps makeCellSteps() {
  CellSteps steps{};
  const auto pack = [](const int(&bytes)[8]) {
    uint64_t packed = 0;
    for (int i = 0; i < 8; ++i) packed |= static_cast<uint64_t>(bytes[i]) << 8 * i;
    return packed;
  };
  for (int c = 0; c < 256; ++c) {
    const auto crossed = [c](int a, int b) { return (c >> a ^ c >> b) & 1; };
    const int x0 = crossed(0, 1), x2 = crossed(2, 3), x4 = crossed(4, 5), y0 = crossed(0, 2), y1 = crossed(1, 3);
    steps.of_case[c] = pack({x0, 0, x4, 0, x0 + y0, y1, x2, 0});
  }
  for (int h = 0; h < 32; ++h) {
    const int x0 = h & 1, x1 = h >> 1 & 1, x2 = h >> 2 & 1, y0 = h >> 3 & 1, y1 = h >> 4 & 1;
    steps.of_high[h] = pack({0, x0, 0, x2, 0, x0, y0, x1 + y1});
  }
  return steps;
}
inline constexpr CellSteps kCellSteps = makeCellSteps();

/// Adds the triangles of a layer's active cells. `low` and `high`: the number of the first vertex of each sample in the
/// planes below and above.
inline void meshCells(const uint64_t* cells, size_t count, size_t size_x, const uint32_t* low, const uint32_t* high,
                      LoopQueues& queues) {
  const uint32_t *const low1 = low + size_x, *const high1 = high + size_x;
  for (size_t i = 0; i < count; ++i) {
    const uint64_t cell = cells[i], at = cell >> 16, cell_case = cell & 0xFF;
    const uint64_t steps = kCellSteps.of_case[cell_case] + kCellSteps.of_high[cell >> 8 & 0xFF];
    queues.add(cell_case,
               [&](uint32_t* number) { addSteps(low + at, low1 + at, high + at, high1 + at, steps, number); });
  }
}
