// Benchmarks OpenVDB's volumeToMesh on a grid from a file. The time to build its sparse grid from the samples is not
// included.
//
//   sgm_bench_openvdb GRID THREADS RUNS

#include <openvdb/openvdb.h>
#include <openvdb/tools/Activate.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>

#include "answer.h"
#include "grid_file.h"

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: sgm_bench_openvdb GRID THREADS RUNS\n");
    return 2;
  }
  const int threads = std::atoi(argv[2]), runs = std::atoi(argv[3]);
  bench::pin(threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
  openvdb::initialize();
  bench::Grid samples = bench::readGrid(argv[1]);
  const openvdb::CoordBBox box({0, 0, 0}, {samples.size[0] - 1, samples.size[1] - 1, samples.size[2] - 1});
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, samples.values.data());
  // Store only a narrow band of three cells on each side of the surface, as OpenVDB's own level sets do. Values beyond
  // it are clamped, which keeps their sign.
  constexpr float kBand = 3.0f;
  for (float& value : samples.values) value = std::min(std::max(value, -kBand), kBand);
  openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(kBand);
  openvdb::tools::copyFromDense(dense, *grid, 0.0f);
  openvdb::tools::deactivate(grid->tree(), -kBand);
  openvdb::tools::pruneLevelSet(grid->tree());
  grid->setGridClass(openvdb::GRID_LEVEL_SET);

  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  const bench::Times times = bench::timed(2, runs, [&] {
    points.clear();
    triangles.clear();
    quads.clear();
    openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0);
  });
  bench::Mesh mesh;
  for (const openvdb::Vec3s& p : points)
    for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back(p[axis]);
  for (const openvdb::Vec3I& t : triangles)
    for (int k = 0; k < 3; ++k) mesh.indices.push_back(t[k]);
  for (const openvdb::Vec4I& q : quads)
    for (const int k : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(q[k]);
  bench::printTimes("openvdb", times);
  bench::printShape(bench::measure(mesh, samples.size[0] - 1));
  std::printf(" version=%s\n", openvdb::getLibraryVersionString());
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_openvdb: %s\n", e.what());
  return 1;
}
