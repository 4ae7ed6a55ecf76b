// Tests density volumes: against the formula, samples and meshes, and that dividing a box does not change them.

#include <cmath>
#include <cstring>
#include <random>

#include "backend/cpu/instruction_sets.h"
#include "field/density.h"
#include "mesh/export/export.h"
#include "mesh/vertex.h"
#include "query/density_grid.h"
#include "rounds.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

struct Volume {
  std::vector<uint8_t> bytes;
  std::vector<float> values;
  DensityFigures figures;
};

size_t pointsOf(const DensityGrid& grid) { return size_t{grid.size[0]} * grid.size[1] * grid.size[2]; }

Volume volumeOf(const QueryField& field, const DensityGrid& grid, unsigned threads = 2) {
  const auto jobs = *makeThreadPool(threads);
  Volume volume;
  volume.bytes.assign(pointsOf(grid), 77);
  volume.values.assign(pointsOf(grid), -1.0f);
  DensityRows rows;
  rows.row_pitch = grid.size[0];
  rows.slice_pitch = size_t{grid.size[0]} * grid.size[1];
  rows.values = volume.values.data();
  const auto exact = sampleDensity(field, grid, *jobs, rows);
  INFO((exact ? "" : exact.error().message));
  REQUIRE(exact);
  rows.bytes = volume.bytes.data();
  REQUIRE(sampleDensity(field, grid, *jobs, rows));
  volume.figures = *exact;
  return volume;
}

Int3 pointAt(const DensityGrid& grid, size_t i) {
  const size_t nx = grid.size[0], ny = grid.size[1];
  const size_t at[3] = {i % nx, i / nx % ny, i / nx / ny};
  Int3 p = grid.origin;
  for (int axis = 0; axis < 3; ++axis) p[axis] += grid.spacing * static_cast<int32_t>(at[axis]);
  return p;
}

/// Samples all points by one program, without pruning.
std::vector<int32_t> samplesOf(const WorldField& world, const DensityGrid& grid, int level = 0) {
  const size_t count = pointsOf(grid);
  std::vector<int32_t> x(count), y(count), z(count), q(count);
  for (size_t i = 0; i < count; ++i) {
    const Int3 p = pointAt(grid, i);
    x[i] = p.x, y[i] = p.y, z[i] = p.z;
  }
  const auto program = world.compile({grid.origin, pointAt(grid, count - 1)}, level);
  REQUIRE(program);
  EvalScratch scratch;
  scalarKernels().samples((*program)->view(), {x.data(), y.data(), z.data(), count}, scratch, q.data());
  return q;
}

/// The formula of the density in double precision, written as two parabolas.
double expectedDensity(int32_t q, double edge, int32_t finest_cell) {
  const double t = std::min(std::max(-q * (finest_cell / 1024.0) / edge, 0.0), 1.0);
  return t < 0.5 ? 2 * t * t : 1 - 2 * (1 - t) * (1 - t);
}

/// A world with clouds all over the sky.
WorldFieldSettings clouds(uint64_t seed) {
  WorldFieldSettings settings = settingsOf(sample("cloud.sgm"), 4096, seed);
  REQUIRE(settings.parameters.set(*settings.program, "cover", 1.0));
  return settings;
}

/// A random grid within the clouds. The grid's coordinates are not round numbers.
DensityGrid gridIn(std::mt19937& random, uint32_t most = 70) {
  DensityGrid grid;
  grid.spacing = static_cast<int32_t>(3000 + random() % 20000);
  grid.edge = static_cast<double>(1 + random() % (64 * 1024));
  for (size_t axis = 0; axis < 3; ++axis) grid.size[axis] = 1 + static_cast<uint32_t>(random() % most);
  grid.origin = {static_cast<int32_t>(random() % 2'000'000), static_cast<int32_t>(1'150'000 + random() % 300'000),
                 static_cast<int32_t>(random() % 2'000'000) - 1'000'000};
  return grid;
}

}  // namespace

