// Measures reading mesh files: time on one core, and memory beyond the file's own bytes. In the first run, the
// allocator gets new memory from the system, which on a virtual machine may take longer than reading the file: the
// column "of memory" is the time to touch that much new memory. Later runs reuse the allocator's memory.
//
//   sgm_bench_mesh_files [TRIANGLES [RUNS]]

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>

#include "asset/read/mesh_file.h"
#include "measure.h"
#include "mesh/export/export.h"

namespace {

size_t live_bytes = 0, peak_bytes = 0;

void* counted(size_t size) {
  void* const memory = std::malloc(std::max<size_t>(size, 1));
  if (memory == nullptr) throw std::bad_alloc();
  live_bytes += malloc_usable_size(memory);
  peak_bytes = std::max(peak_bytes, live_bytes);
  return memory;
}

void uncounted(void* memory) {
  if (memory != nullptr) live_bytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { uncounted(memory); }
void operator delete(void* memory, size_t) noexcept { uncounted(memory); }

namespace {

using namespace sgm;

/// Makes a bumpy torus of `side` by `side` quadrangles, with normals and four materials.
WorldMesh bumpyTorus(uint32_t side) {
  WorldMesh mesh;
  for (uint32_t i = 0; i < side * side; ++i) {
    const double a = 6.283185307179586 * (i % side) / side, b = 6.283185307179586 * (i / side) / side;
    const double thick = 3 + 0.2 * std::sin(40 * a) * std::sin(30 * b), wide = 10 + thick * std::cos(a);
    const auto rounded = [](double v) { return static_cast<double>(static_cast<float>(v)); };
    mesh.positions.push_back({rounded(wide * std::cos(b)), rounded(thick * std::sin(a)), rounded(wide * std::sin(b))});
    const auto part = [](double v) { return static_cast<int16_t>(std::lround(v * 16000)); };
    mesh.attributes.push_back({part(std::cos(a)), part(std::sin(b)), static_cast<uint16_t>(i * 4 / (side * side)), 0});
    const uint32_t right = i % side + 1 == side ? i + 1 - side : i + 1, below = (i + side) % (side * side);
    const uint32_t both = (right + side) % (side * side);
    mesh.indices.insert(mesh.indices.end(), {i, below, right, right, below, both});
  }
  return mesh;
}

/// Returns the same mesh with separate points for each triangle, as for flat shading.
WorldMesh withoutSharedPoints(const WorldMesh& mesh) {
  WorldMesh out;
  for (const uint32_t corner : mesh.indices) {
    out.indices.push_back(static_cast<uint32_t>(out.positions.size()));
    out.positions.push_back(mesh.positions[corner]);
    out.attributes.push_back(mesh.attributes[corner]);
  }
  return out;
}

/// Returns the milliseconds that the system needs to provide this much new memory (page faults).
double touched(size_t bytes) {
  malloc_trim(0);
  const double start = bench::now();
  auto* const memory = static_cast<volatile char*>(std::malloc(bytes));
  for (size_t i = 0; i < bytes; i += 4096) memory[i] = 1;
  const double end = bench::now();
  std::free(const_cast<char*>(memory));
  malloc_trim(0);
  return end - start;
}

int fail(const std::string& message) {
  std::fprintf(stderr, "sgm_bench_mesh_files: %s\n", message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const double triangles = argc > 1 ? std::max(8.0, std::atof(argv[1])) : 1e6;
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 9;
  bench::pin(1);
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const auto side = static_cast<uint32_t>(std::lround(std::sqrt(triangles / 2)));
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sgm_bench_mesh_files_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  int status = 0;
  std::printf("%-9s %10s %7s %10s %10s %26s %6s %10s\n", "file", "triangles", "MB", "first, ms", "of memory",
              "later, ms (least to most)", "MB/s", "MB beyond");
  for (const char* const name : {"mesh.glb", "flat.glb", "mesh.obj", "mesh.ply", "mesh.stl"}) {
    const std::string path = (folder / name).string();
    const WorldMesh torus = bumpyTorus(side);
    const bool flat = name[0] == 'f';
    if (Result<void> done = exportMesh(flat ? withoutSharedPoints(torus) : torus, {}, path); !done) {
      status = fail(done.error().message);
      break;
    }
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    constexpr asset::MeshLimits limits{.points = size_t{1} << 28, .triangles = size_t{1} << 28};
    size_t read = 0;
    peak_bytes = live_bytes;
    const size_t before = live_bytes;
    const auto once = [&] {
      const auto mesh = asset::readMesh(std::as_bytes(std::span(bytes)), *asset::meshFileKind(path), limits);
      read = mesh ? mesh->triangles.size() : 0;
    };
    malloc_trim(0);
    const bench::Times first = bench::timed(0, 1, once), later = bench::timed(1, runs, once);
    if (read != size_t{2} * side * side) status = fail(path + " read wrongly");
    const double megabytes = static_cast<double>(bytes.size()) / 1e6;
    const size_t beyond = peak_bytes - before;
    std::printf("%-9s %10zu %7.1f %10.1f %10.1f %9.1f (%.1f to %.1f) %9.0f %10.1f\n", name, read, megabytes,
                first.median, touched(beyond), later.median, later.least, later.most, megabytes / later.median * 1e3,
                static_cast<double>(beyond) / 1e6);
  }
  std::filesystem::remove_all(folder);
  return status;
}
