#include "api/grid_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "mesh/chunk.h"

namespace sgm::api {
namespace {

/// Maximum number of vertices, and of indices: indices have 32 bits.
constexpr uint64_t kMaxNumbers = std::numeric_limits<uint32_t>::max();

/// Lists of the grid edges that the surface crosses, and of the cells that it crosses, in one slab of the grid.
struct Lists {
  explicit Lists(std::pmr::memory_resource* memory) : edges(memory), cells(memory) {}
  RawArray<uint32_t> edges;
  RawArray<uint64_t> cells;
};

/// The buffers of one thread, reused for successive slabs: using new memory, or memory that another processor has
/// written, takes longer than the work itself.
struct Worker {
  explicit Worker(std::pmr::memory_resource* memory)
      : signs(memory), uniform(memory), numbers(memory), offsets(memory) {}
  RawArray<uint64_t> signs, uniform;  ///< signs of the samples in a slab's planes, and in the first plane of the slab
                                      ///< above
  RawArray<uint32_t> numbers, offsets;
  std::vector<std::unique_ptr<Lists>> free;  ///< unused lists, for reuse; guarded by the mesher's mutex
};

/// A slab of the grid: the planes of samples first..last - 1, and the layers of cells above these planes.
struct Slab {
  size_t first, last;
  Worker* worker = nullptr;
  std::unique_ptr<Lists> lists{};
  int readers;  ///< number of slabs that still need the lists: this slab and the one above it, until they are meshed
  bool listed = false, meshed = false;
};

/// Returns the number of planes per slab. Neighbouring slabs both need the plane between them, which makes thin slabs
/// expensive; with thick slabs, samples have left the CPU cache when vertices are placed.
size_t thicknessOf(const std::array<size_t, 3>& size, size_t threads) {
  constexpr size_t kThinnest = 4, kSamples = size_t{1} << 19, kWorthSharing = 8;
  const size_t in_cache = std::max(kThinnest, kSamples / (size[0] * size[1]));
  return threads == 1 ? in_cache : std::min(in_cache, std::max(kWorthSharing, size[2] / (threads * 4) + 1));
}

/// Meshes a grid slab by slab, so that samples are still in the CPU cache when vertices are placed between them. First
/// a slab is listed: its crossed edges and cells are counted. Once all slabs below it are listed too, it is settled:
/// its offset in the mesh's arrays is known, and it can be meshed. `settled_` is the number of settled slabs.
class GridMesher {
 public:
  GridMesher(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory, const MeshKernels& kernels)
      : grid_(grid),
        jobs_(jobs),
        memory_(memory),
        kernels_(kernels),
        thick_(thicknessOf(grid.size, jobs.concurrency())),
        shared_signs_(memory),
        shared_uniform_(memory),
        shared_((grid.size[2] + thick_ - 1) / thick_, memory),
        first_vertex_(grid.size[2] + 1, 0, memory),
        first_cell_(grid.size[2] + 1, 0, memory),
        first_triangle_(grid.size[2] + 1, 0, memory),
        mesh_(memory) {
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
  enum Signs : uint8_t { unread, being_read, read };

  void shareOut();
  void expect();
  void provide(uint64_t vertices, uint64_t triangles, size_t meshed);
  void work(Worker& worker);
  void readSigns(size_t z, uint64_t* signs, uint64_t* uniform);
  void takeSigns(size_t z, uint64_t* signs, uint64_t* uniform);
  void list(Slab& slab, Worker& worker);
  void settle(Slab& slab);
  void meshInTurn(size_t number, Worker& worker);
  void mesh(size_t number, Worker& worker);
  void stop();
  void release(Slab& slab);

  const GridSamples& grid_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  const MeshKernels& kernels_;
  GridJob job_;
  const size_t thick_;  ///< number of planes per slab; the last slab may have fewer
  std::vector<Slab> slabs_;
  /// The signs of each slab's first plane, which the slab below also needs. The first thread that needs a plane reads
  /// it for both slabs.
  RawArray<uint64_t> shared_signs_, shared_uniform_;
  std::pmr::vector<std::atomic<uint8_t>> shared_;
  /// Offsets in the mesh's arrays: first_vertex_[z] for plane z, first_cell_[z] and first_triangle_[z] for the layer of
  /// cells above plane z. Each is the sum of the counts of all lower planes or layers. Until a slab is settled, element
  /// z + 1 contains only the count of plane or layer z.
  std::pmr::vector<uint64_t> first_vertex_, first_cell_, first_triangle_;
  GridMesh mesh_;
  std::atomic<bool> finite_{true}, stopped_{false};
  std::atomic<size_t> next_{0}, settled_{0};  ///< number of the next slab to be listed; number of settled slabs
  std::mutex mutex_;                          ///< guards settling, and the members below
  GridBounds bounds_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

/// Reserves memory for the mesh, whose size is estimated from sampled rows. These rows are spread over y and z, so that
/// surfaces parallel to an axis of the grid are sampled as often as others.
void GridMesher::expect() {
  constexpr double kGolden = 0.6180339887498949;
  const size_t size_x = grid_.size[0], rows = std::min<size_t>(grid_.size[1], 3);
  GridJob job = job_;
  job.lattice.size = {size_x, rows, 2};
  RawArray<uint64_t> signs(memory_), cells(memory_);
  RawArray<uint32_t> edges(memory_);
  std::array<uint64_t, 12> uniform;
  signs.allocate(job.lattice.words * rows * 2);
  cells.allocate(cellRoom(size_x, 1));
  edges.allocate(edgeRoom(size_x, 1));
  job.lattice.signs = signs.data();
  job.lattice.uniform = uniform.data();
  constexpr size_t kMaxRows = 128;
  const size_t apart = (grid_.size[2] + kMaxRows - 1) / kMaxRows;
  ListCounts sum;
  for (size_t z = 0; z + 1 < grid_.size[2]; z += apart) {
    const double turn = static_cast<double>(z) * kGolden;
    const auto first = static_cast<size_t>((turn - std::floor(turn)) * static_cast<double>(grid_.size[1] - rows + 1));
    for (size_t row = 0; row < rows * 2; ++row)
      kernels_.signs(job_, first + row % rows, z + row / rows, signs.data() + row * job.lattice.words,
                     &uniform[row * 2]);
    const ListCounts counts = kernels_.list(job.lattice, 0, 0, 1, edges.data(), cells.data());
    sum.vertices += counts.vertices;
    sum.triangles += counts.triangles;
  }
  const auto expected = [&](uint64_t count) {
    return std::min(count * apart * grid_.size[1] / 8 * 9, kMaxNumbers / 3);
  };
  provide(expected(sum.vertices), expected(sum.triangles), 0);
}

/// Resizes the mesh's arrays. Keeps the parts of the first `meshed` slabs, which are already meshed.
void GridMesher::provide(uint64_t vertices, uint64_t triangles, size_t meshed) {
  uint64_t had_vertices = 0, had_triangles = 0;
  if (meshed > 0) {
    had_vertices = first_vertex_[slabs_[meshed - 1].last];
    had_triangles = first_triangle_[slabs_[meshed - 1].last - 1];
  }
  mesh_.positions.resize(3 * had_vertices, 3 * vertices);
  if (grid_.normals) mesh_.normals.resize(3 * had_vertices, 3 * vertices);
  mesh_.indices.resize(3 * had_triangles, 3 * triangles);
  job_.positions = mesh_.positions.data();
  job_.normals = mesh_.normals.data();
  job_.indices = mesh_.indices.data();
}

/// Stops all threads after an error. Also wakes the threads that wait for slabs which will never be settled.
void GridMesher::stop() {
  const std::lock_guard lock(mutex_);
  stopped_.store(true);
  settled_.store(slabs_.size());
  settled_.notify_all();
}

/// Computes the signs of a plane's samples, row by row. A value that is not finite stops all threads.
void GridMesher::readSigns(size_t z, uint64_t* signs, uint64_t* uniform) {
  bool finite = true;
  for (size_t y = 0; y < grid_.size[1]; ++y)
    finite = kernels_.signs(job_, y, z, signs + y * job_.lattice.words, uniform + y * 2) && finite;
  if (finite) return;
  finite_.store(false);
  stop();
}

/// Same as readSigns, but a plane that two slabs share is computed only once.
void GridMesher::takeSigns(size_t z, uint64_t* signs, uint64_t* uniform) {
  if (z % thick_ != 0) return readSigns(z, signs, uniform);
  const size_t slab = z / thick_, words = job_.lattice.words * grid_.size[1], rows = 2 * grid_.size[1];
  uint64_t *of_both = shared_signs_.data() + slab * words, *uniform_of_both = shared_uniform_.data() + slab * rows;
  uint8_t state = unread;
  if (shared_[slab].compare_exchange_strong(state, being_read)) {
    readSigns(z, of_both, uniform_of_both);
    shared_[slab].store(read);
    shared_[slab].notify_all();
  } else {
    while (shared_[slab].load() != read) shared_[slab].wait(being_read);
  }
  std::copy_n(of_both, words, signs);
  std::copy_n(uniform_of_both, rows, uniform);
}

void GridMesher::list(Slab& slab, Worker& worker) {
  // Memory is allocated for kRows rows at a time, because the number of crossings in a plane is unknown, and planes can
  // be large.
  constexpr size_t kRows = 16;
  const size_t size_x = grid_.size[0], size_y = grid_.size[1], words = job_.lattice.words * size_y, rows = 2 * size_y;
  uint64_t vertices = 0, cells = 0;
  {
    const std::lock_guard lock(mutex_);
    if (worker.free.empty()) worker.free.push_back(std::make_unique<Lists>(memory_));
    slab.lists = std::move(worker.free.back());
    worker.free.pop_back();
    slab.worker = &worker;
  }
  SignLattice lattice = job_.lattice;
  lattice.size[2] = std::min(slab.last + 1, grid_.size[2]) - slab.first;
  worker.signs.grow(0, words * lattice.size[2]);
  worker.uniform.grow(0, rows * lattice.size[2]);
  lattice.signs = worker.signs.data();
  lattice.uniform = worker.uniform.data();
  const auto take = [&](size_t plane) {
    takeSigns(slab.first + plane, worker.signs.data() + plane * words, worker.uniform.data() + plane * rows);
  };
  RawArray<uint32_t>& edges = slab.lists->edges;
  RawArray<uint64_t>& active = slab.lists->cells;
  take(0);
  for (size_t z = slab.first; z < slab.last; ++z) {
    const size_t plane = z - slab.first;
    if (plane + 1 < lattice.size[2]) take(plane + 1);
    ListCounts sum;
    for (size_t y = 0; y < size_y; y += kRows) {
      edges.grow(vertices, vertices + edgeRoom(size_x, kRows));
      active.grow(cells, cells + cellRoom(size_x, kRows));
      const ListCounts counts =
          kernels_.list(lattice, plane, y, std::min(y + kRows, size_y), edges.data() + vertices, active.data() + cells);
      vertices += counts.vertices;
      cells += counts.cells;
      sum.vertices += counts.vertices;
      sum.cells += counts.cells;
      sum.triangles += counts.triangles;
    }
    first_vertex_[z + 1] = sum.vertices;
    first_cell_[z + 1] = sum.cells;
    first_triangle_[z + 1] = sum.triangles;
  }
}

/// Settles a listed slab, and slabs above it that have waited for it: replaces their counts by sums, which are offsets.
void GridMesher::settle(Slab& slab) {
  const std::lock_guard lock(mutex_);
  if (stopped_.load()) return;
  slab.listed = true;
  size_t settled = settled_.load();
  for (; settled < slabs_.size() && slabs_[settled].listed; ++settled) {
    for (size_t z = slabs_[settled].first; z < slabs_[settled].last; ++z) {
      for (std::pmr::vector<uint64_t>* sums : {&first_vertex_, &first_cell_, &first_triangle_})
        (*sums)[z + 1] += (*sums)[z];
    }
  }
  settled_.store(settled);
  settled_.notify_all();
}

/// Called each time that a slab which needs this slab's lists has been meshed. The last of these calls returns the
/// lists to the thread's unused lists. Precondition: the caller holds mutex_.
void GridMesher::release(Slab& slab) {
  if (--slab.readers == 0) slab.worker->free.push_back(std::move(slab.lists));
}

/// Waits until all slabs below are settled and memory for the mesh is reserved, then meshes the slab.
void GridMesher::meshInTurn(size_t number, Worker& worker) {
  for (size_t settled; (settled = settled_.load()) <= number;) settled_.wait(settled);
  const Slab& slab = slabs_[number];
  if (!stopped_.load() && first_vertex_[slab.last] * 3 <= mesh_.positions.size() &&
      first_triangle_[slab.last - 1] * 3 <= mesh_.indices.size())
    mesh(number, worker);
}

void GridMesher::mesh(size_t number, Worker& worker) {
  Slab& slab = slabs_[number];
  GridSlab listed;
  listed.first = slab.first;
  listed.last = slab.last;
  listed.first_vertex = first_vertex_.data();
  listed.first_cell = first_cell_.data();
  listed.edges = slab.lists->edges.data();
  listed.cells = slab.lists->cells.data();
  uint64_t first = 0;
  if (number > 0) {
    const Slab& below = slabs_[number - 1];
    const size_t plane = slab.first - 1;
    first = first_vertex_[plane];
    listed.first_triangle = first_triangle_[plane];
    listed.edges_below = below.lists->edges.data() + (first - first_vertex_[below.first]);
    listed.cells_below = below.lists->cells.data() + (first_cell_[plane] - first_cell_[below.first]);
  }
  worker.numbers.grow(0, 2 * grid_.size[0] * grid_.size[1]);
  worker.offsets.grow(0, first_vertex_[slab.last] - first + kMaxLanes);
  const GridBounds bounds = kernels_.mesh(job_, listed, {worker.numbers.data(), worker.offsets.data()});
  slab.meshed = true;
  const std::lock_guard lock(mutex_);
  release(slab);
  if (number > 0) release(slabs_[number - 1]);
  for (size_t axis = 0; axis < 3; ++axis) {
    bounds_.lo[axis] = std::min(bounds_.lo[axis], bounds.lo[axis]);
    bounds_.hi[axis] = std::max(bounds_.hi[axis], bounds.hi[axis]);
  }
}

void GridMesher::shareOut() {
  const size_t planes = grid_.size[2];
  for (size_t first = 0; first < planes; first += thick_) {
    const size_t last = std::min(first + thick_, planes);
    slabs_.push_back({.first = first, .last = last, .readers = last < planes ? 2 : 1});
  }
  const size_t threads = std::min<size_t>(jobs_.concurrency(), slabs_.size());
  while (workers_.size() < threads) workers_.push_back(std::make_unique<Worker>(memory_));
  shared_signs_.allocate(job_.lattice.words * grid_.size[1] * slabs_.size());
  shared_uniform_.allocate(2 * grid_.size[1] * slabs_.size());
}

/// The loop of one thread. Threads take slabs in ascending order. So when a slab is listed, every slab below was
/// already taken by some thread, and waiting for it cannot deadlock.
void GridMesher::work(Worker& worker) {
  try {
    for (size_t number; !stopped_.load() && (number = next_.fetch_add(1)) < slabs_.size();) {
      list(slabs_[number], worker);
      settle(slabs_[number]);
      meshInTurn(number, worker);
    }
  } catch (...) {
    stop();
    throw;
  }
}

Result<GridMesh> GridMesher::run() {
  shareOut();
  // Estimate the mesh's size only if there are more slabs than threads. Otherwise, most slabs are listed, and so
  // counted exactly, before the first is meshed.
  if (slabs_.size() > workers_.size()) expect();
  parallelFor(jobs_, workers_.size(), [&](size_t i) { work(*workers_[i]); });
  if (!finite_.load()) return Error{Code::invalid_argument, "a value of the grid is not finite", 0, 0};

  const uint64_t vertices = first_vertex_.back(), triangles = first_triangle_.back();
  if (vertices > kMaxNumbers || triangles > kMaxNumbers / 3)
    return Error{Code::limit, "the mesh has more vertices or indices than a 32-bit number can count", 0, 0};
  const auto rest = std::find_if(slabs_.begin(), slabs_.end(), [](const Slab& slab) { return !slab.meshed; });
  const auto meshed = static_cast<size_t>(rest - slabs_.begin());
  const bool far_too_large = mesh_.positions.size() / 2 > 3 * vertices || mesh_.indices.size() / 2 > 3 * triangles;
  if (meshed < slabs_.size() || far_too_large) provide(vertices, triangles, meshed);
  next_.store(meshed);
  parallelFor(jobs_, std::min(workers_.size(), slabs_.size() - meshed), [&](size_t i) {
    for (size_t number; (number = next_.fetch_add(1)) < slabs_.size();) mesh(number, *workers_[i]);
  });

  mesh_.positions.cut(vertices * 3);
  mesh_.normals.cut(vertices * 3);
  mesh_.indices.cut(triangles * 3);
  for (size_t axis = 0; axis < 3 && vertices > 0; ++axis) {
    // Computed in the same way as positions of vertices. Rounding preserves the order, so the bounds are exact.
    mesh_.bounds_min[axis] = static_cast<float>(bounds_.lo[axis] * job_.step);
    mesh_.bounds_max[axis] = static_cast<float>(bounds_.hi[axis] * job_.step);
  }
  return std::move(mesh_);
}

}  // namespace

Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory,
                          const MeshKernels& kernels) {
  // Offsets within a plane and its neighbours must fit in 32 bits. If the strides are too large, the samples are copied
  // to a dense grid.
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
