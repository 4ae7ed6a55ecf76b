// The passes of grid_kernels.h, written once. An includer defines, in the namespace that it includes this in: the types
// and functions of shaders/common/real.h; kLanes; loadValues and loadLanes, which read lanes behind each other,
// storeLanes and laneNumbers; squareRoot and quotient, both as IEEE 754 has them; maskOf, a bit a lane, and all.

// ---- signs ----------------------------------------------------------------------------------------------------------

inline uint64_t wordMask(size_t word, size_t count) {
  const size_t first = word * 64;
  return count >= first + 64 ? ~uint64_t{0} : count <= first ? 0 : (uint64_t{1} << (count - first)) - 1;
}

// The same sign as floor(clamp(v * scale) + 0.5).
inline bool isSolid(float value, float scale) { return value * scale + 0.5f < 0.0f; }
inline bool isFinite(float value) { return std::fabs(value) <= std::numeric_limits<float>::max(); }

inline bool signsOfRow(const GridJob& job, size_t y, size_t z) {
  const float* values = job.row(y, z);
  uint64_t* words = job.signs + (z * job.size[1] + y) * job.words;
  const size_t count = job.size[0];
  const Real scale = broadcast(job.scale), half = broadcast(0.5f), zero = broadcast(0.0f);
  const Real most = broadcast(std::numeric_limits<float>::max());
  Bool finite = zero <= zero;
  size_t at = 0;
  for (; at + 64 <= count; at += 64) {
    uint64_t word = 0;
    for (size_t lane = 0; lane < 64; lane += kLanes) {
      const Real v = loadValues(values + at + lane);
      PRECISE Real q = v * scale;
      q = q + half;
      word |= maskOf(q < zero) << lane;
      finite = finite && (absReal(v) <= most);
    }
    words[at / 64] = word;
  }
  bool good = all(finite);
  if (at == count) return good;
  uint64_t word = 0;
  for (size_t i = at; i < count; ++i) {
    word |= uint64_t{isSolid(values[i], job.scale)} << (i - at);
    good = good && isFinite(values[i]);
  }
  words[at / 64] = word;
  return good;
}

// ---- counts ---------------------------------------------------------------------------------------------------------

/// The word's signs moved down by one sample.
inline uint64_t shifted(const uint64_t* row, size_t word, size_t words) {
  return row[word] >> 1 | (word + 1 < words ? row[word + 1] << 63 : 0);
}

/// Edges that cross the surface, of those that a word's samples own.
struct Crossed {
  uint64_t x, y, z;
};

inline Crossed crossedOf(const GridJob& job, size_t y, size_t z, size_t word) {
  const uint64_t* here = job.signRow(y, z);
  const uint64_t a = here[word];
  return {(a ^ shifted(here, word, job.words)) & wordMask(word, job.size[0] - 1),
          y + 1 < job.size[1] ? a ^ job.signRow(y + 1, z)[word] : 0,
          z + 1 < job.size[2] ? a ^ job.signRow(y, z + 1)[word] : 0};
}

/// Signs at the corners of a word's cells: low x and high x of the rows (y, z), (y + 1, z), (y, z + 1), (y + 1, z + 1).
struct CellSigns {
  uint64_t low[4], high[4], active;
};

inline CellSigns cellSigns(const GridJob& job, const uint64_t* const rows[4], size_t word) {
  CellSigns s;
  uint64_t some = 0, every = ~uint64_t{0};
  for (size_t i = 0; i < 4; ++i) {
    s.low[i] = rows[i][word];
    s.high[i] = shifted(rows[i], word, job.words);
    some |= s.low[i] | s.high[i];
    every &= s.low[i] & s.high[i];
  }
  s.active = some & ~every & wordMask(word, job.size[0] - 1);
  return s;
}

inline uint32_t bitOf(uint64_t word, int bit) { return static_cast<uint32_t>(word >> bit & 1); }

inline uint32_t caseOf(const CellSigns& s, int bit) {
  uint32_t cell_case = 0;
  for (size_t i = 0; i < 4; ++i) cell_case |= (bitOf(s.low[i], bit) | bitOf(s.high[i], bit) << 1) << 2 * i;
  return cell_case;
}

