// Tests the passes over grids: for every instruction set, the results must equal those of the scalar code bit by bit.

#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "backend/cpu/extract/mesh_kernels.h"
#include "catch.h"
#include "mesh/body.h"
#include "mesh/tables.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

/// The kernels of the instruction sets that this processor has; prints the names of those that it lacks.
std::vector<std::pair<const char*, const MeshKernels*>> kernelSets() {
  std::vector<std::pair<const char*, const MeshKernels*>> sets;
  for (const char* name : {"scalar", "sse4.2", "avx2", "avx512", "avx512-vbmi2"}) {
    if (const MeshKernels* kernels = findMeshKernels(name))
      sets.emplace_back(name, kernels);
    else
      WARN("SKIPPED: this build or this processor has no " << name);
  }
  return sets;
}

/// Rows of 1,024 floats, each followed by memory that must not be accessed.
class GuardedRows {
 public:
  static constexpr size_t kRow = 1024, kStride = 2 * kRow;
  explicit GuardedRows(size_t rows) : bytes_(rows * kStride * sizeof(float)) {
    void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    values_ = static_cast<float*>(memory);
    for (size_t row = 0; row < rows; ++row)
      REQUIRE(mprotect(values_ + row * kStride + kRow, (kStride - kRow) * sizeof(float), PROT_NONE) == 0);
  }
  GuardedRows(const GuardedRows&) = delete;
  GuardedRows& operator=(const GuardedRows&) = delete;
  ~GuardedRows() { munmap(values_, bytes_); }
  float* row(size_t number) { return values_ + number * kStride; }

 private:
  size_t bytes_;
  float* values_ = nullptr;
};

struct Meshed {
  std::vector<uint64_t> signs, uniform;
  std::vector<float> positions, normals;
  std::vector<uint32_t> indices;
  bool finite = true;
  bool operator==(const Meshed& other) const {
    const auto same = [](const auto& a, const auto& b) {
      return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
    };
    return finite == other.finite && signs == other.signs && uniform == other.uniform &&
           same(positions, other.positions) && same(normals, other.normals) && indices == other.indices;
  }
};

Meshed meshed(const MeshKernels& kernels, GridJob job, size_t slabs, bool normals) {
  Meshed result;
  job.lattice.words = (job.lattice.size[0] + 63) / 64;
  result.signs.resize(job.lattice.words * job.lattice.size[1] * job.lattice.size[2]);
  result.uniform.resize(2 * job.lattice.size[1] * job.lattice.size[2]);
  job.lattice.signs = result.signs.data();
  job.lattice.uniform = result.uniform.data();
  const size_t planes = job.lattice.size[2];
  for (size_t z = 0; z < planes; ++z)
    for (size_t y = 0; y < job.lattice.size[1]; ++y) {
      uint64_t* row = result.signs.data() + (z * job.lattice.size[1] + y) * job.lattice.words;
      result.finite =
          kernels.signs(job, y, z, row, &result.uniform[(z * job.lattice.size[1] + y) * 2]) && result.finite;
    }
  if (!result.finite) return result;
  const size_t size_x = job.lattice.size[0], size_y = job.lattice.size[1];
  std::vector<uint64_t> vertices(planes + 1), cells(planes + 1), triangles(planes + 1), listed_cells;
  std::vector<uint32_t> listed_edges;
  for (size_t z = 0; z < planes; ++z) {
    std::vector<uint32_t> edges(edgeRoom(size_x, size_y));
    std::vector<uint64_t> active(cellRoom(size_x, size_y));
    const size_t half = size_y / 2;
    const ListCounts low = kernels.list(job.lattice, z, 0, half, edges.data(), active.data());
    const ListCounts high =
        kernels.list(job.lattice, z, half, size_y, edges.data() + low.vertices, active.data() + low.cells);
    vertices[z + 1] = vertices[z] + low.vertices + high.vertices;
    cells[z + 1] = cells[z] + low.cells + high.cells;
    triangles[z + 1] = triangles[z] + low.triangles + high.triangles;
    edges.resize(low.vertices + high.vertices);
    active.resize(low.cells + high.cells);
    listed_edges.insert(listed_edges.end(), edges.begin(), edges.end());
    listed_cells.insert(listed_cells.end(), active.begin(), active.end());
  }
  result.positions.resize(vertices.back() * 3);
  if (normals) result.normals.resize(vertices.back() * 3);
  result.indices.resize(triangles.back() * 3);
  job.positions = result.positions.data();
  job.normals = normals ? result.normals.data() : nullptr;
  job.indices = result.indices.data();
  std::vector<uint32_t> numbers(2 * size_x * size_y), offsets(vertices.back() + kMaxLanes);
  const size_t thick = (planes + slabs - 1) / slabs;
  for (size_t first = 0; first < planes; first += thick) {
    const size_t last = std::min(planes, first + thick), below = first > 0 ? first - 1 : 0;
    GridSlab slab{first,
                  last,
                  vertices.data(),
                  cells.data(),
                  triangles[below],
                  listed_edges.data() + vertices[first],
                  listed_cells.data() + cells[first],
                  nullptr,
                  nullptr};
    if (first > 0) {
      slab.edges_below = listed_edges.data() + vertices[below];
      slab.cells_below = listed_cells.data() + cells[below];
    }
    kernels.mesh(job, slab, {numbers.data(), offsets.data()});
  }
  return result;
}

