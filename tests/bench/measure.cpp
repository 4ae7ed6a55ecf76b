#include "measure.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bench {
namespace {

// True if an edge lies on an outer face of the meshed cube. Such an edge may be open, since the surface continues
// outside the cube.
bool inOuterFace(const float* a, const float* b, double extent) {
  for (int axis = 0; axis < 3; ++axis) {
    const double p = a[axis], q = b[axis];
    if (std::fabs(p - q) < 1e-3 && (std::fabs(p) < 1e-3 || std::fabs(p - extent) < 1e-3)) return true;
  }
  return false;
}

}  // namespace

Shape measure(const Mesh& mesh, double extent) {
  Shape shape{mesh.positions.size() / 3, mesh.indices.size() / 3, 0, 0, 0};
  std::vector<uint64_t> edges, opposite;
  edges.reserve(mesh.indices.size());
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const uint32_t* i = &mesh.indices[t];
    const float* p[3];
    for (int k = 0; k < 3; ++k) p[k] = &mesh.positions[size_t{i[k]} * 3];
    double u[3], v[3];
    for (int axis = 0; axis < 3; ++axis) {
      u[axis] = double{p[1][axis]} - double{p[0][axis]};
      v[axis] = double{p[2][axis]} - double{p[0][axis]};
    }
    const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    shape.area += 0.5 * std::sqrt(x * x + y * y + z * z);
    for (int k = 0; k < 3; ++k) edges.push_back(uint64_t{i[k]} << 32 | i[(k + 1) % 3]);
  }
  opposite.reserve(edges.size());
  for (const uint64_t e : edges) opposite.push_back(e << 32 | e >> 32);
  std::sort(edges.begin(), edges.end());
  std::sort(opposite.begin(), opposite.end());
  std::vector<bool> used(mesh.positions.size() / 3);
  for (const uint32_t i : mesh.indices) used[i] = true;
  // For Euler's formula, an edge counts once, whatever its direction in the triangles.
  std::vector<uint64_t> undirected;
  undirected.reserve(edges.size());
  for (const uint64_t e : edges) undirected.push_back(std::min(e, e << 32 | e >> 32));
  std::sort(undirected.begin(), undirected.end());
  const auto edge_count = std::unique(undirected.begin(), undirected.end()) - undirected.begin();
  shape.euler = std::count(used.begin(), used.end(), true) - edge_count + static_cast<long>(shape.triangles);
  std::vector<uint64_t> open;
  std::set_difference(edges.begin(), edges.end(), opposite.begin(), opposite.end(), std::back_inserter(open));
  for (const uint64_t e : open) {
    const float* a = &mesh.positions[size_t{e >> 32} * 3];
    const float* b = &mesh.positions[size_t{e & 0xFFFFFFFFu} * 3];
    shape.open_edges += inOuterFace(a, b, extent) ? 0u : 1u;
  }
  return shape;
}

double processorTime() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto milliseconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
  };
  return milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
}

double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

double now() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

Times statistics(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  const size_t n = all.size(), half = n / 2;
  const double median = n % 2 ? all[half] : 0.5 * (all[half - 1] + all[half]);
  return {median, all.front(), all.back(), static_cast<int>(n), 0};
}

void pin(int threads) {
  cpu_set_t allowed, wanted;
  CPU_ZERO(&wanted);
  if (sched_getaffinity(0, sizeof allowed, &allowed)) return;
  for (size_t cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&wanted) < threads; ++cpu)
    if (CPU_ISSET(cpu, &allowed)) CPU_SET(cpu, &wanted);
  sched_setaffinity(0, sizeof wanted, &wanted);
}

}  // namespace bench
