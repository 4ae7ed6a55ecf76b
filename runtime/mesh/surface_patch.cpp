#include "mesh/surface_patch.h"

#include <algorithm>
#include <tuple>

#include "mesh/triangulate.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

/// Of the grid edge that starts at a sample.
uint64_t edgeCode(const Int3& sample, int axis) {
  return uint64_t{CellSet::codeOf(sample)} << 2 | static_cast<uint64_t>(axis);
}

/// Whether two edges of a cell lie in one face.
bool shareFace(const VertexKey& a, const VertexKey& b) {
  if (a.axis != b.axis) {
    const int axis = 3 - a.axis - b.axis;
    return a.corner[axis] == b.corner[axis];
  }
  const int first = (a.axis + 1) % 3, second = (a.axis + 2) % 3;
  return a.corner[first] == b.corner[first] || a.corner[second] == b.corner[second];
}

/// The sample at which an edge of a cell starts.
Int3 startOf(const Int3& cell, uint32_t edge) {
  const uint32_t axis = edge / 4;
  Int3 sample = cell;
  sample[axis == 0 ? 1 : 0] += static_cast<int32_t>(edge & 1);
  sample[axis == 2 ? 1 : 2] += static_cast<int32_t>(edge >> 1 & 1);
  return sample;
}

/// Where the surface crosses an edge, as meshing places it: vertices of the body may have slid along theirs since.
Int3 crossingOn(const Int3& cell, uint32_t edge, const std::array<int32_t, 8>& q) {
  const Int3 sample = startOf(cell, edge);
  const int axis = static_cast<int>(edge / 4);
  const auto from = static_cast<size_t>((sample.x - cell.x) | (sample.y - cell.y) << 1 | (sample.z - cell.z) << 2);
  Int3 at{sample.x * kSubcell, sample.y * kSubcell, sample.z * kSubcell};
  at[axis] += static_cast<int32_t>(crossing(q[from], q[from | size_t{1} << axis]));
  return at;
}

}  // namespace

SurfacePatch::SurfacePatch(const ChunkGrid& grid, const FieldSampler& field, std::pmr::memory_resource* memory)
    : grid_(grid),
      field_(field),
      memory_(memory),
      part_(memory),
      loops_(memory),
      cells_(memory),
      numbers_(memory),
      row_starts_(memory),
      sampled_(memory),
      outer_(memory) {}

bool SurfacePatch::isInBody(const Int3& cell) const {
  return has_body_ && std::min({cell.x, cell.y, cell.z}) >= 0 && std::max({cell.x, cell.y, cell.z}) < kChunkCells;
}

bool SurfacePatch::isInWorld(const Int3& cell) const {
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t lo = grid_.origin[axis] + int64_t{cell[axis]} * grid_.cell, hi = lo + grid_.cell;
    if (lo != saturate(lo) || hi != saturate(hi)) return false;
  }
  return true;
}

Int3 SurfacePatch::cornerOf(const Int3& cell) const {
  Int3 corner = grid_.origin;
  for (int axis = 0; axis < 3; ++axis) corner[axis] += cell[axis] * grid_.cell;
  return corner;
}

std::span<const uint32_t> SurfacePatch::loopsOf(const Int3& cell) const {
  const auto [first, last] = std::equal_range(cells_.begin(), cells_.end(), CellSet::codeOf(cell));
  return {numbers_.data() + (first - cells_.begin()), static_cast<size_t>(last - first)};
}

void SurfacePatch::addBody(const MeshPart& body) {
  has_body_ = true;
  part_.vertices.assign(body.vertices.begin(), body.vertices.end());
  part_.keys.assign(body.keys.begin(), body.keys.end());
  part_.indices.assign(body.indices.begin(), body.indices.end());
  for (uint32_t v = 0; v < part_.vertices.size(); ++v) {
    const Vertex& at = part_.vertices[v];
    const bool on_border = std::min({at.x, at.y, at.z}) == 0 || std::max({at.x, at.y, at.z}) == kChunkCells * kSubcell;
    if (!on_border) continue;
    const SampleEdge edge = edgeOfBodyVertex(at);
    outer_.emplace(edgeCode({edge.x, edge.y, edge.z}, edge.axis), v);
  }
  takeLoops(0, part_.indices.size());
  index(0);
}