TEST_CASE("density is 0 outside of the solid, rises to 1 over the edge, and never falls", "[density]") {
  const unsigned seed = 11;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(60); ++round) {
    const int32_t cell = 1 << random() % 21;
    const double edge = round == 0 ? 4096.0 * cell : 1 + static_cast<double>(random()) / 4294967296.0 * 4095 * cell;
    const DensityEdge rule = densityEdge(edge, cell);
    CAPTURE(cell, edge);
    std::vector<int32_t> q;
    for (int32_t i = 1000; i >= -5000; --i) q.push_back(i);
    for (int32_t i = 0; i < 3000; ++i) q.push_back(-5000 - static_cast<int32_t>(int64_t{4189304} * i / 2999));
    REQUIRE(q.back() == -(1 << 22));
    std::vector<float> values(q.size());
    std::vector<uint8_t> bytes(q.size());
    densities(q, rule, values.data());
    densities(q, rule, bytes.data());
    size_t wrong = 0;
    for (size_t i = 0; i < q.size(); ++i) {
      wrong += (values[i] > 0) != (q[i] < 0) || values[i] < 0 || values[i] > 1;
      wrong += i > 0 && (values[i] < values[i - 1] || bytes[i] < bytes[i - 1]);
      wrong += std::fabs(double{values[i]} - expectedDensity(q[i], edge, cell)) > 1e-6;
      wrong += std::fabs(bytes[i] - double{values[i]} * 255) > 0.5001;
      wrong += -q[i] >= rule.steps && values[i] < 1;
    }
    CHECK(wrong == 0);
    CHECK(values.back() == 1.0f);
  }
}

TEST_CASE("a volume holds the density of each point's own sample, whatever was proven about its brick", "[density]") {
  const unsigned seed = 5;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const WorldField world(clouds(seed), std::pmr::get_default_resource());
  uint64_t uniform = 0, bricks = 0;
  size_t in_edge = 0, full = 0;
  for (unsigned round = 0; round < std::max(3u, rounds(8)); ++round) {
    const DensityGrid grid = gridIn(random, 45);
    const Volume volume = volumeOf(queryField(world), grid);
    const std::vector<int32_t> q = samplesOf(world, grid);
    const DensityEdge rule = densityEdge(grid.edge, 4096);
    std::vector<float> values(q.size());
    std::vector<uint8_t> bytes(q.size());
    densities(q, rule, values.data());
    densities(q, rule, bytes.data());
    CHECK(std::memcmp(values.data(), volume.values.data(), values.size() * sizeof(float)) == 0);
    CHECK(bytes == volume.bytes);
    uniform += volume.figures.uniform;
    bricks += volume.figures.bricks;
    for (const float v : values) in_edge += v > 0 && v < 1, full += v == 1;
  }
  CHECK(uniform > 0);
  CHECK(uniform < bricks);
  CHECK(in_edge > 0);
  CHECK(full > 0);
}

TEST_CASE("a volume is the same for any number of threads, and cut into any boxes", "[density][threads]") {
  const unsigned seed = 11;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const WorldField world(clouds(seed), std::pmr::get_default_resource());
  const QueryField field = queryField(world);
  for (unsigned round = 0; round < rounds(3); ++round) {
    const DensityGrid grid = gridIn(random);
    const Volume whole = volumeOf(field, grid, 1);
    for (const unsigned threads : {2u, 5u}) CHECK(volumeOf(field, grid, threads).values == whole.values);
    // Computes the grid in two parts along each axis. Each part is written to its place in one array, with the pitches
    // of the whole array.
    std::array<uint32_t, 3> at{};
    for (size_t axis = 0; axis < 3; ++axis) at[axis] = static_cast<uint32_t>(random() % grid.size[axis]);
    std::vector<float> joined(pointsOf(grid), -1.0f);
    const auto jobs = *makeThreadPool(2);
    for (unsigned part = 0; part < 8; ++part) {
      DensityGrid piece = grid;
      size_t first[3] = {};
      bool none = false;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        const bool high = part >> axis & 1;
        first[a] = high ? at[a] : 0;
        piece.size[a] = high ? grid.size[a] - at[a] : at[a];
        piece.origin[axis] += static_cast<int32_t>(first[a]) * grid.spacing;
        none |= piece.size[a] == 0;
      }
      if (none) continue;
      DensityRows rows;
      rows.row_pitch = grid.size[0];
      rows.slice_pitch = size_t{grid.size[0]} * grid.size[1];
      rows.values = joined.data() + first[2] * rows.slice_pitch + first[1] * rows.row_pitch + first[0];
      REQUIRE(sampleDensity(field, piece, *jobs, rows));
    }
    CHECK(joined == whole.values);
  }
}

