// Measures the time of each part of measureMesh() for a torus and for the surface of a random field: wall time, and
// processor time of all threads. The first run includes the time to get memory from the system.
//
//   sgm_bench_measure [TRIANGLES [THREADS [FILE.glb]]]     FILE.glb: writes the torus for sgm measure

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>

#include "../unit/measure/shapes.h"
#include "measure.h"
#include "measure/mesh_measures.h"
#include "measure/weld_points.h"
#include "mesh/export/export.h"

namespace {

using namespace sgm;
using namespace sgm::measure;

double processorMilliseconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

void row(const char* name, const std::function<void()>& work) {
  std::printf("  %-22s", name);
  double wall[3], busy[3];
  for (int run = 0; run < 3; ++run) {
    const double before = processorMilliseconds(), start = bench::now();
    work();
    wall[run] = bench::now() - start;
    busy[run] = processorMilliseconds() - before;
  }
  std::printf(" %8.0f %8.0f %10.0f %8.0f\n", wall[0], busy[0], std::min(wall[1], wall[2]), std::min(busy[1], busy[2]));
  std::fflush(stdout);
}

void parts(const char* name, const Mesh& mesh, JobSystem& jobs) {
  std::printf("%s, %zu triangles, %u threads\n  %-22s %8s %8s %10s %8s\n", name, mesh.triangles.size(),
              jobs.concurrency(), "ms", "wall", "CPU", "later wall", "CPU");
  WeldedPoints welded;
  row("weldPoints", [&] { welded = weldPoints(mesh); });
  const Triangles clean{welded.points, welded.triangles};
  AreaVolume sums;
  row("areaVolume", [&] { sums = areaVolume(clean, jobs); });
  std::optional<Bvh> tree;
  row("Bvh", [&] { tree.emplace(clean, jobs); });
  SelfIntersections crossings;
  row("selfIntersections", [&] { crossings = selfIntersections(clean, *tree, uint64_t{1} << 40, jobs); });
  std::optional<Edges> edges;
  row("Edges", [&] { edges.emplace(clean); });
  Shells shells;
  row("shellsOf", [&] { shells = shellsOf(clean, *edges, sums.centre); });
  row("smoothNormals, histogram", [&] { (void)histogramOf(clean, smoothNormals(clean), &*edges, {}, jobs); });
  row("nestingOf", [&] { (void)nestingOf(clean, *tree, shells, false, uint64_t{1} << 40, jobs); });
  row("checkTriangles", [&] {
    (void)checkTriangles({clean.triangles.front().data(), 3 * clean.triangles.size()}, clean.points.size());
  });
  tree.reset();
  edges.reset();
  row("measureMesh", [&] { (void)measureMesh(mesh, {}, jobs); });
  std::printf("  %zu shells, %llu pairs cut each other; at most %.0f MB so far\n", shells.shells.size(),
              static_cast<unsigned long long>(crossings.pairs), peakMegabytes());
}

bool written(const Mesh& mesh, const char* path) {
  WorldMesh world;
  for (const Point p : mesh.points) world.positions.push_back({p.x, p.y, p.z});
  world.attributes.resize(mesh.points.size());
  for (const Triangle& t : mesh.triangles) world.indices.insert(world.indices.end(), t.begin(), t.end());
  return static_cast<bool>(exportMesh(world, {}, path));
}

}  // namespace

int main(int argc, char** argv) {
  const double triangles = argc > 1 ? std::max(100.0, std::atof(argv[1])) : 1e6;
  const auto threads = static_cast<unsigned>(argc > 2 ? std::max(1, std::atoi(argv[2])) : 2);
  bench::pin(static_cast<int>(threads));
  const auto jobs = makeThreadPool(threads);
  if (!jobs) return 1;
  const Mesh ring = torus(static_cast<uint32_t>(std::lround(std::sqrt(triangles / 2))));
  if (argc > 3 && !written(ring, argv[3])) {
    std::fprintf(stderr, "sgm_bench_measure: cannot write %s\n", argv[3]);
    return 1;
  }
  parts("torus", ring, **jobs);
  // Choose the lattice's size for the wanted number of triangles: the surface has about 10 for each lattice point.
  std::mt19937 random(1);
  parts("random field", randomSurface(random, static_cast<uint32_t>(std::cbrt(triangles / 10)), 0.5), **jobs);
  return 0;
}