/// Whether the cells of a word, and the samples beside them, are all of one sign.
inline bool isUniform(const uint64_t* const rows[4], size_t word, size_t words) {
  const uint64_t some = rows[0][word] | rows[1][word] | rows[2][word] | rows[3][word];
  const uint64_t every = rows[0][word] & rows[1][word] & rows[2][word] & rows[3][word];
  if (some != every || (some != 0 && some != ~uint64_t{0})) return false;
  if (word + 1 == words) return true;
  const uint64_t next = some & 1;
  const size_t after = word + 1;
  return (((rows[0][after] ^ next) | (rows[1][after] ^ next) | (rows[2][after] ^ next) | (rows[3][after] ^ next)) &
          1) == 0;
}

inline GridCounts countPlane(const GridJob& job, size_t z) {
  GridCounts counts;
  const bool above = z + 1 < job.size[2];
  for (size_t y = 0; y < job.size[1]; ++y) {
    const bool cells = above && y + 1 < job.size[1];
    const size_t up = y + 1 < job.size[1] ? y + 1 : y;
    const uint64_t* const rows[4] = {job.signRow(y, z), job.signRow(up, z), job.signRow(y, above ? z + 1 : z),
                                     job.signRow(up, above ? z + 1 : z)};
    for (size_t word = 0; word < job.words; ++word) {
      if (isUniform(rows, word, job.words)) continue;
      const Crossed c = crossedOf(job, y, z, word);
      counts.vertices += static_cast<uint64_t>(std::popcount(c.x) + std::popcount(c.y) + std::popcount(c.z));
      if (!cells) continue;
      const CellSigns s = cellSigns(job, rows, word);
      for (uint64_t left = s.active; left != 0; left &= left - 1)
        counts.triangles += kCubeTriangles[caseOf(s, std::countr_zero(left))];
    }
  }
  return counts;
}

// ---- vertices -------------------------------------------------------------------------------------------------------

/// Crossed edges of a plane along one axis: their samples, y << 16 | x, and their vertices. Surfaces cross a row in few
/// places, so that vectors are only full when many rows are taken together.
struct EdgeList {
  uint32_t *sample, *vertex;
  size_t count = 0;
};

/// A plane of values with those below and above, and what a difference of the two counts for: 1 at the grid's border,
/// else 1/2.
struct Planes {
  const float *here, *z0, *z1;
  float share_z;
};

inline Planes planesAt(const GridJob& job, size_t z) {
  const bool z0 = z > 0, z1 = z + 1 < job.size[2];
  return {job.row(0, z), job.row(0, z0 ? z - 1 : z), job.row(0, z1 ? z + 1 : z), z0 && z1 ? 0.5f : 1.0f};
}

struct Vector {
  Real x, y, z;
};

/// The value in 1024ths of a cell, within the range of Q.
inline Real scaledAt(const GridJob& job, const float* plane, Int at) {
  PRECISE Real v = loadAt(plane, at) * broadcast(job.scale);
  return clampReal(v, -static_cast<float>(kMaxQ), static_cast<float>(kMaxQ));
}

inline Int quantised(Real scaled) {
  PRECISE Real v = scaled + 0.5f;
  return toInt(floorReal(v));
}

/// Along one axis of a plane: `at` is the sample's coordinate there of `size`, `step` floats from the next.
inline Real slopeAt(const GridJob& job, const float* plane, Int index, Int at, size_t size, size_t step) {
  const Int by = broadcastInt(static_cast<int32_t>(step));
  const Bool low = at > broadcastInt(0), high = at < broadcastInt(static_cast<int32_t>(size) - 1);
  PRECISE Real d = scaledAt(job, plane, sel(high, wrapAdd(index, by), index)) -
                   scaledAt(job, plane, sel(low, wrapSub(index, by), index));
  return d * sel(low && high, broadcast(0.5f), broadcast(1.0f));
}