TEST_CASE("the mesh lies where density begins", "[density][costly]") {
  const unsigned seed = 11;
  CAPTURE(seed);
  constexpr int32_t kCell = 4096;  // the cell size that clouds() uses, in units
  const WorldField world(clouds(seed), std::pmr::get_default_resource());
  std::vector<ChunkRequest> requests;
  for (int32_t x = 0; x < 16; ++x) {
    for (int32_t z = 0; z < 16; ++z) requests.push_back({{0, {x, 9, z}}, 0, {}});
  }
  const auto chunks = meshAll(world, requests, 2);
  size_t vertices = 0, wrong = 0, clear = 0;
  for (const PlacedChunk& chunk : chunks) {
    const auto& body = chunk.mesh.body;
    for (size_t v = 0; v < body.vertices.size(); v += 97) {
      const Vertex& vertex = body.vertices[v];
      const std::array<double, 3> n = unpackNormal(vertex.normal_x, vertex.normal_y);
      const double at[3] = {vertex.x / 256.0, vertex.y / 256.0, vertex.z / 256.0};
      // The vertex lies on an edge between a solid and an empty sample; this grid has exactly these two samples.
      DensityGrid ends;
      ends.spacing = kCell;
      ends.size = {1, 1, 1};
      for (int axis = 0; axis < 3; ++axis) {
        const double cells = at[axis];
        ends.origin[axis] = chunk.grid.origin[axis] + static_cast<int32_t>(std::floor(cells)) * kCell;
        if (cells != std::floor(cells)) ends.size[static_cast<size_t>(axis)] = 2;
      }
      const Volume edge = volumeOf(queryField(world), ends, 1);
      REQUIRE(edge.values.size() == 2);
      wrong += (edge.values[0] > 0) == (edge.values[1] > 0);
      // Takes samples at half a cell from the surface, on both sides along the normal. Only the inner side has fog,
      // except where the surface is folded.
      DensityGrid sides;
      sides.size = {1, 1, 1};
      float density[2] = {};
      for (int side = 0; side < 2; ++side) {
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<size_t>(axis);
          sides.origin[axis] = chunk.grid.origin[axis] +
                               static_cast<int32_t>(std::floor((at[a] + (side == 0 ? -0.5 : 0.5) * n[a]) * kCell));
        }
        density[side] = volumeOf(queryField(world), sides, 1).values[0];
      }
      clear += density[0] > 0 && density[1] == 0;
      ++vertices;
    }
  }
  CAPTURE(vertices, clear);
  REQUIRE(vertices > 200);
  CHECK(wrong == 0);
  CHECK(static_cast<double>(clear) > 0.9 * static_cast<double>(vertices));
}

TEST_CASE("a volume that makes no sense is refused, and one that is stopped ends", "[density]") {
  const WorldField world(settingsOf("sgm 1; units m; start A; rule A { sphere(3m); }", 512),
                         std::pmr::get_default_resource());
  const auto jobs = *makeThreadPool(2);
  DensityGrid good;
  good.spacing = 128;
  good.size = {70, 70, 70};
  good.origin = {-4096, -4096, -4096};
  good.edge = 1024;
  std::vector<float> values(pointsOf(good));
  DensityRows rows;
  rows.values = values.data();
  rows.row_pitch = 70;
  rows.slice_pitch = 4900;
  const auto codeOf = [&](const DensityGrid& grid, const Progress& progress = {}) -> std::optional<Code> {
    const auto done = sampleDensity(queryField(world), grid, *jobs, rows, progress);
    if (done) return std::nullopt;
    CHECK(!done.error().message.empty());
    return done.error().code;
  };
  CHECK(!codeOf(good));
  for (const double edge : {0.0, 0.99, -5.0, 4096.0 * 512 + 1, std::nan("")}) {
    DensityGrid grid = good;
    grid.edge = edge;
    CHECK(codeOf(grid) == Code::invalid_argument);
  }
  DensityGrid grid = good;
  grid.edge = 4096.0 * 512;
  CHECK(!codeOf(grid));
  grid = good;
  grid.origin.y = INT32_MAX - 69 * 128;
  CHECK(!codeOf(grid));
  ++grid.origin.y;
  CHECK(codeOf(grid) == Code::range);
  // The grid spans the whole world, with a spacing that just fits into int32.
  grid.origin = {INT32_MIN, INT32_MIN, INT32_MIN};
  grid.spacing = INT32_MAX;
  grid.size = {3, 3, 3};
  rows.row_pitch = 3;
  rows.slice_pitch = 9;
  CHECK(!codeOf(grid));
  rows.row_pitch = 70;
  rows.slice_pitch = 4900;

  std::vector<std::pair<uint64_t, uint64_t>> told;
  CHECK(!codeOf(good, [&](uint64_t done, uint64_t total) {
    told.emplace_back(done, total);
    return done < total;  // the last call comes too late to stop the work
  }));
  REQUIRE(told.size() == 27);
  for (size_t i = 0; i < told.size(); ++i) CHECK(told[i] == std::pair<uint64_t, uint64_t>(i + 1, 27));
  CHECK(codeOf(good, [&](uint64_t, uint64_t) { return false; }) == Code::cancelled);
}
