#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include <sys/mman.h>

#include "fixture.h"
#include "rounds.h"

namespace {

struct Grid {
  std::array<uint32_t, 3> size;
  size_t stride_y, stride_z;
  std::vector<float> values;

  Grid(uint32_t x, uint32_t y, uint32_t z, size_t pad_y = 0, size_t pad_z = 0)
      : size{x, y, z}, stride_y(x + pad_y), stride_z(y * stride_y + pad_z), values(stride_z * z, 1e30f) {}
  float& at(size_t x, size_t y, size_t z) { return values[x + y * stride_y + z * stride_z]; }
  template <class F>
  void fill(F&& f) {
    for (size_t z = 0; z < size[2]; ++z)
      for (size_t y = 0; y < size[1]; ++y)
        for (size_t x = 0; x < size[0]; ++x)
          at(x, y, z) = f(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
  }
  sgm_grid_desc desc() const {
    sgm_grid_desc d = SGM_GRID_DESC_INIT;
    d.values = values.data();
    for (size_t i = 0; i < 3; ++i) d.size[i] = size[i];
    d.stride_y = stride_y;
    d.stride_z = stride_z;
    return d;
  }
};

SurfaceOwner mesh(sgm_runtime* runtime, const sgm_grid_desc& desc) {
  sgm_surface* surface = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_surface_from_grid(runtime, &desc, &surface, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return SurfaceOwner(surface);
}

float ball(double x, double y, double z, double centre, double radius) {
  return static_cast<float>(
      std::sqrt((x - centre) * (x - centre) + (y - centre) * (y - centre) + (z - centre) * (z - centre)) - radius);
}

/// Returns the number of directed edges without an opposite edge.
size_t openEdges(const sgm_surface_view& view) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (uint64_t i = 0; i < view.index_count; i += 3) {
    for (uint64_t k = 0; k < 3; ++k) {
      const uint32_t a = view.indices[i + k], b = view.indices[i + (k + 1) % 3];
      REQUIRE(a < view.vertex_count);
      REQUIRE(a != b);
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  size_t open = 0;
  for (const auto& [edge, balance] : edges) open += balance != 0 ? 1u : 0u;
  return open;
}

}  // namespace

TEST_CASE("a sphere in a grid: closed, of the right area and volume, with its normals") {
  RuntimeOwner runtime = makeRuntime();
  const double centre = 20.3, radius = 15.7;
  Grid grid(43, 70, 65, 3, 7);
  grid.fill([&](double x, double y, double z) { return ball(x, y, z, centre, radius); });
  const SurfaceOwner surface = mesh(runtime.get(), grid.desc());
  const sgm_surface_view view = viewOf(surface);
  REQUIRE(view.index_count > 1000);
  CHECK(openEdges(view) == 0);
  double area = 0, volume = 0;
  const auto corner = [&](uint64_t i) {
    const float* p = view.positions + size_t{3} * view.indices[i];
    return std::array<double, 3>{static_cast<double>(p[0]) - centre, static_cast<double>(p[1]) - centre,
                                 static_cast<double>(p[2]) - centre};
  };
  for (uint64_t i = 0; i < view.index_count; i += 3) {
    const auto a = corner(i), b = corner(i + 1), c = corner(i + 2);
    std::array<double, 3> n{};
    for (size_t k = 0; k < 3; ++k) {
      const size_t u = (k + 1) % 3, v = (k + 2) % 3;
      n[k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    }
    area += 0.5 * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    volume += (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / 6;
  }
  const double pi = std::acos(-1.0);
  CHECK(area == Approx(4 * pi * radius * radius).epsilon(0.005));
  CHECK(volume == Approx(4.0 / 3 * pi * radius * radius * radius).epsilon(0.005));
  double worst = 1;
  for (uint64_t v = 0; v < view.vertex_count; ++v) {
    const float *p = view.positions + 3 * v, *n = view.normals + 3 * v;
    double dot = 0, length = 0, normal = 0;
    for (size_t k = 0; k < 3; ++k) {
      dot += (static_cast<double>(p[k]) - centre) * static_cast<double>(n[k]);
      length += (static_cast<double>(p[k]) - centre) * (static_cast<double>(p[k]) - centre);
      normal += static_cast<double>(n[k]) * static_cast<double>(n[k]);
      CHECK((p[k] >= view.bounds_min[k] && p[k] <= view.bounds_max[k]));
    }
    CHECK(normal == Approx(1).epsilon(1e-6));
    CHECK(std::sqrt(length) == Approx(radius).margin(0.02));
    worst = std::min(worst, dot / std::sqrt(length));
  }
  CHECK(worst > 0.998);
}

TEST_CASE("random grids of odd sizes are closed inside, and equal for any number of threads") {
  const unsigned seed = 20251121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < sgm::rounds(12); ++round) {
    const auto side = [&] { return static_cast<uint32_t>(2 + random() % 70); };
    Grid grid(side(), side(), side());
    // Make the grid's border void, so that the surface is closed.
    grid.fill([&](double x, double y, double z) {
      const bool border =
          x == 0 || y == 0 || z == 0 || x + 1 == grid.size[0] || y + 1 == grid.size[1] || z + 1 == grid.size[2];
      const float value = static_cast<float>(random() % 2001) / 1000.0f - 1.0f;
      return border ? 1.0f : value;
    });
    uint64_t first = 0;
    for (const uint32_t threads : {1u, 3u, 8u}) {
      sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
      desc.threads = threads;
      RuntimeOwner runtime = makeRuntime(&desc);
      const SurfaceOwner surface = mesh(runtime.get(), grid.desc());
      if (threads == 1) {
        first = sgm_surface_hash(surface.get());
        CHECK(openEdges(viewOf(surface)) == 0);
      }
      CHECK(sgm_surface_hash(surface.get()) == first);
    }
  }
}

TEST_CASE("a grid of many slabs is meshed alike however many there are, and however much room was expected") {
  const unsigned seed = 20261126;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const char* const kinds[] = {"everywhere", "in a few places", "where it is looked for", "only at the end"};
  for (int kind = 0; kind < 4; ++kind) {
    INFO(kinds[kind]);
    const auto side = [&](unsigned least) { return static_cast<uint32_t>(least + random() % 100); };
    Grid grid(side(200), side(150), 40 + static_cast<uint32_t>(random() % 20));
    grid.fill([&](double x, double y, double z) {
      // Selects the same sample rows as the mesher, which estimates the size of the result from them
      // (api/grid_mesh.cpp).
      const double turn = z * 0.6180339887498949, row = std::floor((turn - std::floor(turn)) * (grid.size[1] - 2));
      const bool solid = kind == 0   ? std::sin(x * 0.31) + std::sin(y * 0.37) + std::sin(z * 0.41) < 0
                         : kind == 1 ? x > 90 && x < 96 && y > 70 && y < 75 && (z < 3 || z > 30)
                         : kind == 2 ? std::fabs(y - row) <= 1 && std::fmod(x, 4) < 2
                                     : z + 4 > grid.size[2];
      const bool border =
          x == 0 || y == 0 || z == 0 || x + 1 == grid.size[0] || y + 1 == grid.size[1] || z + 1 == grid.size[2];
      const auto value = static_cast<float>(1 + random() % 1000) / 1000.0f;
      return solid && !border ? -value : value;
    });
    uint64_t first = 0;
    for (const uint32_t threads : {1u, 2u, 5u}) {
      INFO(threads << " threads");
      sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
      desc.threads = threads;
      RuntimeOwner runtime = makeRuntime(&desc);
      const SurfaceOwner surface = mesh(runtime.get(), grid.desc());
      if (threads == 1) {
        first = sgm_surface_hash(surface.get());
        REQUIRE(viewOf(surface).index_count > 300);
        CHECK(openEdges(viewOf(surface)) == 0);
      }
      CHECK(sgm_surface_hash(surface.get()) == first);
    }
    // A NaN at any sample makes the call fail, with any number of threads.
    grid.at(random() % grid.size[0], random() % grid.size[1], random() % grid.size[2]) = std::nanf("");
    for (const uint32_t threads : {1u, 5u}) {
      sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
      desc.threads = threads;
      RuntimeOwner runtime = makeRuntime(&desc);
      const sgm_grid_desc wrong = grid.desc();
      sgm_surface* surface = nullptr;
      CHECK(sgm_surface_from_grid(runtime.get(), &wrong, &surface, nullptr) == SGM_ERR_INVALID_ARGUMENT);
      CHECK(surface == nullptr);
    }
  }
}

TEST_CASE("strides, cell and normals are what the descriptor says") {
  RuntimeOwner runtime = makeRuntime();
  Grid dense(20, 21, 22), padded(20, 21, 22, 5, 9);
  const auto f = [](double x, double y, double z) { return ball(x, y, z, 10, 7); };
  dense.fill(f);
  padded.fill(f);
  const SurfaceOwner a = mesh(runtime.get(), dense.desc()), b = mesh(runtime.get(), padded.desc());
  CHECK(sgm_surface_hash(a.get()) == sgm_surface_hash(b.get()));

  Grid scaled(20, 21, 22);
  scaled.fill([&](double x, double y, double z) { return 4 * f(x, y, z); });
  sgm_grid_desc desc = scaled.desc();
  desc.cell = 4;
  desc.stride_y = desc.stride_z = 0;
  desc.normals = 0;
  const SurfaceOwner c = mesh(runtime.get(), desc);
  const sgm_surface_view small = viewOf(a), large = viewOf(c);
  CHECK(large.normals == nullptr);
  CHECK(small.materials == nullptr);
  REQUIRE(large.vertex_count == small.vertex_count);
  for (uint64_t i = 0; i < 3 * small.vertex_count; ++i) REQUIRE(large.positions[i] == 4 * small.positions[i]);
}

TEST_CASE("uniform and extreme grids") {
  RuntimeOwner runtime = makeRuntime();
  for (const float value : {-1.0f, 1.0f, 0.0f, -0.0f}) {
    Grid grid(2, 2, 2);
    grid.fill([&](double, double, double) { return value; });
    const sgm_surface_view view = viewOf(mesh(runtime.get(), grid.desc()));
    CHECK(view.index_count == 0);
    CHECK(view.vertex_count == 0);
    CHECK(view.bounds_max[0] == 0.0f);
  }
  Grid steep(3, 3, 3);
  steep.fill([](double x, double y, double z) {
    return x == 1 && y == 1 && z == 1 ? -std::numeric_limits<float>::max() : std::numeric_limits<float>::max();
  });
  const SurfaceOwner surface = mesh(runtime.get(), steep.desc());
  const sgm_surface_view view = viewOf(surface);
  CHECK(view.vertex_count == 6);
  CHECK(view.index_count == 24);
  for (uint64_t i = 0; i < 18; ++i) CHECK(std::isfinite(view.normals[i]));
}

TEST_CASE("wrong grids are refused") {
  RuntimeOwner runtime = makeRuntime();
  Grid grid(4, 4, 4);
  grid.fill([](double, double, double) { return 1.0f; });
  const auto refused = [&](sgm_grid_desc desc) {
    sgm_surface* surface = nullptr;
    sgm_error error = SGM_ERROR_INIT;
    const sgm_result result = sgm_surface_from_grid(runtime.get(), &desc, &surface, &error);
    CHECK(surface == nullptr);
    CHECK(std::strlen(error.message) > 0);
    return result;
  };
  const auto with = [&](auto change) {
    sgm_grid_desc desc = grid.desc();
    change(desc);
    return refused(desc);
  };
  CHECK(with([](auto& d) { d.values = nullptr; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.size[1] = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.size[2] = 16385; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.stride_y = 3; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.stride_z = 15; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.stride_y = SIZE_MAX; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.stride_z = SIZE_MAX / 2; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) {
          d.size[0] = d.size[1] = d.size[2] = 16384;
          d.stride_y = d.stride_z = 0;
        }) == SGM_ERR_LIMIT);
  for (const double cell : {0.0, -1.0, std::nan(""), HUGE_VAL})
    CHECK(with([&](auto& d) { d.cell = cell; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.normals = 2; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.reserved = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  for (const float value : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    grid.at(3, 3, 3) = value;
    CHECK(with([](auto&) {}) == SGM_ERR_INVALID_ARGUMENT);
  }
}

TEST_CASE("rows that lie gigabytes apart give the mesh of dense ones") {
  RuntimeOwner runtime = makeRuntime();
  constexpr size_t kStride = 750'000'000;
  const size_t bytes = kStride * 3 * 2 * sizeof(float);
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) {
    WARN("not tested: there is no address space for it");
    return;
  }
  Grid dense(20, 3, 2);
  dense.fill([](double x, double y, double z) { return ball(x, y, z, 2.0, 1.7); });
  auto* values = static_cast<float*>(memory);
  for (size_t z = 0; z < 2; ++z)
    for (size_t y = 0; y < 3; ++y) std::memcpy(values + (z * 3 + y) * kStride, &dense.at(0, y, z), 20 * sizeof(float));
  sgm_grid_desc apart = dense.desc();
  apart.values = values;
  apart.stride_y = kStride;
  apart.stride_z = 3 * kStride;
  const SurfaceOwner a = mesh(runtime.get(), dense.desc()), b = mesh(runtime.get(), apart);
  const sgm_surface_view one = viewOf(a), other = viewOf(b);
  REQUIRE(one.index_count > 0);
  REQUIRE(one.index_count == other.index_count);
  CHECK(std::memcmp(one.indices, other.indices, one.index_count * sizeof(uint32_t)) == 0);
  CHECK(std::memcmp(one.positions, other.positions, one.vertex_count * 3 * sizeof(float)) == 0);
  munmap(memory, bytes);
}