inline Vector gradientAt(const GridJob& job, const Planes& planes, Int x, Int y) {
  const Int index = wrapAdd(wrapMul(y, broadcastInt(static_cast<int32_t>(job.stride_y))), x);
  PRECISE Real dz = scaledAt(job, planes.z1, index) - scaledAt(job, planes.z0, index);
  return {slopeAt(job, planes.here, index, x, job.size[0], 1),
          slopeAt(job, planes.here, index, y, job.size[1], job.stride_y), dz * broadcast(planes.share_z)};
}

/// crossing() of mesh/vertex.h. The division of floats is off by one at most, which the rest tells.
inline Int crossingOf(Int q0, Int q1) {
  const Int zero = broadcastInt(0), one = broadcastInt(1);
  const Int a = sel(q0 < zero, wrapSub(zero, q0), q0), b = sel(q1 < zero, wrapSub(zero, q1), q1);
  const Int sum = wrapAdd(a, b), twice = wrapAdd(sum, sum);
  PRECISE Real rounded = quotient(toReal(a) * broadcast(256.0f), toReal(sum)) + broadcast(0.5f);
  Int t = toInt(rounded);
  const Int rest = wrapSub(wrapAdd(wrapMul(a, broadcastInt(512)), sum), wrapMul(t, twice));
  t = sel(rest < zero, wrapSub(t, one), sel(rest >= twice, wrapAdd(t, one), t));
  t = sel(t < one, one, t);
  return sel(t > broadcastInt(255), broadcastInt(255), t);
}

/// The gradient between an edge's ends, one long. Where it vanishes between samples whose signs differ: the edge's own
/// direction, from solid to void.
template <int kAxis>
Vector normalAt(const Vector& g0, const Vector& g1, Int t, Bool solid_first) {
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
  const Real own = sel(solid_first, broadcast(1.0f), broadcast(-1.0f)), none = broadcast(0.0f);
  return {sel(some, x * length, kAxis == 0 ? own : none), sel(some, y * length, kAxis == 1 ? own : none),
          sel(some, z * length, kAxis == 2 ? own : none)};
}

/// Crossings of a list's edges, which plane z owns; with `write`, positions and normals. Empties the list.
template <int kAxis>
void writeEdges(const GridJob& job, size_t z, EdgeList& list, uint64_t first_vertex, uint8_t* crossings, bool write) {
  if (list.count == 0) return;
  for (size_t i = 0; i < kLanes; ++i) list.sample[list.count + i] = list.sample[list.count - 1];
  const Planes start = planesAt(job, z), end = planesAt(job, kAxis == 2 ? z + 1 : z);
  const bool normals = write && job.normals != nullptr;
  const auto placed = [&](size_t fixed) { return static_cast<float>(static_cast<double>(fixed) * job.step); };
  for (size_t first = 0; first < list.count; first += kLanes) {
    const Uint sample = toUintBits(loadLanes(list.sample + first));
    const Int x = toIntBits(sample & Uint(0xFFFFu)), y = toIntBits(sample >> 16);
    const Int end_x = kAxis == 0 ? wrapAdd(x, broadcastInt(1)) : x,
              end_y = kAxis == 1 ? wrapAdd(y, broadcastInt(1)) : y;
    const Int stride = broadcastInt(static_cast<int32_t>(job.stride_y));
    const Int q0 = quantised(scaledAt(job, start.here, wrapAdd(wrapMul(y, stride), x)));
    const Int q1 = quantised(scaledAt(job, end.here, wrapAdd(wrapMul(end_y, stride), end_x)));
    const Int t = crossingOf(q0, q1);
    alignas(64) int32_t along[kLanes];
    alignas(64) float normal[3][kLanes] = {};
    storeLanes(t, along);
    if (normals) {
      const Vector n =
          normalAt<kAxis>(gradientAt(job, start, x, y), gradientAt(job, end, end_x, end_y), t, q0 < broadcastInt(0));
      storeLanes(n.x, normal[0]);
      storeLanes(n.y, normal[1]);
      storeLanes(n.z, normal[2]);
    }
    const size_t count = std::min(kLanes, list.count - first);
    for (size_t i = 0; i < count; ++i) {
      const size_t vertex = list.vertex[first + i];
      const auto crossing = static_cast<size_t>(along[i]);
      crossings[vertex - first_vertex] = static_cast<uint8_t>(crossing);
      if (!write) continue;
      const size_t at[3] = {list.sample[first + i] & 0xFFFFu, list.sample[first + i] >> 16, z};
      float* position = job.positions + vertex * 3;
      for (size_t axis = 0; axis < 3; ++axis)
        position[axis] = placed(at[axis] * kSubcell + (axis == size_t{kAxis} ? crossing : 0));
      if (!normals) continue;
      for (size_t axis = 0; axis < 3; ++axis) job.normals[vertex * 3 + axis] = normal[axis][i];
    }
  }
  list.count = 0;
}