/// Returns smooth values, noise of many magnitudes, or smooth values with weak noise. Some values of the noise are far
/// beyond the range of quantised values; some are nearly 0.
std::vector<float> someValues(std::mt19937& random, size_t count) {
  std::vector<float> values(count);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const int kind = static_cast<int>(random() % 3);
  for (size_t i = 0; i < count; ++i) {
    const float smooth = std::sin(static_cast<float>(i % 97) * 0.1f) + std::sin(static_cast<float>(i) * 0.003f);
    const float noise = unit(random) * std::exp2(static_cast<float>(random() % 60) - 40.0f);
    values[i] = kind == 0 ? smooth : kind == 1 ? noise : smooth + 0.2f * unit(random);
  }
  return values;
}

/// Converts the samples of a grid to samples of a chunk, for the polygonizer that meshes chunks.
ChunkSamples chunkOf(const GridJob& job) {
  ChunkSamples samples;
  for (size_t z = 0; z < kChunkSamples; ++z) {
    for (size_t y = 0; y < kChunkSamples; ++y) {
      const size_t row = y + z * kChunkSamples;
      for (size_t x = 0; x < kChunkSamples; ++x) {
        const float scaled = std::clamp(job.row(y, z)[x] * job.scale, -float{kMaxQ}, float{kMaxQ});
        const auto q = static_cast<int32_t>(std::floor(scaled + 0.5f));
        samples.q[row * kChunkSamples + x] = q;
        samples.signs[row] |= uint64_t{q < 0} << x;
      }
    }
  }
  return samples;
}

}  // namespace

TEST_CASE("a grid of a chunk's size is meshed as a chunk is") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto sets = kernelSets();
  for (unsigned round = 0; round < rounds(12); ++round) {
    CAPTURE(round);
    GridJob job;
    job.lattice.size = {kChunkSamples, kChunkSamples, kChunkSamples};
    job.stride_y = kChunkSamples;
    job.stride_z = size_t{kChunkSamples} * kChunkSamples;
    const std::vector<float> values = someValues(random, job.stride_z * kChunkSamples);
    job.values = values.data();
    job.scale = 1024;
    job.step = 1.0 / kSubcell;
    MeshPart part{std::pmr::get_default_resource()};
    polygonizeBody(chunkOf(job), ChunkGrid{}, part);
    for (const auto& [name, kernels] : sets) {
      CAPTURE(name);
      const Meshed mesh = meshed(*kernels, job, 1 + random() % 5, false);
      CHECK(mesh.indices == std::vector<uint32_t>(part.indices.begin(), part.indices.end()));
      REQUIRE(mesh.positions.size() == part.vertices.size() * 3);
      bool same = true;
      for (size_t i = 0; i < part.vertices.size(); ++i) {
        const Vertex& v = part.vertices[i];
        const float* at = &mesh.positions[3 * i];
        same = same && at[0] * kSubcell == v.x && at[1] * kSubcell == v.y && at[2] * kSubcell == v.z;
      }
      CHECK(same);
    }
  }
}

