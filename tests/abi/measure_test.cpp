// Tests measuring meshes through the C interface: a mesh that the library has made, and damaged meshes.

#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <vector>

#include "fixture.h"

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A ball with a given radius in a grid of n^3 samples, meshed by the library.
struct Ball {
  std::vector<float> values;
  SurfaceOwner surface;
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;

  Ball(sgm_runtime* runtime, uint32_t n, double radius) : surface(nullptr) {
    for (uint32_t i = 0; i < n * n * n; ++i) {
      const double middle = 0.5 * (n - 1), x = i % n - middle, y = i / n % n - middle, z = i / n / n - middle;
      values.push_back(static_cast<float>(std::sqrt(x * x + y * y + z * z) - radius));
    }
    sgm_grid_desc grid = SGM_GRID_DESC_INIT;
    grid.values = values.data();
    for (uint32_t& size : grid.size) size = n;
    sgm_surface* made = nullptr;
    REQUIRE(sgm_surface_from_grid(runtime, &grid, &made, nullptr) == SGM_OK);
    surface.reset(made);
    REQUIRE(sgm_surface_get_view(made, &view, nullptr) == SGM_OK);
  }

  sgm_measure_desc desc() const {
    sgm_measure_desc d = SGM_MEASURE_DESC_INIT;
    d.positions = view.positions;
    d.position_stride = view.position_stride;
    d.position_count = view.vertex_count;
    d.indices = view.indices;
    d.index_count = view.index_count;
    return d;
  }
};

sgm_measures measured(sgm_runtime* runtime, const sgm_measure_desc& desc) {
  sgm_measures measures = SGM_MEASURES_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_measure(runtime, &desc, &measures, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return measures;
}

/// An allocator that counts the bytes in use.
struct Counting {
  std::atomic<int64_t> live{0}, most{0};

  static void* allocate(void* user, size_t size, size_t alignment) {
    auto& c = *static_cast<Counting*>(user);
    const int64_t now = c.live.fetch_add(static_cast<int64_t>(size)) + static_cast<int64_t>(size);
    int64_t most = c.most;
    while (now > most && !c.most.compare_exchange_weak(most, now)) {
    }
    return ::operator new (size, std::align_val_t{alignment}, std::nothrow);
  }
  static void release(void* user, void* memory, size_t size, size_t alignment) {
    static_cast<Counting*>(user)->live.fetch_sub(static_cast<int64_t>(size));
    ::operator delete (memory, std::align_val_t{alignment});
  }
};

}  // namespace

TEST_CASE("a surface of ours is measured", "[measure]") {
  const RuntimeOwner runtime = makeRuntime();
  const Ball ball(runtime.get(), 64, 25.3);
  sgm_measure_desc desc = ball.desc();
  desc.cubes = 1;
  std::vector<double> shares(33, -1.0);
  desc.histogram = shares.data();
  desc.histogram_capacity = 33;
  const sgm_measures m = measured(runtime.get(), desc);
  CHECK(m.valid == 1);
  CHECK(m.watertight == 1);
  CHECK(m.triangles == ball.view.index_count / 3);
  CHECK(m.points == ball.view.vertex_count);
  CHECK(m.area == Approx(4 * kPi * 25.3 * 25.3).epsilon(0.002));
  CHECK(m.volume == Approx(4 * kPi / 3 * 25.3 * 25.3 * 25.3).epsilon(0.002));
  CHECK(m.cubes_all < m.volume);
  CHECK(m.cubes_any > m.volume);
  CHECK(m.cubes_centre == Approx(m.volume).epsilon(0.005));
  CHECK(m.objects == 1);
  CHECK(m.shells == 1);
  CHECK(m.euler == 2);
  CHECK(m.genus == 0);
  CHECK(m.self_intersections == 0);
  CHECK(m.self_intersections_complete == 1);
  CHECK(m.histogram_first == 1);
  CHECK(m.histogram_bins == 33);
  CHECK(m.histogram_edges == ball.view.index_count);
  CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == Approx(1));
  CHECK(m.convex > 0.9);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::fabs(m.area_vector[axis]) < 1e-6 * m.area);
    CHECK(m.bounds_max[axis] - m.bounds_min[axis] == Approx(50.6).epsilon(0.01));
  }
}