/// Numbers the vertices of plane z, sample by sample and axis by axis: `numbers` gets the first of each sample that
/// owns any.
inline void writePlane(const GridJob& job, size_t z, const GridSlab& slab, const GridScratch& scratch,
                       uint32_t* numbers, bool write) {
  auto number = static_cast<uint32_t>(slab.first_vertex[z]);
  const uint64_t first_vertex = slab.first_vertex[slab.first];
  const size_t room = gridEdgeRoom(job.size[0]);
  EdgeList lists[3];
  for (size_t axis = 0; axis < 3; ++axis)
    lists[axis] = {scratch.edges + 2 * axis * room, scratch.edges + (2 * axis + 1) * room, 0};
  for (size_t y = 0; y < job.size[1]; ++y) {
    for (size_t word = 0; word < job.words; ++word) {
      const Crossed c = crossedOf(job, y, z, word);
      for (uint64_t owners = c.x | c.y | c.z; owners != 0; owners &= owners - 1) {
        const int bit = std::countr_zero(owners);
        const auto x = static_cast<uint32_t>(word * 64) + static_cast<uint32_t>(bit);
        numbers[y * job.size[0] + x] = number;
        const uint32_t crossed[3] = {bitOf(c.x, bit), bitOf(c.y, bit), bitOf(c.z, bit)};
        for (size_t axis = 0; axis < 3; ++axis) {
          EdgeList& list = lists[axis];
          list.sample[list.count] = static_cast<uint32_t>(y << 16) | x;
          list.vertex[list.count] = number;
          list.count += crossed[axis];
          number += crossed[axis];
        }
      }
    }
    const bool last = y + 1 == job.size[1];
    if (last || lists[0].count >= kGridEdges) writeEdges<0>(job, z, lists[0], first_vertex, scratch.crossings, write);
    if (last || lists[1].count >= kGridEdges) writeEdges<1>(job, z, lists[1], first_vertex, scratch.crossings, write);
    if (last || lists[2].count >= kGridEdges) writeEdges<2>(job, z, lists[2], first_vertex, scratch.crossings, write);
  }
}

// ---- triangles ------------------------------------------------------------------------------------------------------

/// Where a vertex lies in its cell, in 256ths: 9 bits an axis, and 0 along its edge.
struct CubePlaces {
  uint32_t place[kCubeEdges];
  uint8_t shift[kCubeEdges];  ///< of the crossing
};
constexpr CubePlaces makeCubePlaces() {
  CubePlaces places{};
  for (int e = 0; e < kCubeEdges; ++e) {
    const int axis = e / 4, lower = axis == 0 ? 1 : 0, upper = axis == 2 ? 1 : 2;
    places.place[e] = static_cast<uint32_t>((e & 1) * kSubcell) << 9 * lower |
                      static_cast<uint32_t>((e >> 1 & 1) * kSubcell) << 9 * upper;
    places.shift[e] = static_cast<uint8_t>(9 * axis);
  }
  return places;
}
inline constexpr CubePlaces kCubePlaces = makeCubePlaces();

/// Loops of one length, until there are enough for a vector.
template <size_t N>
struct LoopQueue {
  alignas(64) uint32_t vertex[N][kLanes] = {}, place[N][kLanes] = {}, faces[N][kLanes] = {};
  uint32_t* out[kLanes] = {};
  size_t count = 0;
};

