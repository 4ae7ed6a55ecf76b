#include "api/grid_mesh.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <vector>

#include "backend/cpu/grid/grid_kernels.h"
#include "mesh/chunk.h"

namespace sgm::api {
namespace {

class GridMesher {
 public:
  GridMesher(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory)
      : grid_(grid),
        jobs_(jobs),
        memory_(memory),
        signs_(memory),
        first_vertex_(grid.size[2] + 1, 0, memory),
        first_triangle_(grid.size[2] + 1, 0, memory) {
    job_.values = grid.values;
    job_.size = grid.size;
    job_.stride_y = grid.stride_y;
    job_.stride_z = grid.stride_z;
    job_.scale = static_cast<float>(1024.0 / grid.cell);
    job_.step = grid.cell / kSubcell;
    job_.words = (grid.size[0] + 63) / 64;
  }

  Result<GridMesh> run();

 private:
  bool findSigns();
  void count();
  void meshPlanes(size_t begin, size_t end, GridMesh& mesh);
  void growBounds(size_t begin, size_t end, GridMesh& mesh);

  const GridSamples& grid_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  const GridKernels& kernels_ = bestGridKernels();
  GridJob job_;
  RawArray<uint64_t> signs_;
  std::mutex bounds_mutex_;
  bool bounded_ = false;                                      ///< some slab has set the bounds
  std::pmr::vector<uint64_t> first_vertex_, first_triangle_;  ///< by plane and by layer of cells; counts, then sums
};

/// False where a value is not finite.
bool GridMesher::findSigns() {
  signs_.allocate(job_.words * grid_.size[1] * grid_.size[2]);
  job_.signs = signs_.data();
  std::atomic<bool> finite{true};
  parallelFor(jobs_, grid_.size[2], [&](size_t z) {
    for (size_t y = 0; y < grid_.size[1]; ++y) {
      if (!kernels_.signs(job_, y, z)) finite.store(false, std::memory_order_relaxed);
    }
  });
  return finite.load();
}

void GridMesher::count() {
  parallelFor(jobs_, grid_.size[2], [&](size_t z) {
    const GridCounts counts = kernels_.count(job_, z);
    first_vertex_[z + 1] = counts.vertices;
    first_triangle_[z + 1] = counts.triangles;
  });
  for (size_t z = 0; z < grid_.size[2]; ++z) {
    first_vertex_[z + 1] += first_vertex_[z];
    first_triangle_[z + 1] += first_triangle_[z];
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
  RawArray<uint32_t> numbers(memory_), edges(memory_);
  RawArray<uint8_t> crossings(memory_);
  numbers.allocate(grid_.size[0] * grid_.size[1] * 2);
  edges.allocate(6 * gridEdgeRoom(grid_.size[0]));
  crossings.allocate(first_vertex_[std::min(end + 1, grid_.size[2])] - first_vertex_[begin]);
  kernels_.mesh(job_, {begin, end, first_vertex_.data(), first_triangle_.data()},
                {numbers.data(), edges.data(), crossings.data()});
  growBounds(begin, end, mesh);
}

Result<GridMesh> GridMesher::run() {
  if (!findSigns()) return Error{Code::invalid_argument, "a value of the grid is not finite", 0, 0};
  count();
  const uint64_t vertices = first_vertex_.back(), triangles = first_triangle_.back();
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

  // A few slabs a thread: each pays for one plane twice and for two planes of scratch.
  const size_t planes = grid_.size[2], slabs = std::min<size_t>(planes, size_t{jobs_.concurrency()} * 4);
  const size_t thick = (planes + slabs - 1) / slabs;
  parallelFor(jobs_, (planes + thick - 1) / thick,
              [&](size_t slab) { meshPlanes(slab * thick, std::min(planes, (slab + 1) * thick), mesh); });
  return mesh;
}

}  // namespace

Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory) {
  // Places in a plane are counted in 32 bits. Only rows that lie very far from each other do not allow that.
  if (grid.stride_y <= static_cast<size_t>(std::numeric_limits<int32_t>::max()) / grid.size[1])
    return GridMesher(grid, jobs, memory).run();
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
  return GridMesher(copy, jobs, memory).run();
}

}  // namespace sgm::api