TEST_CASE("no chord of a cube's loop of up to five edges is forbidden") {
  // kForbids in cells.inl skips the check for forbidden diagonals in loops of up to five edges. This test shows that
  // these loops have no forbidden diagonals.
  size_t short_loops = 0, forbidden = 0;
  for (size_t at = 0; at < kCubeLoopBytes; at += size_t{kCubeLoops[at]} + 1) {
    const size_t n = kCubeLoops[at];
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = i + 2; j < n - (i == 0 ? 1 : 0); ++j) {
        const uint32_t from = kCubeLoops[at + 1 + i], to = kCubeLoops[at + 1 + j];
        const bool is_forbidden = (chordMask(kCubeEdgeFaces[from], from, static_cast<int>(n)) &
                                   chordMask(kCubeEdgeFaces[to], to, static_cast<int>(n))) != 0;
        if (n <= 5) CHECK_FALSE(is_forbidden);
        forbidden += is_forbidden;
      }
    }
    short_loops += n == 4 || n == 5;
  }
  CHECK(short_loops > 100);
  CHECK(forbidden > 0);
}

TEST_CASE("every instruction set meshes a grid as the scalar one does") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto sets = kernelSets();
  for (unsigned round = 0; round < rounds(40); ++round) {
    CAPTURE(round);
    GridJob job;
    for (size_t& size : job.lattice.size) size = 2 + random() % 20;
    job.lattice.size[0] = 2 + random() % (round % 2 == 0 ? 20 : 200);
    job.stride_y = job.lattice.size[0] + random() % 4;
    job.stride_z = job.stride_y * job.lattice.size[1] + random() % 9;
    std::vector<float> values = someValues(random, job.stride_z * job.lattice.size[2]);
    if (round % 10 == 9) values[random() % job.lattice.size[0]] = round % 20 == 9 ? INFINITY : NAN;
    job.values = values.data();
    job.scale = round % 3 == 0 ? 1024.0f : 900.0f;
    job.step = round % 3 == 0 ? 1.0 / 256 : 0.37 / 256;
    const bool normals = round % 4 != 0;
    const Meshed expected = meshed(scalarMeshKernels(), job, 1, normals);
    CHECK(expected.finite == (round % 10 != 9));
    for (const auto& [name, kernels] : sets) {
      CAPTURE(name);
      CHECK(meshed(*kernels, job, 1 + random() % 5, normals) == expected);
    }
  }
}

TEST_CASE("nothing is read behind the rows of a grid") {
  constexpr size_t kSide = 4;
  GuardedRows rows(kSide * kSide);
  // The signs alternate along x, so that all edges along x are crossed, including the last one.
  for (size_t row = 0; row < kSide * kSide; ++row)
    for (size_t x = 0; x < GuardedRows::kRow; ++x)
      rows.row(row)[x] = (x % 2 == 0 ? 1.0f : -1.0f) + 0.1f * static_cast<float>(row);
  GridJob job;
  job.values = rows.row(0);
  job.lattice.size = {GuardedRows::kRow, kSide, kSide};
  job.stride_y = GuardedRows::kStride;
  job.stride_z = GuardedRows::kStride * kSide;
  job.scale = 1024;
  job.step = 1.0 / kSubcell;
  const Meshed expected = meshed(scalarMeshKernels(), job, 1, true);
  CHECK(expected.positions.size() > 3 * kSide * kSide * (GuardedRows::kRow - 1) / 2);
  for (const auto& [name, kernels] : kernelSets()) {
    CAPTURE(name);
    CHECK(meshed(*kernels, job, 1, true) == expected);
  }
}
