// Tests measuring a region's mesh: random fields with a stand-in for a backend, and known shapes.

#include "region/region.h"

#include <cmath>

#include "brute_force.h"
#include "fields.h"
#include "metrics_fixture.h"
#include "region/measure.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// A stand-in for a backend that meshes a lattice field instead of the programs in the jobs.
class LatticeBackend final : public Backend {
 public:
  explicit LatticeBackend(LatticeField field) : field_(std::move(field)) {}
  const BackendCapabilities& capabilities() const override { return capabilities_; }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk) override {
    auto batch = std::make_unique<Batch>();
    for (const ChunkJob& job : jobs) {
      const ChunkSamples samples = sampleChunk(field_, job.grid);
      ChunkMesh& mesh = batch->meshes.emplace_back();
      polygonizeBody(samples, job.grid, mesh.body);
      for (size_t z = 0; z < kChunkCells; ++z) {
        for (size_t y = 0; y < kChunkCells; ++y) {
          const uint64_t row = samples.signs[y + z * kChunkSamples];
          for (int x = 0; x < kChunkCells; ++x) mesh.solid_samples += static_cast<uint32_t>(row >> x & 1);
        }
      }
      if (job.signs) mesh.signs = samples.signs;
    }
    return std::unique_ptr<ChunkBatch>(std::move(batch));
  }

 private:
  struct Batch final : ChunkBatch {
    std::vector<ChunkMesh> meshes;
    bool poll() override { return true; }
    void wait() override {}
    void cancel() override {}
    Result<std::vector<ChunkMesh>> take() override { return std::move(meshes); }
  };
  LatticeField field_;
  BackendCapabilities capabilities_;
};

RegionMeasures measured(const LatticeField& field, const IntBox& lattice) {
  WorldFieldSettings settings;
  settings.program = compiled("sgm 1; domain infinite; layer l cell 8m reach 1m { start A; } rule A { }");
  settings.parameters = ParameterValues::defaults(*settings.program);
  settings.finest_cell = kSpacing;
  const WorldField world(settings, std::pmr::get_default_resource());
  LatticeBackend backend(field);
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(2);
  REQUIRE(jobs);
  IntBox region = lattice;
  for (int axis = 0; axis < 3; ++axis) {
    region.lo[axis] *= kSpacing;
    region.hi[axis] *= kSpacing;
  }
  const Result<RegionMeasures> result = measureRegion(world, backend, **jobs, region, 1000, {true, true});
  INFO((result ? "" : result.error().message));
  REQUIRE(result);
  return *result;
}

}  // namespace

TEST_CASE("regions of random fields: pieces, volume, borders", "[metrics][costly]") {
  for (uint64_t seed = 1; seed <= rounds(10); ++seed) {
    PathKey random{hashCombine(0x6D657472, seed)};
    const Int3 chunks{1 + static_cast<int>(random.unit(1) * 2), 1 + static_cast<int>(random.unit(2) * 2),
                      1 + static_cast<int>(random.unit(3) * 2)};
    const Int3 origin{-kChunkCells, 0, kChunkCells * 5};
    const double density = 0.03 + 0.94 * random.unit(4);
    const bool closed = seed % 2 == 0;
    IntBox box{origin, origin};
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] += chunks[axis] * kChunkCells;
    const LatticeField field = [&](Int3 p, int) {
      const bool border = p.x <= box.lo.x || p.y <= box.lo.y || p.z <= box.lo.z || p.x >= box.hi.x || p.y >= box.hi.y ||
                          p.z >= box.hi.z;
      return closed && border ? 5 : randomQ(pointHash(seed, p), density);
    };
    const auto solid = [&](int x, int y, int z) { return field({box.lo.x + x, box.lo.y + y, box.lo.z + z}, 0) < 0; };
    const int nx = box.hi.x - box.lo.x, ny = box.hi.y - box.lo.y, nz = box.hi.z - box.lo.z;
    INFO("seed " << seed << ": " << chunks.x << " x " << chunks.y << " x " << chunks.z << " chunks, density "
                 << density);
    const RegionMeasures found = measured(field, box);
    CHECK(found.pieces == bruteForce(nx + 1, ny + 1, nz + 1, solid));
    uint64_t inside = 0;
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) inside += solid(x, y, z);
      }
    }
    CHECK(found.cubes == cubeVolume(inside, kSpacing));
    CHECK(found.chunks == static_cast<uint64_t>(chunks.x * chunks.y * chunks.z));
    INFO(found.topology.leak);
    CHECK(found.topology.watertight);
    CHECK(found.topology.genus.has_value() == closed);
    if (closed) CHECK(found.topology.why.empty());
  }
}

