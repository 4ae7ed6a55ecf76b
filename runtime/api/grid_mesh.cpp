#include "api/grid_mesh.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <vector>

#include "mesh/chunk.h"
#include "mesh/tables.h"
#include "mesh/triangulate.h"
#include "mesh/vertex.h"

namespace sgm::api {
namespace {

constexpr float kMost = static_cast<float>(kMaxQ);

/// The value in 1024ths of a cell, within the range of Q.
inline float scaled(float value, float scale) { return std::clamp(value * scale, -kMost, kMost); }

inline int32_t quantised(float value, float scale) {
  return static_cast<int32_t>(std::floor(scaled(value, scale) + 0.5f));
}

/// Eight bytes of 0 or 1 to eight bits, the first byte lowest.
inline uint64_t packBits(const uint8_t* bytes) {
  uint64_t eight;
  std::memcpy(&eight, bytes, 8);
  return eight * 0x0102040810204080u >> 56;
}

/// Writes the sign words of one row. Returns whether every value is finite.
bool classifyRow(const float* values, size_t count, float scale, uint64_t* words) {
  bool finite = true;
  for (size_t first = 0; first < count; first += 64) {
    alignas(8) uint8_t solid[64] = {};
    const size_t some = std::min<size_t>(64, count - first);
    uint32_t bad = 0;
    for (size_t i = 0; i < some; ++i) {
      const float v = values[first + i];
      // The same sign as floor(clamp(v * scale) + 0.5).
      solid[i] = v * scale + 0.5f < 0.0f ? 1 : 0;
      bad |= std::fabs(v) <= std::numeric_limits<float>::max() ? 0u : 1u;
    }
    finite = finite && bad == 0;
    uint64_t word = 0;
    for (size_t i = 0; i < 8; ++i) word |= packBits(solid + 8 * i) << 8 * i;
    words[first / 64] = word;
  }
  return finite;
}

/// Bits moved down by one across the words of a row.
inline uint64_t shifted(const uint64_t* row, size_t word, size_t words) {
  return row[word] >> 1 | (word + 1 < words ? row[word + 1] << 63 : 0);
}

struct Crossings {
  uint64_t x, y, z;
};

struct Active {
  uint64_t cells;
  uint64_t low[4], high[4];  ///< signs of the cells' low and high x corners, by row
};

class GridMesher {
 public:
  GridMesher(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory)
      : grid_(grid),
        jobs_(jobs),
        memory_(memory),
        scale_(static_cast<float>(1024.0 / grid.cell)),
        words_((grid.size[0] + 63) / 64),
        signs_(memory),
        first_vertex_(grid.size[2] + 1, 0, memory),
        first_triangle_(grid.size[2] + 1, 0, memory) {}

  Result<GridMesh> run();

 private:
  size_t nx() const { return grid_.size[0]; }
  size_t ny() const { return grid_.size[1]; }
  size_t nz() const { return grid_.size[2]; }
  const uint64_t* row(size_t y, size_t z) const { return signs_.data() + (z * ny() + y) * words_; }
  const float* values(size_t y, size_t z) const { return grid_.values + y * grid_.stride_y + z * grid_.stride_z; }
  /// Bits of samples (or cells, with one less) that exist in a word of a row.
  uint64_t wordMask(size_t word, size_t count) const {
    const size_t first = word * 64;
    return count >= first + 64 ? ~uint64_t{0} : count <= first ? 0 : (uint64_t{1} << (count - first)) - 1;
  }

  Crossings crossings(size_t y, size_t z, size_t word) const;
  Active activeCells(size_t y, size_t z, size_t word) const;
  void countPlane(size_t z);
  void meshPlanes(size_t begin, size_t end, GridMesh& mesh);
  void growBounds(size_t begin, size_t end, GridMesh& mesh);

  /// A crossed edge of the two planes that a layer of cells lies between: its vertex and how far along it is.
  struct Edge {
    uint32_t vertex, t;
  };
  void numberPlane(size_t z, Edge* edges, GridMesh* mesh) const;
  void writeVertex(GridMesh& mesh, uint32_t vertex, std::array<size_t, 3> sample, int axis, uint32_t t) const;
  std::array<float, 3> gradient(std::array<size_t, 3> sample) const;
  void meshLayer(size_t z, const Edge* low, const Edge* high, uint32_t* next) const;