/// Finds the loops that a body's triangles were made from.
void SurfacePatch::takeLoops(size_t first_index, size_t end_index) {
  const RawVector<uint32_t>& indices = part_.indices;
  const auto cellOf = [&](size_t at) {
    Int3 cell;
    for (int axis = 0; axis < 3; ++axis) {
      int32_t lo = INT32_MIN;
      for (size_t k = 0; k < 3; ++k) {
        const VertexKey& key = part_.keys[indices[at + k]];
        const int32_t sample = static_cast<int32_t>((int64_t{key.corner[axis]} - grid_.origin[axis]) / grid_.cell);
        lo = std::max(lo, sample - (key.axis == axis ? 0 : 1));
      }
      cell[axis] = std::max(lo, 0);
    }
    return cell;
  };
  for (size_t at = first_index; at < end_index;) {
    SurfaceLoop loop;
    loop.cell = cellOf(at);
    loop.first_index = static_cast<uint32_t>(at);
    std::array<std::array<uint32_t, 2>, kLongestCubeLoop> sides{};
    uint32_t count = 0;
    const auto take = [&] {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = indices[at + k], b = indices[at + (k + 1) % 3];
        if (shareFace(part_.keys[a], part_.keys[b])) sides[count++] = {a, b};
      }
      at += 3;
    };
    const auto joins = [&](uint32_t v) {
      return std::find(indices.data() + loop.first_index, indices.data() + at, v) != indices.data() + at;
    };
    take();
    // A loop's triangles stand together, and loops of a cell have no vertex in common.
    while (at < end_index && cellOf(at) == loop.cell &&
           (joins(indices[at]) || joins(indices[at + 1]) || joins(indices[at + 2]))) {
      take();
    }
    loop.end_index = static_cast<uint32_t>(at);
    uint32_t next = indices[loop.first_index];
    for (uint32_t i = 0; i < count; ++i) {
      loop.vertices[loop.count++] = next;
      next = (*std::find_if(sides.begin(), sides.end(), [&](const auto& side) { return side[0] == next; }))[1];
    }
    loops_.push_back(loop);
  }
}

uint32_t SurfacePatch::addVertex(const Vertex& vertex, const VertexKey& key) {
  Int3 sample;
  for (int axis = 0; axis < 3; ++axis) {
    sample[axis] = static_cast<int32_t>((int64_t{key.corner[axis]} - grid_.origin[axis]) / grid_.cell);
  }
  const auto number = static_cast<uint32_t>(part_.vertices.size());
  outer_.emplace(edgeCode(sample, key.axis), number);
  part_.vertices.push_back(vertex);
  part_.keys.push_back(key);
  return number;
}

void SurfacePatch::addCells(const CellSet& cells) {
  const auto sampleOf = [](const Int3& cell, int corner) {
    return Int3{cell.x + (corner & 1), cell.y + (corner >> 1 & 1), cell.z + (corner >> 2)};
  };
  std::pmr::vector<Int3> wanted(memory_), points(memory_);
  CellSet corners(memory_);
  cells.forEach([&](const Int3& cell) {
    if (isInBody(cell) || !isInWorld(cell) || sampled_.has(cell)) return;
    sampled_.add(cell);
    wanted.push_back(cell);
    for (int corner = 0; corner < 8; ++corner) corners.add(sampleOf(cell, corner));
  });
  if (wanted.empty()) return;
  points.reserve(corners.number());
  corners.forEach([&](const Int3& sample) { points.push_back(cornerOf(sample)); });
  std::pmr::vector<FieldSample> samples(points.size(), memory_);
  field_(points, samples, Sampled::value);

  const size_t first_loop = loops_.size();
  for (const Int3& cell : wanted) {
    std::array<int32_t, 8> q{};
    for (int corner = 0; corner < 8; ++corner) {
      q[static_cast<size_t>(corner)] = samples[corners.placeOf(sampleOf(cell, corner))].q;
    }
    addLoops(cell, q);
  }
  index(first_loop);
}