TEST_CASE("every shell parts one piece of solid from one of air", "[metrics]") {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const double density = 0.1 * static_cast<double>(seed);
    INFO("seed " << seed << ", density " << density);
    const ChunkGrid grid = latticeChunk({}, 0);
    const LatticeField field = [&](Int3 p, int) {
      const bool border =
          p.x == 0 || p.y == 0 || p.z == 0 || p.x == kChunkCells || p.y == kChunkCells || p.z == kChunkCells;
      return border ? 1 : randomQ(pointHash(seed, p), density);
    };
    MeshPart part;
    polygonizeBody(sampleChunk(field, grid), grid, part);
    const PlacedPart placed{&part, grid, 0};
    const Result<WorldMesh> mesh = weld({&placed, 1}, {});
    REQUIRE(mesh);
    const Components pieces = measured(field, {{0, 0, 0}, {kChunkCells, kChunkCells, kChunkCells}}).pieces.above(0);
    CHECK(measuresOf(*mesh).objects == pieces.solid + pieces.air - 1);
  }
}

TEST_CASE("area and volume are the same where meshes are not looked at", "[metrics]") {
  const World world(
      "sgm 1; start A; rule A { torus(3m, 1m); at(-2m, 1m, 0m) box(3m, 2m, 1m); cut { at(1m, 2m, 0m) sphere(2m); } }");
  for (const double cell : {0.5, 0.2, 0.07}) {
    INFO("cells of " << cell << " m");
    const RegionMeasures looked_at = world.measured(cell, world.program().domain.box, {true, true, true});
    const RegionMeasures sums = world.measured(cell, world.program().domain.box, {false, false, true});
    CHECK(sums.area == looked_at.area);
    CHECK(sums.area > 50);
    CHECK(sums.volume == looked_at.volume);
    CHECK(sums.volume > 50);
    CHECK(sums.cubes == looked_at.cubes);
    CHECK(sums.triangles == looked_at.triangles);
    CHECK(looked_at.topology.watertight);
    CHECK_FALSE(sums.topology.watertight);
  }
}

TEST_CASE("area by integers is that of the triangles", "[metrics]") {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    INFO("seed " << seed);
    const ChunkGrid grid = latticeChunk({}, 0);
    const LatticeField field = [&](Int3 p, int) { return randomQ(pointHash(seed, p), 0.4); };
    MeshPart part;
    polygonizeBody(sampleChunk(field, grid), grid, part);
    const PlacedPart placed{&part, grid, 0};
    const Result<WorldMesh> mesh = weld({&placed, 1}, {});
    REQUIRE(mesh);
    const double expected = measuresOf(*mesh).area;
    CHECK(expected > 0);
    // The sum rounds each triangle's area to 1/8192 of a 65,536th of a cell's face.
    CHECK(std::abs(areaOf(sumsOf(part.vertices, part.indices), grid.cell) - expected) < 1e-8 * expected);
  }
}