  const GridSamples& grid_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  float scale_;
  size_t words_;
  std::pmr::vector<uint64_t> signs_;
  std::mutex bounds_mutex_;
  bool bounded_ = false;                                      ///< some slab has set the bounds
  std::pmr::vector<uint64_t> first_vertex_, first_triangle_;  ///< by plane and by layer of cells; counts, then sums
};

Crossings GridMesher::crossings(size_t y, size_t z, size_t word) const {
  const uint64_t* here = row(y, z);
  const uint64_t a = here[word];
  return {(a ^ shifted(here, word, words_)) & wordMask(word, nx() - 1), y + 1 < ny() ? a ^ row(y + 1, z)[word] : 0,
          z + 1 < nz() ? a ^ row(y, z + 1)[word] : 0};
}

Active GridMesher::activeCells(size_t y, size_t z, size_t word) const {
  Active active{};
  uint64_t some = 0, all = ~uint64_t{0};
  for (size_t i = 0; i < 4; ++i) {
    const uint64_t* r = row(y + (i & 1), z + (i >> 1));
    active.low[i] = r[word];
    active.high[i] = shifted(r, word, words_);
    some |= active.low[i] | active.high[i];
    all &= active.low[i] & active.high[i];
  }
  active.cells = some & ~all & wordMask(word, nx() - 1);
  return active;
}

inline uint32_t caseOf(const Active& active, size_t bit) {
  uint32_t cell_case = 0;
  for (size_t i = 0; i < 4; ++i) {
    cell_case |= static_cast<uint32_t>((active.low[i] >> bit & 1) | (active.high[i] >> bit & 1) << 1) << 2 * i;
  }
  return cell_case;
}

void GridMesher::countPlane(size_t z) {
  uint64_t vertices = 0, triangles = 0;
  for (size_t y = 0; y < ny(); ++y) {
    for (size_t word = 0; word < words_; ++word) {
      const Crossings c = crossings(y, z, word);
      if ((c.x | c.y | c.z) != 0)
        vertices += static_cast<uint64_t>(std::popcount(c.x) + std::popcount(c.y) + std::popcount(c.z));
      if (y + 1 == ny() || z + 1 == nz()) continue;
      const Active active = activeCells(y, z, word);
      for (uint64_t cells = active.cells; cells != 0; cells &= cells - 1)
        triangles += kCubeTriangles[caseOf(active, static_cast<size_t>(std::countr_zero(cells)))];
    }
  }
  first_vertex_[z + 1] = vertices;
  first_triangle_[z + 1] = triangles;
}

std::array<float, 3> GridMesher::gradient(std::array<size_t, 3> sample) const {
  const float* centre = values(sample[1], sample[2]) + sample[0];
  const std::array<size_t, 3> stride{1, grid_.stride_y, grid_.stride_z};
  std::array<float, 3> result{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const bool low = sample[axis] > 0, high = sample[axis] + 1 < grid_.size[axis];
    const float before = scaled(low ? *(centre - stride[axis]) : *centre, scale_);
    const float after = scaled(high ? centre[stride[axis]] : *centre, scale_);
    result[axis] = (after - before) * (low && high ? 0.5f : 1.0f);
  }
  return result;
}

void GridMesher::writeVertex(GridMesh& mesh, uint32_t vertex, std::array<size_t, 3> sample, int axis,
                             uint32_t t) const {
  const auto a = static_cast<size_t>(axis);
  float* position = mesh.positions.data() + size_t{vertex} * 3;
  for (size_t i = 0; i < 3; ++i) {
    const size_t fixed = sample[i] * kSubcell + (i == a ? t : 0);
    position[i] = static_cast<float>(static_cast<double>(fixed) * (grid_.cell / kSubcell));
  }
  if (!grid_.normals) return;
  std::array<size_t, 3> next = sample;
  ++next[a];
  const std::array<float, 3> g0 = gradient(sample), g1 = gradient(next);
  const float along = static_cast<float>(t) * (1.0f / kSubcell);
  std::array<float, 3> n{};
  float square = 0;
  for (size_t i = 0; i < 3; ++i) {
    n[i] = g0[i] + (g1[i] - g0[i]) * along;
    square += n[i] * n[i];
  }
  float* normal = mesh.normals.data() + size_t{vertex} * 3;
  if (square > 0.0f) {
    const float scale = 1.0f / std::sqrt(square);
    for (size_t i = 0; i < 3; ++i) normal[i] = n[i] * scale;
    return;
  }
  // The gradient vanishes between samples whose signs differ: the edge's own direction, from solid to void.
  const bool solid_first = quantised(values(sample[1], sample[2])[sample[0]], scale_) < 0;
  for (size_t i = 0; i < 3; ++i) normal[i] = i != a ? 0.0f : solid_first ? 1.0f : -1.0f;
}

void GridMesher::numberPlane(size_t z, Edge* edges, GridMesh* mesh) const {
  auto number = static_cast<uint32_t>(first_vertex_[z]);
  for (size_t y = 0; y < ny(); ++y) {
    const float* here = values(y, z);
    for (size_t word = 0; word < words_; ++word) {
      const Crossings c = crossings(y, z, word);
      for (uint64_t owners = c.x | c.y | c.z; owners != 0; owners &= owners - 1) {
        const auto bit = static_cast<size_t>(std::countr_zero(owners));
        const size_t x = word * 64 + bit;
        const int32_t q = quantised(here[x], scale_);
        Edge* of_sample = edges + (y * nx() + x) * 3;
        const auto add = [&](int axis, float end) {
          const uint32_t t = crossing(q, quantised(end, scale_));
          of_sample[axis] = {number, t};
          if (mesh != nullptr) writeVertex(*mesh, number, {x, y, z}, axis, t);
          ++number;
        };
        if (c.x >> bit & 1) add(0, here[x + 1]);
        if (c.y >> bit & 1) add(1, here[x + grid_.stride_y]);
        if (c.z >> bit & 1) add(2, here[x + grid_.stride_z]);
      }
    }
  }
}

void GridMesher::meshLayer(size_t z, const Edge* low, const Edge* high, uint32_t* next) const {
  struct Place {
    const Edge* plane;
    size_t offset;
    int32_t x, y, z;
  };
  Place places[kCubeEdges];
  for (size_t e = 0; e < kCubeEdges; ++e) {
    const size_t axis = e / 4, first = e & 1, second = e >> 1 & 1;
    const size_t x = axis == 0 ? 0 : first, y = axis == 0 ? first : axis == 1 ? 0 : second, up = axis == 2 ? 0 : second;
    places[e] = {up == 0 ? low : high, (y * nx() + x) * 3 + axis, static_cast<int32_t>(x) * kSubcell,
                 static_cast<int32_t>(y) * kSubcell, static_cast<int32_t>(up) * kSubcell};
  }
  for (size_t y = 0; y + 1 < ny(); ++y) {
    for (size_t word = 0; word < words_; ++word) {
      const Active active = activeCells(y, z, word);
      for (uint64_t cells = active.cells; cells != 0; cells &= cells - 1) {
        const auto bit = static_cast<size_t>(std::countr_zero(cells));
        const size_t base = (y * nx() + word * 64 + bit) * 3;
        const uint32_t cell_case = caseOf(active, bit);
        const uint8_t* loop = kCubeLoops + kCubeLoopStart[cell_case];
        const uint8_t* end = kCubeLoops + kCubeLoopStart[cell_case + 1];
        while (loop != end) {
          const int n = *loop++;
          LoopPoint points[kLongestCubeLoop];
          for (int i = 0; i < n; ++i) {
            const uint8_t e = *loop++;
            const Place& at = places[e];
            const Edge edge = at.plane[base + at.offset];
            const auto t = static_cast<int32_t>(edge.t);
            points[i] = {at.x + (e < 4 ? t : 0), at.y + (e >= 4 && e < 8 ? t : 0), at.z + (e >= 8 ? t : 0),
                         kCubeEdgeFaces[e], edge.vertex};
          }
          next = triangulateLoop(points, n, next);
        }
      }
    }
  }
}

/// Takes in the vertices that the planes own, while they are in cache.
void GridMesher::growBounds(size_t begin, size_t end, GridMesh& mesh) {
  const size_t first = first_vertex_[begin], last = first_vertex_[end];
  if (first == last) return;
  std::array<float, 3> lo, hi;
  lo.fill(std::numeric_limits<float>::max());
  hi.fill(std::numeric_limits<float>::lowest());
  for (size_t v = first; v < last; ++v) {
    for (size_t i = 0; i < 3; ++i) {
      const float x = mesh.positions.data()[v * 3 + i];
      lo[i] = std::min(lo[i], x);
      hi[i] = std::max(hi[i], x);
    }
  }
  const std::lock_guard lock(bounds_mutex_);
  for (size_t i = 0; i < 3; ++i) {
    mesh.bounds_min[i] = bounded_ ? std::min(mesh.bounds_min[i], lo[i]) : lo[i];
    mesh.bounds_max[i] = bounded_ ? std::max(mesh.bounds_max[i], hi[i]) : hi[i];
  }
  bounded_ = true;
}

void GridMesher::meshPlanes(size_t begin, size_t end, GridMesh& mesh) {
  const size_t plane = nx() * ny() * 3;
  RawArray<Edge> edges(memory_);
  edges.allocate(plane * 2);
  Edge* low = edges.data();
  Edge* high = edges.data() + plane;
  numberPlane(begin, low, &mesh);
  for (size_t z = begin; z < end; ++z) {
    if (z + 1 == nz()) break;
    // The plane above the last belongs to another task, which writes its vertices; its numbers are needed here too.
    numberPlane(z + 1, high, z + 1 < end ? &mesh : nullptr);
    meshLayer(z, low, high, mesh.indices.data() + first_triangle_[z] * 3);
    std::swap(low, high);
  }
  growBounds(begin, end, mesh);
}

Result<GridMesh> GridMesher::run() {
  signs_.resize(words_ * ny() * nz());
  std::atomic<bool> finite{true};
  parallelFor(jobs_, nz(), [&](size_t z) {
    for (size_t y = 0; y < ny(); ++y) {
      if (!classifyRow(values(y, z), nx(), scale_, signs_.data() + (z * ny() + y) * words_))
        finite.store(false, std::memory_order_relaxed);
    }
  });
  if (!finite.load()) return Error{Code::invalid_argument, "a value of the grid is not finite", 0, 0};

  parallelFor(jobs_, nz(), [&](size_t z) { countPlane(z); });
  for (size_t z = 0; z < nz(); ++z) {
    first_vertex_[z + 1] += first_vertex_[z];
    first_triangle_[z + 1] += first_triangle_[z];
  }
  const uint64_t vertices = first_vertex_.back(), triangles = first_triangle_.back();
  constexpr uint64_t kMostNumbers = std::numeric_limits<uint32_t>::max();
  if (vertices > kMostNumbers || triangles > kMostNumbers / 3)
    return Error{Code::limit, "the mesh has more vertices or indices than 32 bits can number", 0, 0};

  GridMesh mesh(memory_);
  mesh.positions.allocate(vertices * 3);
  if (grid_.normals) mesh.normals.allocate(vertices * 3);
  mesh.indices.allocate(triangles * 3);
  if (vertices == 0) return mesh;

  // A few slabs a thread: each pays for one plane twice and for two planes of scratch.
  const size_t slabs = std::min<size_t>(nz(), size_t{jobs_.concurrency()} * 4);
  const size_t thick = (nz() + slabs - 1) / slabs;
  parallelFor(jobs_, (nz() + thick - 1) / thick,
              [&](size_t slab) { meshPlanes(slab * thick, std::min(nz(), (slab + 1) * thick), mesh); });
  return mesh;
}

}  // namespace

Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory) {
  return GridMesher(grid, jobs, memory).run();
}

}  // namespace sgm::api