inline Int absolute(Int a) { return sel(a < broadcastInt(0), wrapSub(broadcastInt(0), a), a); }

/// triangulateLoopOf of mesh/triangulate.h for kLanes loops at a time.
template <size_t N>
void triangulateLanes(LoopQueue<N>& queue) {
  if (queue.count == 0) return;
  using triangulation::firstWay;
  using triangulation::kWays;
  struct Cross {
    Int x, y, z;
  };
  const auto norm = [](const Cross& c) { return wrapAdd(wrapAdd(absolute(c.x), absolute(c.y)), absolute(c.z)); };
  Int x[N], y[N], z[N], faces[N], best[N][N], way[N][N];
  Cross cross[N][N];  // of the points' positions relative to point 0
#pragma GCC unroll 8
  for (size_t i = 0; i < N; ++i) {
    const Uint place = toUintBits(loadLanes(queue.place[i]));
    x[i] = toIntBits(place & Uint(511u));
    y[i] = toIntBits(place >> 9 & Uint(511u));
    z[i] = toIntBits(place >> 18);
    faces[i] = loadLanes(queue.faces[i]);
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
      const Bool allowed = (faces[i] & faces[j]) == broadcastInt(0);
      best[i][j] = span == N - 1 ? largest : sel(allowed, largest, broadcastInt(-1));
      way[i][j] = chosen;
    }
  }
  alignas(64) int32_t ways[kLanes];
  storeLanes(way[0][N - 1], ways);
  for (size_t lane = 0; lane < queue.count; ++lane) {
    const uint8_t* triangles = triangulation::kTriangles<N>[static_cast<size_t>(ways[lane])].data();
    uint32_t* out = queue.out[lane];
#pragma GCC unroll 16
    for (size_t i = 0; i < 3 * (N - 2); ++i) out[i] = queue.vertex[triangles[i]][lane];
  }
  queue.count = 0;
}

/// The vertices of a cell by edge of the cube, and how far along their edges they are.
struct CellVertices {
  uint32_t number[kCubeEdges];
  const uint8_t* crossings;
  uint64_t first;

  uint32_t place(uint8_t e) const {
    return kCubePlaces.place[e] + (uint32_t{crossings[number[e] - first]} << kCubePlaces.shift[e]);
  }
};

template <size_t N>
void queueLoop(LoopQueue<N>& queue, const CellVertices& cell, const uint8_t* loop, uint32_t* out) {
  const size_t lane = queue.count++;
  queue.out[lane] = out;
#pragma GCC unroll 8
  for (size_t i = 0; i < N; ++i) {
    const uint8_t e = loop[i];
    queue.vertex[i][lane] = cell.number[e];
    queue.place[i][lane] = cell.place(e);
    queue.faces[i][lane] = kCubeEdgeFaces[e];
  }
  if (queue.count == kLanes) triangulateLanes(queue);
}

/// Loops of all lengths: what is not written yet when it ends is written then.
class Triangulator {
 public:
  uint32_t* add(const CellVertices& cell, size_t n, const uint8_t* loop, uint32_t* out) {
    switch (n) {
      case 3:
        for (size_t i = 0; i < 3; ++i) out[i] = cell.number[loop[i]];
        break;
      case 4:
        queueLoop(four_, cell, loop, out);
        break;
      case 5:
        queueLoop(five_, cell, loop, out);
        break;
      case 6:
        queueLoop(six_, cell, loop, out);
        break;
      default:
        queueLoop(seven_, cell, loop, out);
    }
    return out + 3 * (n - 2);
  }
  void finish() {
    triangulateLanes(four_);
    triangulateLanes(five_);
    triangulateLanes(six_);
    triangulateLanes(seven_);
  }

 private:
  LoopQueue<4> four_;
  LoopQueue<5> five_;
  LoopQueue<6> six_;
  LoopQueue<7> seven_;
};
static_assert(kLongestCubeLoop == 7);

