#include "api/grid_mesh.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "mesh/chunk.h"

namespace sgm::api {
namespace {

class GridMesher {
 public:
  GridMesher(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory, const MeshKernels& kernels)
      : grid_(grid),
        jobs_(jobs),
        memory_(memory),
        kernels_(kernels),
        signs_(memory),
        uniform_(memory),
        first_vertex_(grid.size[2] + 1, 0, memory),
        first_cell_(grid.size[2] + 1, 0, memory) {
    job_.values = grid.values;
    job_.lattice.size = grid.size;
    job_.stride_y = grid.stride_y;
    job_.stride_z = grid.stride_z;
    job_.scale = static_cast<float>(1024.0 / grid.cell);
    job_.step = grid.cell / kSubcell;
    job_.lattice.words = (grid.size[0] + 63) / 64;
  }

  Result<GridMesh> run();

 private:
  /// Planes first..last - 1 and what is listed of them.
  struct Slab {
    Slab(size_t first_in, size_t last_in, std::pmr::memory_resource* memory)
        : first(first_in), last(last_in), edges(memory), cells(memory) {}
    size_t first, last;
    RawArray<uint32_t> edges;
    RawArray<uint64_t> cells;
    uint64_t triangles = 0;
  };
  /// What one slab needs at a time; goes from slab to slab, since fresh memory costs more than the work in it.
  struct Scratch {
    explicit Scratch(std::pmr::memory_resource* memory) : numbers(memory), offsets(memory) {}
    RawArray<uint32_t> numbers, offsets;
  };

  bool findSigns();
  void list(Slab& slab);
  void meshSlab(size_t number);
  std::unique_ptr<Scratch> takeScratch();
  void giveScratch(std::unique_ptr<Scratch> scratch);