TEST_CASE("what is wrong with a mesh is told, and is no error", "[measure]") {
  const RuntimeOwner runtime = makeRuntime();
  const Ball ball(runtime.get(), 16, 5.2);
  std::vector<uint32_t> indices(ball.view.indices, ball.view.indices + ball.view.index_count);
  std::vector<double> positions;
  for (uint64_t i = 0; i < 3 * ball.view.vertex_count; ++i)
    positions.push_back(static_cast<double>(ball.view.positions[i]));
  sgm_measure_desc desc = SGM_MEASURE_DESC_INIT;
  const auto measure = [&] {
    desc.positions_double = positions.data();
    desc.position_count = positions.size() / 3;
    desc.indices = indices.data();
    desc.index_count = indices.size();
    return measured(runtime.get(), desc);
  };
  SECTION("nothing") { CHECK(measure().valid == 1); }
  SECTION("a hole") {
    indices.resize(indices.size() - 3);
    CHECK(measure().open_edges == 3);
    CHECK(measure().valid == 0);
  }
  SECTION("a triangle turned over") {
    std::swap(indices[0], indices[1]);
    CHECK(measure().turned_edges == 3);
  }
  SECTION("inside out") {
    for (size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
    CHECK(measure().inside_out_shells == 1);
    CHECK(measure().watertight == 1);
    CHECK(measure().valid == 0);
    CHECK(measure().volume < 0);
  }
  SECTION("a place that is no number") {
    positions[3 * indices[0]] = std::numeric_limits<double>::quiet_NaN();
    CHECK(measure().non_finite_triangles > 0);
    CHECK(measure().watertight == 0);
  }
  SECTION("twice the same") {
    indices.insert(indices.end(), indices.begin(), indices.begin() + 3);
    CHECK(measure().duplicate_triangles == 1);
    CHECK(measure().nonmanifold_edges == 3);
    CHECK(measure().genus == -1);
  }
  SECTION("a spike through the other side") {
    for (size_t axis = 0; axis < 3; ++axis) positions[3 * indices[0] + axis] = 15.3 - positions[3 * indices[0] + axis];
    CHECK(measure().self_intersections > 0);
    desc.flags = SGM_MEASURE_NO_SELF_INTERSECTIONS;
    CHECK(measure().self_intersections == 0);
    CHECK(measure().self_intersections_complete == 0);
  }
  SECTION("no triangles") {
    indices.clear();
    CHECK(measure().area == 0);
    CHECK(measure().valid == 1);
  }
}

TEST_CASE("what is measured keeps to the runtime's memory", "[measure]") {
  Counting counting;
  const sgm_allocator allocator{Counting::allocate, Counting::release, &counting};
  const RuntimeOwner plain = makeRuntime();
  const Ball ball(plain.get(), 96, 40.3);
  const auto runtimeWith = [&](uint64_t limit) {
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.allocator = &allocator;
    desc.threads = 2;
    desc.memory_limit = limit;
    sgm_runtime* made = nullptr;
    REQUIRE(sgm_runtime_create(&desc, &made, nullptr) == SGM_OK);
    return RuntimeOwner(made);
  };
  const sgm_measure_desc desc = ball.desc();
  const auto triangles = static_cast<int64_t>(desc.index_count / 3);
  {
    const RuntimeOwner runtime = runtimeWith(0);
    const int64_t before = counting.live;
    CHECK(measured(runtime.get(), desc).valid == 1);
    CHECK(counting.live == before);
    INFO(counting.most << " bytes for " << triangles << " triangles");
    CHECK(counting.most - before > 100 * triangles);
    CHECK(counting.most - before < 300 * triangles);
  }
  const RuntimeOwner runtime = runtimeWith(static_cast<uint64_t>(50 * triangles));
  const int64_t before = counting.live;
  sgm_measures measures = SGM_MEASURES_INIT;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_measure(runtime.get(), &desc, &measures, &error) == SGM_ERR_OUT_OF_MEMORY);
  CHECK(counting.live == before);
}