void SurfacePatch::addLoops(const Int3& cell, const std::array<int32_t, 8>& q) {
  uint32_t solid = 0;
  for (size_t corner = 0; corner < 8; ++corner) solid |= uint32_t{q[corner] < 0} << corner;
  const uint8_t* edges = kCubeLoops + kCubeLoopStart[solid];
  const uint8_t* const end = kCubeLoops + kCubeLoopStart[solid + 1];
  while (edges != end) {
    const int n = *edges++;
    SurfaceLoop loop;
    loop.cell = cell;
    loop.first_index = static_cast<uint32_t>(part_.indices.size());
    std::array<LoopPoint, kLongestCubeLoop> points;
    for (int i = 0; i < n; ++i) {
      const uint32_t edge = edges[i];
      const Int3 at = crossingOn(cell, edge, q);
      const uint32_t number = vertexOnEdge(cell, edge, at);
      points[static_cast<size_t>(i)] = {at.x, at.y, at.z, chordMask(kCubeEdgeFaces[edge], edge, n), number};
      loop.vertices[loop.count++] = number;
    }
    std::array<uint32_t, 3 * (kLongestCubeLoop - 2)> triangles;
    uint32_t* const last = triangulateAnyLoop<kLongestCubeLoop>(points.data(), n, triangles.data());
    part_.indices.insert(part_.indices.end(), triangles.data(), last);
    loop.end_index = static_cast<uint32_t>(part_.indices.size());
    loops_.push_back(loop);
    edges += n;
  }
}

uint32_t SurfacePatch::vertexOnEdge(const Int3& cell, uint32_t edge, const Int3& at) {
  const int axis = static_cast<int>(edge / 4);
  const Int3 sample = startOf(cell, edge);
  if (const auto known = outer_.find(edgeCode(sample, axis)); known != outer_.end()) return known->second;
  Vertex vertex{};
  vertex.x = static_cast<int16_t>(at.x);
  vertex.y = static_cast<int16_t>(at.y);
  vertex.z = static_cast<int16_t>(at.z);
  return addVertex(vertex, {cornerOf(sample), static_cast<uint8_t>(grid_.level), static_cast<uint8_t>(axis), 0});
}

/// Finds the loops from first_loop on by their cells, too.
void SurfacePatch::index(size_t first_loop) {
  std::pmr::vector<std::pair<uint32_t, uint32_t>> all(memory_);
  all.reserve(loops_.size());
  for (size_t i = 0; i < numbers_.size(); ++i) all.emplace_back(cells_[i], numbers_[i]);
  for (size_t i = first_loop; i < loops_.size(); ++i)
    all.emplace_back(CellSet::codeOf(loops_[i].cell), static_cast<uint32_t>(i));
  const auto fresh = all.begin() + static_cast<std::ptrdiff_t>(numbers_.size());
  // A body's loops come in this order.
  if (!std::is_sorted(fresh, all.end())) std::sort(fresh, all.end());
  std::inplace_merge(all.begin(), fresh, all.end());
  cells_.resize(all.size());
  numbers_.resize(all.size());
  for (size_t i = 0; i < all.size(); ++i) std::tie(cells_[i], numbers_[i]) = all[i];
  row_starts_.assign(64 * 64 + 1, 0);
  for (const uint32_t cell : cells_) ++row_starts_[(cell >> 6) + 1];
  for (size_t row = 1; row < row_starts_.size(); ++row) row_starts_[row] += row_starts_[row - 1];
}

}  // namespace sgm