TEST_CASE("genus counts handles", "[metrics]") {
  const auto genusOf = [](const std::string& shapes) {
    const RegionMeasures m = regionOfShapes(shapes, 0.25);
    INFO(m.topology.why);
    REQUIRE(m.topology.genus);
    return *m.topology.genus;
  };
  CHECK(genusOf("sphere(3m);") == 0);
  CHECK(genusOf("at(-4m, 0m, 0m) sphere(3m); at(4m, 0m, 0m) sphere(3m);") == 0);
  CHECK(genusOf("torus(3m, 1m);") == 1);
  CHECK(genusOf("torus(3m, 0.8m); at(3m, 0m, 0m) rot(x, 90deg) torus(3m, 0.8m);") == 2);
  CHECK(genusOf("at(-4m, 0m, 0m) torus(3m, 1m); at(4m, 0m, 0m) torus(3m, 1m);") == 2);
  CHECK(genusOf("at(-3m, 0m, 0m) torus(3m, 1m); at(3m, 0m, 0m) torus(3m, 1m);") == 2);  // fused: a pretzel
  CHECK(genusOf("sphere(3m); cut { sphere(2m); }") == 0);
  CHECK(genusOf("sphere(3m); cut { cylinder(1m, 8m); }") == 1);
  CHECK(genusOf("") == 0);
  CHECK(regionOfShapes("torus(3m, 0.8m); at(3m, 0m, 0m) rot(x, 90deg) torus(3m, 0.8m);", 0.25).pieces.above(0) ==
        Components{2, 1});
  CHECK(regionOfShapes("sphere(3m); cut { sphere(2m); }", 0.25).pieces.above(0) == Components{1, 2});
}

TEST_CASE("watertight: whole, cut by the border, with a triangle less", "[metrics]") {
  const RegionMeasures ball = regionOfShapes("sphere(3m);", 0.25);
  CHECK(ball.topology.watertight);
  CHECK(ball.topology.genus == 0u);

  // The ball extends beyond the region's low faces.
  const World world("sgm 1; domain finite box(20m, 20m, 20m); start A; rule A { at(2m, 3m, 2m) sphere(3m); }");
  const IntBox octant{{0, 0, 0}, {4 * kUnitsPerMetre, 4 * kUnitsPerMetre, 4 * kUnitsPerMetre}};
  const RegionMeasures part = world.measured(0.25, octant);
  CHECK(part.topology.watertight);
  CHECK_FALSE(part.topology.genus);
  CHECK(part.topology.why == "the region's border cuts the surface");

  const ChunkGrid grid = latticeChunk({}, 0);
  const auto round = [](Int3 p, int) {
    const int32_t x = p.x - 16, y = p.y - 16, z = p.z - 16;
    return x * x + y * y + z * z - 101;
  };
  MeshPart body;
  polygonizeBody(sampleChunk(round, grid), grid, body);
  const PlacedPart placed{&body, grid, 0};
  Result<WorldMesh> mesh = weld({&placed, 1}, {});
  REQUIRE(mesh);
  const IntBox extent{{}, {32 * kSpacing, 32 * kSpacing, 32 * kSpacing}};
  CHECK(topologyOf(*mesh, extent).watertight);
  mesh->indices.resize(mesh->indices.size() - 3);
  const Topology torn = topologyOf(*mesh, extent);
  CHECK_FALSE(torn.watertight);
  CHECK(torn.leak == "3 open edges away from the region's border");
  CHECK_FALSE(torn.genus);
}

TEST_CASE("the volume of a ball is right to first order, its area too", "[metrics]") {
  const double r = 3, pi = 3.14159265358979323846;
  for (double cell : {0.5, 0.25, 0.125}) {
    const RegionMeasures ball = regionOfShapes("sphere(3m);", cell);
    INFO("cell " << cell << ": cubes " << ball.cubes << ", area " << ball.area);
    // A wrongly counted cube lies within half its diagonal of the surface. Cubes that are wrongly included nearly
    // cancel those that are wrongly omitted.
    CHECK(std::fabs(ball.cubes - 4 * pi * r * r * r / 3) < 4 * pi * r * r * cell * 0.1);
    CHECK(std::fabs(ball.area - 4 * pi * r * r) < 4 * pi * r * r * cell * 0.1);
    CHECK(ball.triangles > 0);
  }
}