  const GridSamples& grid_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  const MeshKernels& kernels_;
  GridJob job_;
  RawArray<uint64_t> signs_, uniform_;
  std::vector<Slab> slabs_;
  std::pmr::vector<uint64_t> first_vertex_, first_cell_;  ///< by plane and by layer of cells; counts, then sums
  std::mutex mutex_;                                      ///< of what slabs share, which is all below
  GridBounds bounds_;
  std::vector<std::unique_ptr<Scratch>> free_scratch_;
};

/// False where a value is not finite.
bool GridMesher::findSigns() {
  const size_t words = job_.lattice.words;
  signs_.allocate(words * grid_.size[1] * grid_.size[2]);
  uniform_.allocate(2 * grid_.size[1] * grid_.size[2]);
  job_.lattice.signs = signs_.data();
  job_.lattice.uniform = uniform_.data();
  std::atomic<bool> finite{true};
  parallelFor(jobs_, grid_.size[2], [&](size_t z) {
    for (size_t y = 0; y < grid_.size[1]; ++y) {
      if (!kernels_.signs(job_, y, z, signs_.data() + (z * grid_.size[1] + y) * words,
                          uniform_.data() + (z * grid_.size[1] + y) * 2))
        finite.store(false, std::memory_order_relaxed);
    }
  });
  return finite.load();
}

void GridMesher::list(Slab& slab) {
  // Room is made for some rows at a time: how much of a plane is crossed nobody knows, and planes can be large.
  constexpr size_t kRows = 16;
  const size_t size_x = grid_.size[0], size_y = grid_.size[1];
  uint64_t vertices = 0, cells = 0;
  for (size_t z = slab.first; z < slab.last; ++z) {
    ListCounts plane;
    for (size_t y = 0; y < size_y; y += kRows) {
      slab.edges.grow(vertices, vertices + edgeRoom(size_x, kRows));
      slab.cells.grow(cells, cells + cellRoom(size_x, kRows));
      const ListCounts counts = kernels_.list(job_.lattice, z, y, std::min(y + kRows, size_y),
                                              slab.edges.data() + vertices, slab.cells.data() + cells);
      vertices += counts.vertices;
      cells += counts.cells;
      plane.vertices += counts.vertices;
      plane.cells += counts.cells;
      slab.triangles += counts.triangles;
    }
    first_vertex_[z + 1] = plane.vertices;
    first_cell_[z + 1] = plane.cells;
  }
}

std::unique_ptr<GridMesher::Scratch> GridMesher::takeScratch() {
  const std::lock_guard lock(mutex_);
  if (free_scratch_.empty()) return std::make_unique<Scratch>(memory_);
  std::unique_ptr<Scratch> scratch = std::move(free_scratch_.back());
  free_scratch_.pop_back();
  return scratch;
}

void GridMesher::giveScratch(std::unique_ptr<Scratch> scratch) {
  const std::lock_guard lock(mutex_);
  free_scratch_.push_back(std::move(scratch));
}

void GridMesher::meshSlab(size_t number) {
  const Slab& slab = slabs_[number];
  GridSlab listed{slab.first,        slab.last, first_vertex_.data(), first_cell_.data(), slab.triangles,
                  slab.edges.data(), nullptr,   slab.cells.data()};
  if (number + 1 < slabs_.size()) listed.edges_above = slabs_[number + 1].edges.data();
  std::unique_ptr<Scratch> scratch = takeScratch();
  scratch->numbers.grow(0, 2 * grid_.size[0] * grid_.size[1]);
  scratch->offsets.grow(0,
                        first_vertex_[std::min(slab.last + 1, grid_.size[2])] - first_vertex_[slab.first] + kMostLanes);
  const GridBounds bounds = kernels_.mesh(job_, listed, {scratch->numbers.data(), scratch->offsets.data()});
  giveScratch(std::move(scratch));
  const std::lock_guard lock(mutex_);
  for (size_t axis = 0; axis < 3; ++axis) {
    bounds_.lo[axis] = std::min(bounds_.lo[axis], bounds.lo[axis]);
    bounds_.hi[axis] = std::max(bounds_.hi[axis], bounds.hi[axis]);
  }
}

Result<GridMesh> GridMesher::run() {
  if (!findSigns()) return Error{Code::invalid_argument, "a value of the grid is not finite", 0, 0};
  // A few slabs a thread, since each may have more or less to do, but thick ones: each pays for one plane twice.
  constexpr size_t kThinnest = 16;
  const size_t planes = grid_.size[2], threads = jobs_.concurrency(), count = threads == 1 ? 1 : threads * 4;
  const size_t thick = std::max(kThinnest, (planes + count - 1) / count);
  for (size_t first = 0; first < planes; first += thick)
    slabs_.emplace_back(first, std::min(planes, first + thick), memory_);
  parallelFor(jobs_, slabs_.size(), [&](size_t slab) { list(slabs_[slab]); });
  for (size_t z = 0; z < planes; ++z) {
    first_vertex_[z + 1] += first_vertex_[z];
    first_cell_[z + 1] += first_cell_[z];
  }
  uint64_t triangles = 0;  // until here: of each slab, from now on: before it
  for (Slab& slab : slabs_) triangles += std::exchange(slab.triangles, triangles);
  const uint64_t vertices = first_vertex_.back();
  constexpr uint64_t kMostNumbers = std::numeric_limits<uint32_t>::max();
  if (vertices > kMostNumbers || triangles > kMostNumbers / 3)
    return Error{Code::limit, "the mesh has more vertices or indices than 32 bits can number", 0, 0};

  GridMesh mesh(memory_);
  mesh.positions.allocate(vertices * 3);
  if (grid_.normals) mesh.normals.allocate(vertices * 3);
  mesh.indices.allocate(triangles * 3);
  if (vertices == 0) return mesh;
  job_.positions = mesh.positions.data();
  job_.normals = mesh.normals.data();
  job_.indices = mesh.indices.data();

  parallelFor(jobs_, slabs_.size(), [&](size_t slab) { meshSlab(slab); });
  for (size_t axis = 0; axis < 3; ++axis) {
    // As vertices are placed: rounding keeps their order.
    mesh.bounds_min[axis] = static_cast<float>(bounds_.lo[axis] * job_.step);
    mesh.bounds_max[axis] = static_cast<float>(bounds_.hi[axis] * job_.step);
  }
  return mesh;
}

}  // namespace

Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory,
                          const MeshKernels& kernels) {
  // Places in a plane and its neighbours are counted in 32 bits. Only rows that lie very far from each other do not
  // allow that.
  constexpr size_t kFarthest = std::numeric_limits<int32_t>::max();
  if (grid.stride_y <= kFarthest / grid.size[1] && grid.stride_z <= kFarthest / 4)
    return GridMesher(grid, jobs, memory, kernels).run();
  RawArray<float> dense(memory);
  dense.allocate(grid.size[0] * grid.size[1] * grid.size[2]);
  for (size_t row = 0; row < grid.size[1] * grid.size[2]; ++row) {
    const float* from = grid.values + row % grid.size[1] * grid.stride_y + row / grid.size[1] * grid.stride_z;
    std::copy_n(from, grid.size[0], dense.data() + row * grid.size[0]);
  }
  GridSamples copy = grid;
  copy.values = dense.data();
  copy.stride_y = grid.size[0];
  copy.stride_z = grid.size[0] * grid.size[1];
  return GridMesher(copy, jobs, memory, kernels).run();
}

}  // namespace sgm::api