/// The triangles of the cells between planes z and z + 1; returns their end.
inline uint32_t* meshLayer(const GridJob& job, size_t z, const uint32_t* low, const uint32_t* high, CellVertices& cell,
                           Triangulator& triangulator, uint32_t* next) {
  const size_t nx = job.size[0], ny = job.size[1];
  for (size_t y = 0; y + 1 < ny; ++y) {
    const uint64_t* const rows[4] = {job.signRow(y, z), job.signRow(y + 1, z), job.signRow(y, z + 1),
                                     job.signRow(y + 1, z + 1)};
    const uint32_t* const of_row[4] = {low + y * nx, low + (y + 1) * nx, high + y * nx, high + (y + 1) * nx};
    const uint64_t* beyond = y + 2 < ny ? job.signRow(y + 2, z) : rows[1];
    for (size_t word = 0; word < job.words; ++word) {
      if (isUniform(rows, word, job.words)) continue;
      const CellSigns s = cellSigns(job, rows, word);
      if (s.active == 0) continue;
      // Of the samples at high x: whether they own an edge along x, and those at high y: along y.
      const uint64_t inside = wordMask(word, nx - 2);
      uint64_t high_x[3];
      for (size_t i = 0; i < 3; ++i) {
        const uint64_t after = s.high[i] >> 1 | (word + 1 < job.words ? (rows[i][word + 1] >> 1 & 1) << 63 : 0);
        high_x[i] = (s.high[i] ^ after) & inside;
      }
      const uint64_t high_y0 = s.low[1] ^ beyond[word], high_y1 = s.high[1] ^ shifted(beyond, word, job.words);
      for (uint64_t left = s.active; left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left);
        const size_t x = word * 64 + static_cast<size_t>(bit);
        const uint32_t c = caseOf(s, bit);
        const uint32_t n0 = of_row[0][x], n1 = of_row[0][x + 1] + bitOf(high_x[0], bit);
        const uint32_t n2 = of_row[1][x], n3 = of_row[1][x + 1] + bitOf(high_x[1], bit);
        const uint32_t n4 = of_row[2][x], n5 = of_row[2][x + 1] + bitOf(high_x[2], bit);
        const uint32_t x0 = (c ^ c >> 1) & 1, x2 = (c >> 2 ^ c >> 3) & 1, x4 = (c >> 4 ^ c >> 5) & 1;
        const uint32_t y0 = (c ^ c >> 2) & 1, y1 = (c >> 1 ^ c >> 3) & 1;
        uint32_t* number = cell.number;
        number[0] = n0;
        number[1] = n2;
        number[2] = n4;
        number[3] = of_row[3][x];
        number[4] = n0 + x0;
        number[5] = n1;
        number[6] = n4 + x4;
        number[7] = n5;
        number[8] = n0 + x0 + y0;
        number[9] = n1 + y1;
        number[10] = n2 + x2 + bitOf(high_y0, bit);
        number[11] = n3 + bitOf(high_y1, bit);
        const uint8_t* loop = kCubeLoops + kCubeLoopStart[c];
        const uint8_t* end = kCubeLoops + kCubeLoopStart[c + 1];
        while (loop != end) {
          const size_t n = *loop++;
          next = triangulator.add(cell, n, loop, next);
          loop += n;
        }
      }
    }
  }
  return next;
}

inline void meshSlab(const GridJob& job, const GridSlab& slab, const GridScratch& scratch) {
  uint32_t* low = scratch.numbers;
  uint32_t* high = scratch.numbers + job.size[0] * job.size[1];
  uint32_t* next = job.indices + slab.first_triangle[slab.first] * 3;
  CellVertices cell{{}, scratch.crossings, slab.first_vertex[slab.first]};
  Triangulator triangulator;
  writePlane(job, slab.first, slab, scratch, low, true);
  for (size_t z = slab.first; z < slab.last && z + 1 < job.size[2]; ++z) {
    // The plane above the last belongs to another slab, which writes its vertices; its numbers are needed here too.
    writePlane(job, z + 1, slab, scratch, high, z + 1 < slab.last);
    next = meshLayer(job, z, low, high, cell, triangulator, next);
    std::swap(low, high);
  }
  triangulator.finish();
}
